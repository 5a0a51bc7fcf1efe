// Smooths a mesh as smooth does, with ranks of MPI that share the steps: mpirun -n 4 smooth-distributed INPUT OUTPUT …
//
//     rank 0:      read ──► cut ──► deal the sub-meshes ──► steps ──► write
//     the others:                   whole sub-meshes    ──► steps

#include <csignal>
#include <memory>
#include <optional>

#include "engine/ranks/rank_group.h"
#include "engine/ranks/transport.h"
#include "samples/process/cpu_quota.h"
#include "samples/smooth_program.h"

using namespace seamflow;

namespace {

constexpr const char* name = "smooth-distributed";

SmoothProgram program()
{
    return {.name = name,
            .description =
                "Smooths a mesh as smooth does, to the same bytes, on as many ranks of MPI as mpirun starts: "
                "mpirun -n 4 smooth-distributed INPUT OUTPUT …\n"
                "Rank 0 reads, cuts and writes; all share the steps in sub-meshes, sweeps and converged ones.",
            .examples =
                "mpirun -n 4 smooth-distributed scan.ply smooth.ply --radius 1%   four ranks, each with a quarter\n"
                "mpirun -n 4 smooth-distributed scan.ply smooth.ply --time-step-edges 5 --converge 1e-6   exact steps\n"
                "mpirun -n 4 smooth-distributed scan.ply smooth.ply --fields quality --fwhm 1%   numbers of the "
                "vertices\n"
                "mpirun -n 4 smooth-distributed scan.ply smooth.ply --radius 1% --steps 50 --checkpoint state   "
                "continues where it was stopped, also without ranks\n",
            .approaches = "how a step is taken [sweep or converged, whichever smooth would choose of the two]\n"
                          "Ranks share sweeps and converged steps; all others rank 0 takes alone."};
}

}  // namespace

int main(int argc, char** argv)
{
    std::unique_ptr<Transport> transport;
    std::optional<RankGroup> ranks;
    const int status = run_program(name, [&] {
        transport = make_mpi_transport();
        if (transport->rank() > 0) {
            // Rank 0 says when to end.
            std::signal(SIGINT, SIG_IGN);
            std::signal(SIGTERM, SIG_IGN);
            return static_cast<ExitStatus>(serve_flows(*transport, threads_within_quota()));
        }
        ranks.emplace(*transport);
        return run_smooth_program(argc, argv, program(), &*ranks);
    });
    // MPI ends all ranks as soon as one has ended with a failure: none does until rank 0 has reported it.
    if (ranks)
        ranks->dismiss(status);
    return status;
}
