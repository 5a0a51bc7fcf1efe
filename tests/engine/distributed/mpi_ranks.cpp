// Checks ranks that are processes of MPI; each of them runs this program (mpirun -n R mpi_ranks).

#include <utility>

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "engine/distributed/distributed_flow.h"
#include "engine/distributed/ranks/mpi_transport.h"
#include "tests/engine/distributed/parts.h"
#include "tests/engine/distributed/rank_checks.h"
#include "tests/support/flows.h"

namespace {

seamflow::Transport* transport = nullptr;

}  // namespace

TEST_CASE("ranks of MPI hear each other")
{
    seamflow::test::check_collectives(*transport);
    seamflow::test::check_arrivals(*transport);
    seamflow::test::check_failures(*transport);
    seamflow::test::check_agreement(*transport);
}

TEST_CASE("ranks of MPI find the bits of one machine")
{
    using namespace seamflow;
    const PolygonMesh mesh = make_mixed_polygons(3000);
    FlowOptions options;
    options.time_step = 1e-3;
    options.steps = 4;
    options.resources.threads = 2;
    for (const auto& [laplacian, approach] : {std::pair{Laplacian::Fujiwara, Approach::Sweep},
                                              {Laplacian::VirtualRefinement, Approach::Sweep},
                                              {Laplacian::AlexaWardetzky, Approach::Converged}}) {
        options.laplacian = laplacian;
        options.accuracy.approach = approach;
        options.cut.subdomains = 24;
        PolygonMesh expected = mesh;
        const FlowReport report = mean_curvature_flow(expected, options);
        options.cut.subdomains = 0;
        MeshPart part = test::part_of(mesh, report.cut.labels, transport->rank(), transport->size());
        const RankReport own = distributed_mean_curvature_flow(*transport, part, options);
        CHECK(own.flow.cut.n_colours() == report.cut.n_colours());
        for (const RankTraffic& step : own.traffic)
            CHECK((step.messages > 0) == (transport->size() > 1));
        const std::vector<Index> numbers(part.vertex_numbers.begin(), part.vertex_numbers.end());
        CHECK(test::same_bits(part.mesh.vertices, expected.vertices(numbers, Eigen::all)));
    }
}

int main(int argc, char** argv)
{
    // Longer messages go in pieces.
    const auto world = seamflow::make_mpi_transport(10'000);
    transport = world.get();
    return doctest::Context(argc, argv).run();
}
