#include <cmath>

#include <doctest/doctest.h>

#include "engine/openmesh.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/openmesh.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

FlowOptions two_steps()
{
    FlowOptions options;
    options.time_step = 0.002;
    options.steps = 2;
    options.cut.subdomains = 4;
    return options;
}

}  // namespace

TEST_CASE_TEMPLATE("the points of an OpenMesh mesh flow as those of the same polygon mesh", Mesh, FloatPolyMesh,
                   DoublePolyMesh, FloatTriMesh, DoubleTriMesh)
{
    Mesh mesh = openmesh_of<Mesh>(make_triangles(400));
    const PolygonMesh before = to_polygon_mesh(mesh);
    int n_observed = 0;
    const FlowReport report = mean_curvature_flow(mesh, two_steps(), [&](const StepState&) { ++n_observed; });
    CHECK(n_observed == 2);
    CHECK(report.cut.n_sub_meshes() == 4);
    const PolygonMesh after = to_polygon_mesh(mesh);
    CHECK(after.face_vertices == before.face_vertices);
    const Points expected = flowed(before, two_steps());
    const bool is_single = std::is_same_v<typename Mesh::Scalar, float>;
    CHECK(after.vertices == (is_single ? Points(expected.cast<float>().cast<double>()) : expected));

    const Topology topology = make_topology(before);
    Index n_moved = 0;
    for (Index v = 0; v < before.n_vertices(); ++v) {
        const bool moved = after.vertices.row(v) != before.vertices.row(v);
        n_moved += moved ? 1 : 0;
        if (topology.kind[v] == VertexKind::Boundary)
            CHECK(!moved);
    }
    CHECK(n_moved > 300);
}

TEST_CASE("a mesh of OpenMesh that is stopped has the last complete step")
{
    std::stop_source source;
    auto mesh = openmesh_of<DoublePolyMesh>(make_triangles(400));
    FlowOptions options = two_steps();
    options.steps = 5;
    Points second;
    const auto stop_after_two = [&](const StepState& state) {
        second = state.positions;
        if (state.step == 2)
            source.request_stop();
    };
    CHECK_THROWS_AS(mean_curvature_flow(mesh, options, stop_after_two, {.stop = source.get_token()}), Cancelled);
    CHECK(to_polygon_mesh(mesh).vertices == second);
}

TEST_CASE("locked vertices stay, and so do those that are not selected where any is")
{
    DoublePolyMesh mesh = openmesh_of<DoublePolyMesh>(make_quads(400));
    const PolygonMesh before = to_polygon_mesh(mesh);
    CHECK(held_by_status(mesh).empty());
    mesh.request_vertex_status();
    CHECK(held_by_status(mesh).empty());
    mesh.status(mesh.vertex_handle(150)).set_locked(true);
    CHECK(held_by_status(mesh) == std::vector<Index>{150});
    for (unsigned v = 140; v < 300; ++v)
        mesh.status(mesh.vertex_handle(v)).set_selected(true);
    CHECK(held_by_status(mesh).size() == usize(before.n_vertices()) - 159);
    mean_curvature_flow(mesh, two_steps());
    const PolygonMesh after = to_polygon_mesh(mesh);
    const Topology topology = make_topology(before);
    for (Index v = 0; v < before.n_vertices(); ++v) {
        const bool may_move = topology.moves(v) && v >= 140 && v < 300 && v != 150;
        CHECK((after.vertices.row(v) != before.vertices.row(v)) == may_move);
    }
}
