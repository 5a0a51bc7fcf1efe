#pragma once

namespace seamflow {

/// Whose factorisation solves sparse systems.
enum class Factorisation {
    /// What is fastest for the size: the library's own, of large systems CHOLMOD's or UMFPACK's.
    Automatic,
    /// The library's own: L D Lᵀ of symmetric systems, L U with pivots from the diagonal of others; UMFPACK's where
    /// those pivots are too small.
    Own,
    /// L Lᵀ by CHOLMOD of symmetric systems, L U by UMFPACK of others.
    Cholmod,
    /// L U by UMFPACK of all.
    Umfpack,
};

/// In which precision the factors of a sub-mesh are that solve for corrections, whose residual is in double precision.
enum class Precision {
    /// Single where that loses few digits, else double.
    Automatic,
    /// Single everywhere.
    Single,
    /// Double everywhere.
    Double,
};

/// Whether another library is asked for.
constexpr bool is_foreign(Factorisation factorisation)
{
    return factorisation == Factorisation::Cholmod || factorisation == Factorisation::Umfpack;
}

}  // namespace seamflow
