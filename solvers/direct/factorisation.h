#pragma once

namespace seamflow {

/// Whose factorisation solves sparse systems.
enum class Factorisation {
    /// The fastest for the size: the library's own, for large systems CHOLMOD's or UMFPACK's.
    Automatic,
    /// The library's own: L D Lᵀ for symmetric systems, L U with diagonal pivots for others; UMFPACK's where those
    /// pivots are too small.
    Own,
    /// CHOLMOD's L Lᵀ for symmetric systems, UMFPACK's L U for others.
    Cholmod,
    /// UMFPACK's L U for all.
    Umfpack,
};

/// Precision of the factors of a sub-mesh that solve for corrections, whose residual is in double precision.
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
