#pragma once

#include <string_view>

namespace seamflow {

/// The library whose factorisation solves sparse systems.
enum class Factorisation {
    /// The fastest for the size: our own, for large systems CHOLMOD's or UMFPACK's if the build has them.
    Automatic,
    /// Our own: L D Lᵀ for symmetric systems, L U with diagonal pivots for other systems; UMFPACK's or Eigen's if those
    /// pivots are too small.
    Own,
    /// CHOLMOD's L Lᵀ for symmetric systems, UMFPACK's L U for other systems.
    Cholmod,
    /// UMFPACK's L U for all systems.
    Umfpack,
    /// Eigen's L U, which replaces UMFPACK's in builds without it. Not an option for users.
    Eigen,
};

/// The libraries under the GNU General Public License in this build, which then covers the whole: "CHOLMOD and
/// UMFPACK"; or nothing (SEAMFLOW_GPL=OFF).
std::string_view gpl_parts();

/// The precision of the factors of a sub-mesh that solve for corrections, whose residual is in double precision.
enum class Precision {
    /// Single where that loses few digits, otherwise double.
    Automatic,
    /// Single everywhere.
    Single,
    /// Double everywhere.
    Double,
};

/// Whether a factorisation is foreign: that of CHOLMOD or UMFPACK, libraries that a build may lack.
constexpr bool is_foreign(Factorisation factorisation)
{
    return factorisation == Factorisation::Cholmod || factorisation == Factorisation::Umfpack;
}

/// Whether a factorisation has symmetric matrices of its own kind; others get general matrices instead.
constexpr bool has_symmetric_kind(Factorisation factorisation)
{
    return factorisation != Factorisation::Umfpack;
}

/// Whether this build has the factorisation.
inline bool is_available(Factorisation factorisation)
{
    return !is_foreign(factorisation) || !gpl_parts().empty();
}

}  // namespace seamflow
