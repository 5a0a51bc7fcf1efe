// Checks ranks that are processes of MPI; each of them runs this program (mpirun -n R mpi_ranks).

#include <memory>
#include <optional>

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "engine/ranks/transport.h"
#include "tests/engine/ranks/rank_checks.h"
#include "tests/engine/ranks/rank_flows.h"

namespace {

seamflow::Transport* transport = nullptr;

}  // namespace

TEST_CASE("ranks of MPI hear each other")
{
    seamflow::test::check_collectives(*transport);
    seamflow::test::check_pairs(*transport);
    seamflow::test::check_arrivals(*transport);
    seamflow::test::check_failures(*transport);
}

TEST_CASE("ranks of MPI find the bits of one process")
{
    using namespace seamflow;
    if (transport->rank() > 0) {
        CHECK(serve_flows(*transport, 2) == 3);
        return;
    }
    RankGroup ranks(*transport);
    const PolygonMesh mesh = make_mixed_polygons(3000);
    for (FlowOptions options : {test::by_sweeps(Laplacian::Fujiwara, 1e-3), test::by_sweeps(Laplacian::Uniform, 1e-3),
                                test::converged(Laplacian::AlexaWardetzky, 1e-3)}) {
        options.resources.threads = 2;
        options.cut.subdomains = 24;
        test::check_same(test::flowed_on(ranks, mesh, options), test::flowed_with(mesh, options, {}),
                         ranks.size() > 1 ? ranks.size() : 0);
    }
    ranks.dismiss(3);
}

int main(int argc, char** argv)
{
    // Longer messages go in pieces.
    const auto world = seamflow::make_mpi_transport(10'000);
    transport = world.get();
    return doctest::Context(argc, argv).run();
}
