#include "partition/errors.h"
#include "samples/benchmark/methods/peer_solver.h"

namespace seamflow {

std::unique_ptr<PeerSolver> make_amg_solver(double)
{
    throw ComputationError("not built in: install libhypre-dev");
}

bool has_amg()
{
    return false;
}

}  // namespace seamflow
