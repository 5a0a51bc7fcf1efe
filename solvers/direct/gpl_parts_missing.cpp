#include <stdexcept>

#include "solvers/direct/foreign_solvers.h"

// Replaces cholmod_llt.cpp and umfpack_lu.cpp in builds without libraries under the GPL.
namespace seamflow {

std::string_view gpl_parts()
{
    return {};
}

std::unique_ptr<DirectSolver> make_cholmod_llt(SparsePattern, CholmodWorkspace&)
{
    throw std::logic_error("this build has no CHOLMOD");
}

std::unique_ptr<DirectSolver> make_umfpack_lu(const SparsePattern&)
{
    throw std::logic_error("this build has no UMFPACK");
}

}  // namespace seamflow
