#include <cmath>
#include <cstring>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/steppers/explicit_stepper.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "solvers/laplacian/mean_curvature.h"
#include "tests/support/flows.h"

using namespace seamflow;
using test::flowed;

namespace {

FlowOptions explicit_options(const PolygonMesh& mesh, double part_of_limit)
{
    FlowOptions options;
    options.scheme = Scheme::ExplicitEuler;
    options.time_step = part_of_limit * largest_explicit_step(mesh, make_topology(mesh), mesh.vertices);
    return options;
}

std::vector<PolygonMesh> some_meshes()
{
    return {make_triangles(900), make_hexagons(900), make_mixed_polygons(900), make_noisy_sphere(900)};
}

}  // namespace

TEST_CASE("an explicit step moves each vertex against its mean curvature vector, and fixed ones not at all")
{
    for (const PolygonMesh& mesh : some_meshes())
        for (const Laplacian laplacian : test::geometric_laplacians) {
            FlowOptions options = explicit_options(mesh, 0.2);
            options.laplacian = laplacian;
            const Topology topology = make_topology(mesh);
            Points expected = mesh.vertices;
            for (Index v = 0; v < mesh.n_vertices(); ++v)
                if (topology.kind[v] == VertexKind::Interior)
                    expected.row(v) -=
                        options.time_step * mean_curvature_vector(mesh, topology, mesh.vertices, laplacian, v);
            CHECK(flowed(mesh, options) == expected);
        }
}

TEST_CASE("the largest explicit step is the square of the shortest edge that can move")
{
    const PolygonMesh grid = test::quad_grid(4, 3);
    CHECK(largest_explicit_step(grid, make_topology(grid), 0.5 * grid.vertices) == 0.25);
    const PolygonMesh fixed = test::quad_grid(1, 3);
    CHECK(std::isinf(largest_explicit_step(fixed, make_topology(fixed), fixed.vertices)));
}

TEST_CASE("small explicit steps go where backward Euler goes, and the reference is backward Euler")
{
    PolygonMesh mesh = make_quads(900);
    FlowOptions options = explicit_options(mesh, 0.02);
    options.steps = 20;
    options.report.reference = true;
    const PolygonMesh before = mesh;
    const FlowReport report = mean_curvature_flow(mesh, options);
    REQUIRE(report.steps.size() == 20);
    const double moved = (mesh.vertices - before.vertices).rowwise().norm().mean();
    CHECK(report.steps.back().distance->mean > 0.0);
    CHECK(report.steps.back().distance->mean < 0.05 * moved);
}

TEST_CASE("a fifth of the limit is stable on a grid, three fifths are not, and the report says so")
{
    const PolygonMesh grid = make_quads(900, {.noise = 0.1});
    const auto change_of_curvature = [&](double part, bool remarked) {
        PolygonMesh mesh = grid;
        FlowOptions options = explicit_options(mesh, part);
        options.steps = 3;
        const FlowReport report = mean_curvature_flow(mesh, options);
        CHECK(report.remarks.empty() != remarked);
        return report.steps.back().max_mean_curvature_after / report.steps.front().max_mean_curvature_before;
    };
    CHECK(change_of_curvature(0.2, false) < 0.9);
    CHECK(change_of_curvature(0.6, true) > 1.5);
}

TEST_CASE("a time step above the limit is refused, and the message names the largest stable one")
{
    PolygonMesh mesh = test::quad_torus(8, 8);
    const Points before = mesh.vertices;
    FlowOptions options = explicit_options(mesh, 1.0);
    CHECK_NOTHROW(flowed(mesh, options));
    options = explicit_options(mesh, 1.01);
    CHECK_THROWS_WITH_AS(mean_curvature_flow(mesh, options), doctest::Contains("but must be at most"), OptionError);
    CHECK(mesh.vertices == before);
    options.steps = 0;
    CHECK_NOTHROW(flowed(mesh, options));
}

TEST_CASE("a flow goes on where its edges shrink below what its step needs, with a remark")
{
    PolygonMesh mesh = make_mixed_polygons(3000);
    FlowOptions options = explicit_options(mesh, 0.2);
    options.steps = 10;
    const FlowReport report = mean_curvature_flow(mesh, options);
    REQUIRE(report.remarks.size() == 1);
    CHECK(sentence(report.remarks.front()).find("shrunk") != std::string::npos);
    CHECK(mesh.vertices.allFinite());
}

TEST_CASE("a result that is not finite ends the flow at the last complete step")
{
    // A cube whose corners the first step takes to its centre, exactly.
    PolygonMesh cube;
    cube.vertices.resize(8, 3);
    for (Index v = 0; v < 8; ++v)
        cube.vertices.row(v) << ((v & 1) != 0 ? 1 : -1), ((v & 2) != 0 ? 1 : -1), ((v & 4) != 0 ? 1 : -1);
    for (const auto& face : std::vector<std::vector<Index>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
        cube.add_face(face);
    FlowOptions options = explicit_options(cube, 0.5);
    options.steps = 3;
    CHECK_THROWS_WITH_AS(mean_curvature_flow(cube, options), doctest::Contains("step 2"), ComputationError);
    CHECK(cube.vertices.cwiseAbs().maxCoeff() == 0.0);
}

TEST_CASE("explicit steps know no sub-meshes")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    FlowOptions options = explicit_options(mesh, 0.2);
    options.steps = 5;
    const Points expected = flowed(mesh, options);
    options.cut.subdomains = 7;
    options.interface.conditions = Conditions::Schwarz;
    PolygonMesh cut = mesh;
    const FlowReport report = mean_curvature_flow(cut, options);
    CHECK(cut.vertices == expected);
    CHECK(report.cut.n_sub_meshes() == 1);
    CHECK(report.cut.labels == std::vector<Index>(mesh.n_faces(), 0));
}
