#include "samples/benchmark/methods/peer_solver.h"

#include "partition/errors.h"

namespace seamflow {

std::unique_ptr<PeerSolver> make_peer_solver(const MethodTask& task)
{
    switch (task.method) {
    case Method::Cholmod:
        return make_cholmod_solver();
    case Method::Umfpack:
        return make_umfpack_solver();
    case Method::Krylov:
    case Method::KrylovIncomplete:
        return make_krylov_solver(task.method, task.options.laplacian, task.tolerance, task.options.resources.threads);
    case Method::Amg:
        return make_amg_solver(task.tolerance);
    default:
        break;
    }
    throw ComputationError("no solver of linear equations belongs to this method");
}

}  // namespace seamflow
