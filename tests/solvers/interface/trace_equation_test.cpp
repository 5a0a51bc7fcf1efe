#include <doctest/doctest.h>

#include "solvers/interface/trace_equation.h"
#include "tests/support/blocks.h"
#include "tests/support/flows.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

struct Solved {
    InterfaceResult result;
    Points positions;
};

Solved solve(const CutMesh& cut, Laplacian laplacian, int layers, const IterationStop& stop,
             double time_step = time_step_of_blocks)
{
    SolverWorkspace workspace;
    const Blocks blocks(cut, laplacian, layers, workspace, time_step);
    TraceEquation equation(blocks.blocks, cut.mesh.n_vertices());
    Solved solved{{}, cut.mesh.vertices};
    solved.result = equation.solve({blocks.blocks, blocks.factors}, stop, solved.positions,
                                   {run_serially, [&]() -> SolverWorkspace& { return workspace; }});
    return solved;
}

}  // namespace

TEST_CASE("where the blocks agree on the traces, they have the whole step")
{
    for (const CutMesh& cut : cut_meshes())
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(cut.name);
            CAPTURE(name_of(laplacian));
            const Points expected = undecomposed_step(cut, laplacian, time_step_of_blocks);
            const double size = 1.0 + expected.cwiseAbs().maxCoeff();
            for (const int layers : {0, 1, 2}) {
                CAPTURE(layers);
                const auto [result, positions] = solve(cut, laplacian, layers, {1e-11, 500});
                CHECK(result.residual <= 1e-11);
                CHECK(largest_difference(positions, expected) < 1e-8 * size);
            }
        }
}

TEST_CASE("iterations that run out leave the residual and the distance that they leave")
{
    for (const CutMesh& cut : cut_meshes()) {
        if (cut.name != "hexagons, METIS" && cut.name != "quads, METIS")
            continue;
        CAPTURE(cut.name);
        const Points exact = undecomposed_step(cut, Laplacian::PtackovaVelho, time_step_of_blocks);
        double before = 2.0;
        for (const int iterations : {0, 1, 2, 4}) {
            const auto [result, positions] = solve(cut, Laplacian::PtackovaVelho, 1, {1e-14, iterations});
            CHECK(result.iterations == iterations);
            CHECK(result.residual < before);
            before = result.residual;
            const double distance = (positions - exact).rowwise().norm().maxCoeff();
            CHECK(distance < 5.0 * result.estimated_distance);
            CHECK(distance > 0.001 * result.estimated_distance);
        }
        CHECK(before > 1e-14);
    }
}

TEST_CASE("where little of a residual can mean much of an error, the distance is that of the error")
{
    // Long steps of closed surfaces: I - T hardly sees where all traces lie together.
    constexpr double time_step = 1e4;
    for (const CutMesh& cut : cut_meshes()) {
        if (!cut.name.starts_with("sphere"))
            continue;
        CAPTURE(cut.name);
        const Points exact = undecomposed_step(cut, Laplacian::PtackovaVelho, time_step);
        for (const int layers : {0, 1})
            for (const double tolerance : {1e-6, 1e-8}) {
                CAPTURE(layers);
                CAPTURE(tolerance);
                const auto [result, positions] =
                    solve(cut, Laplacian::PtackovaVelho, layers, {tolerance, 500}, time_step);
                CHECK_FALSE(result.stagnated);
                const double distance = (positions - exact).rowwise().norm().maxCoeff();
                CHECK(distance < 2.0 * result.estimated_distance);
                CHECK(distance > 0.01 * result.estimated_distance);
            }
    }
}

TEST_CASE("a mesh that is not cut has no traces and its step at once")
{
    const CutMesh& many = cut_meshes().front();
    CutMesh cut = many;
    cut.labels.assign(cut.labels.size(), 0);
    cut.n_parts = 1;
    const auto [result, positions] = solve(cut, Laplacian::PtackovaVelho, 1, {1e-10, 10});
    CHECK(result.iterations == 0);
    CHECK(result.residual == 0.0);
    CHECK(largest_difference(positions, undecomposed_step(cut, Laplacian::PtackovaVelho, time_step_of_blocks)) < 1e-12);
}
