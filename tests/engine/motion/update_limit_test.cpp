#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/motion/update_limit.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Two triangles over the unit square, whose diagonal is √2, and a vertex without faces far away.
PolygonMesh unit_square()
{
    PolygonMesh mesh;
    mesh.vertices.resize(5, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1e6, 0, 0;
    mesh.add_face(std::array<Index, 3>{0, 1, 2});
    mesh.add_face(std::array<Index, 3>{0, 2, 3});
    return mesh;
}

std::string complaint(double diagonals, Index vertex, const Point& update)
{
    const PolygonMesh mesh = unit_square();
    Points after = mesh.vertices;
    after.row(vertex) += update;
    const std::vector<Index> labels{4, 7};
    return test::message_of<ComputationError>(
        [&] { UpdateLimit(mesh, diagonals).require(mesh.vertices, after, labels); });
}

}  // namespace

TEST_CASE("updates up to the diagonal of the faces' bounding box pass, others are told with sub-mesh and vertex")
{
    CHECK(complaint(1.0, 3, {1.0, 1.0, 0.0}).empty());
    CHECK(complaint(1.0, 3, {1.0, 1.0, 0.1}) ==
          "sub-mesh 7, vertex 3 would move by 1.42, but the mesh is 1.41 across: use a smaller time step or another "
          "Laplacian, or repair the mesh there");
    CHECK(complaint(1.0, 1, {0.0, -3.0, 0.0}).starts_with("sub-mesh 4, vertex 1 would move by 3,"));
    CHECK(complaint(2.0, 3, {2.0, 1.0, 0.0}).empty());
    CHECK(complaint(0.5, 3, {1.0, 0.0, 0.0}).find("would move by 1, but largest_update allows 0.707 at most") !=
          std::string::npos);
    CHECK(complaint(1.0, 4, {3.0, 0.0, 0.0}).starts_with("vertex 4 would move by 3,"));
}

TEST_CASE("without sub-meshes the vertex alone is told")
{
    const PolygonMesh mesh = unit_square();
    Points after = mesh.vertices;
    after.row(3) << 1.0, 2.0, 0.1;
    CHECK(test::message_of<ComputationError>([&] { UpdateLimit(mesh, 1.0).require(mesh.vertices, after, {}); }) ==
          "vertex 3 would move by 1.42, but the mesh is 1.41 across: smooth less, or repair the mesh there");
}

TEST_CASE("without a limit, whatever is finite passes")
{
    CHECK(complaint(infinity, 2, {1e300, 1e300, 0.0}).empty());
    for (const double wrong : {infinity, -infinity, std::nan("")}) {
        CAPTURE(wrong);
        CHECK(complaint(infinity, 2, {0.0, wrong, 0.0})
                  .find("sub-mesh 4, vertex 2 would go to a position that is not "
                        "finite") == 0);
        CHECK_FALSE(complaint(1.0, 2, {0.0, wrong, 0.0}).empty());
    }
}

TEST_CASE("of several vertices the first that is not finite is told, however far others move")
{
    const PolygonMesh mesh = unit_square();
    Points after = mesh.vertices;
    after.row(0) << -1e308, 1e308, 1e308;
    const std::vector<Index> labels{4, 7};
    const UpdateLimit none(mesh, infinity);
    CHECK_NOTHROW(none.require(-after, after, labels));
    after(2, 1) = std::nan("");
    after(3, 0) = std::nan("");
    after(4, 0) = infinity;
    for (const double diagonals : {1.0, infinity})
        CHECK_THROWS_WITH_AS(UpdateLimit(mesh, diagonals).require(mesh.vertices, after, labels),
                             doctest::Contains("vertex 2 would go to a position that is not finite"), ComputationError);
}

TEST_CASE("a flow that throws vertices beyond the mesh ends with the step before, and says where")
{
    // The equations of Δ_P are indefinite on triangles: what they take for a mode grows with every step.
    const PolygonMesh input = make_triangles(150);
    FlowOptions options;
    options.laplacian = Laplacian::PtackovaVelho;
    options.time_step = 0.5;
    options.steps = 200;
    options.cut.subdomains = 1;
    PolygonMesh mesh = input;
    Points last = input.vertices;
    int steps = 0;
    const std::string message = test::message_of<ComputationError>([&] {
        mean_curvature_flow(mesh, options, [&](const StepState& state) {
            last = state.positions;
            ++steps;
        });
    });
    CHECK(message.starts_with("step " + std::to_string(steps + 1) + ", sub-mesh 0, vertex "));
    CHECK(same_bits(mesh.vertices, last));
    CHECK(((last - input.vertices).rowwise().norm().array() < 3.0).all());

    SUBCASE("unless it may")
    {
        options.accuracy.largest_update = infinity;
        options.steps = steps + 1;
        CHECK(((flowed(input, options) - last).rowwise().norm().array() > std::sqrt(2.0)).any());
    }
}

TEST_CASE("what counts is how far the flow moves vertices, not where they are after scaling")
{
    PolygonMesh mesh = make_noisy_sphere(400, {.amplitude = 0.0, .noise = 0.0});
    FlowOptions options;
    options.laplacian = Laplacian::AlexaWardetzky;
    options.time_step = 0.05;
    options.cut.subdomains = 1;
    options.motion.rescale = Rescale::Area;
    const Points scaled = flowed(mesh, options);
    const double moved = (scaled - mesh.vertices).rowwise().norm().maxCoeff();
    options.accuracy.largest_update = 0.02;
    CHECK(moved < options.accuracy.largest_update);
    CHECK_THROWS_WITH_AS(mean_curvature_flow(mesh, options), doctest::Contains("would move by"), ComputationError);
}
