// Flows of every kind with every single allocation failing: the mesh then has the last complete step.

#include "engine/mean_curvature_flow.h"
#include "tests/faults/every_allocation.h"
#include "tests/faults/small_runs.h"

using namespace seamflow;

namespace {

std::string bytes_of(const Points& points)
{
    return {reinterpret_cast<const char*>(points.data()), static_cast<std::size_t>(points.size()) * sizeof(double)};
}

void fail_every_allocation_of(const FlowOptions& options, const PolygonMesh& input,
                              std::shared_ptr<const FlowState> resume = nullptr)
{
    PolygonMesh mesh = input;
    std::vector<Points> states{input.vertices};
    mean_curvature_flow(mesh, options, [&](const StepState& state) { states.push_back(state.positions); });
    int steps_done = 0;
    const auto run = [&] {
        mesh.vertices = input.vertices;
        steps_done = 0;
        mean_curvature_flow(
            mesh, options, [&](const StepState& state) { steps_done = state.step; }, {.resume = resume});
    };
    test::fail_every_allocation({.run = run,
                                 .result = [&] { return bytes_of(mesh.vertices); },
                                 .check_failed =
                                     [&] {
                                         const auto step = static_cast<std::size_t>(steps_done);
                                         CHECK(test::same_bits(mesh.vertices, states[step]));
                                     }});
}

}  // namespace

TEST_CASE("flows of every kind")
{
    for (const test::FlowKind& kind : test::small_flows(2, 2)) {
        CAPTURE(kind.name);
        MESSAGE(kind.name);
        fail_every_allocation_of(kind.options, test::small_mesh());
    }
}
