#pragma once

#include <string_view>

namespace seamflow {

/// Whose factorisation solves sparse systems.
enum class Factorisation {
    /// The fastest for the size: the library's own, for large systems CHOLMOD's or UMFPACK's where these are there.
    Automatic,
    /// The library's own: L D Lᵀ for symmetric systems, L U with diagonal pivots for others; UMFPACK's or Eigen's where
    /// those pivots are too small.
    Own,
    /// CHOLMOD's L Lᵀ for symmetric systems, UMFPACK's L U for others.
    Cholmod,
    /// UMFPACK's L U for all.
    Umfpack,
    /// Eigen's L U, which replaces UMFPACK's where that is not there. Nobody asks for it.
    Eigen,
};

/// What this build has of libraries under the GNU General Public License, which then covers the whole: "CHOLMOD and
/// UMFPACK"; or nothing (SEAMFLOW_GPL=OFF).
std::string_view gpl_parts();

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

/// Whether this build has it.
inline bool is_available(Factorisation factorisation)
{
    return !is_foreign(factorisation) || !gpl_parts().empty();
}

}  // namespace seamflow
