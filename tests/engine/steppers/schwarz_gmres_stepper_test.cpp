#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"

using namespace seamflow;
using test::flowed;

namespace {

FlowOptions krylov_options(Index subdomains, double tolerance = 1e-11)
{
    FlowOptions options;
    options.laplacian = Laplacian::PtackovaVelho;
    options.time_step = 0.002;
    options.steps = 2;
    options.cut.subdomains = subdomains;
    options.accuracy.tolerance = tolerance;
    return options;
}

FlowOptions undecomposed()
{
    FlowOptions options = krylov_options(1);
    options.accuracy.tolerance.reset();
    return options;
}

}  // namespace

TEST_CASE("converged, the flow of Ptáčková and Velho's Laplacian in many sub-meshes is the undecomposed flow")
{
    for (const PolygonMesh& mesh :
         {make_triangles(900), make_quads(900), make_hexagons(900), make_mixed_polygons(900), make_cylinder(900)}) {
        const Points expected = flowed(mesh, undecomposed());
        for (const Index subdomains : {1, 2, 7, 30}) {
            CAPTURE(subdomains);
            PolygonMesh moved = mesh;
            const FlowReport report = mean_curvature_flow(moved, krylov_options(subdomains));
            CHECK(test::largest_difference(moved.vertices, expected) < 1e-8);
            CHECK(report.remarks.empty());
            for (const StepReport& step : report.steps) {
                CHECK(step.residual.value() <= 1e-11);
                CHECK(step.estimated_v_max.value() < 1e-6);
            }
        }
    }
}

TEST_CASE("smooth flows take few iterations, and their distance is estimated, rather too large than too small")
{
    for (const PolygonMesh& mesh : {make_quads(2000), make_hexagons(2000), make_mixed_polygons(2000)})
        for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
            CAPTURE(tolerance);
            PolygonMesh moved = mesh;
            FlowOptions options = krylov_options(12, tolerance);
            options.steps = 1;
            options.report.reference = true;
            const StepReport step = mean_curvature_flow(moved, options).steps.front();
            CHECK(step.iterations.value() < 25);
            const double distance = step.distance.value().max / step.distance.value().mean_edge;
            CHECK(step.estimated_v_max.value() > distance / 5.0);
            CHECK(step.estimated_v_max.value() < 100.0 * distance);
        }
}

TEST_CASE("iterations that run out are said")
{
    PolygonMesh mesh = make_quads(2000);
    FlowOptions few = krylov_options(12);
    few.accuracy.converge_iterations = 2;
    const FlowReport report = mean_curvature_flow(mesh, few);
    CHECK(mesh.vertices.allFinite());
    for (const StepReport& step : report.steps) {
        CHECK(step.iterations == 2);
        CHECK(step.residual > 1e-11);
    }
    CHECK(report.convergence.steps_short_of_tolerance == 2);
    CHECK(report.convergence.steps_stagnated == 0);
    REQUIRE_FALSE(report.remarks.empty());
    CHECK(report.remarks.back() == "The tolerance was not reached in 2 steps with 2 iterations at most: use fewer "
                                   "sub-meshes or a smaller time step.");
}

TEST_CASE("steps that iterations no longer bring closer to the tolerance are said to have stagnated")
{
    // So long a step that the sub-meshes' equations are nearly singular.
    PolygonMesh mesh = make_hexagons(900);
    FlowOptions options = krylov_options(5, 1e-15);
    options.time_step = 100.0;
    options.steps = 1;
    options.accuracy.converge_iterations = 5000;
    options.accuracy.largest_update = std::numeric_limits<double>::infinity();
    const FlowReport report = mean_curvature_flow(mesh, options);
    CHECK(mesh.vertices.allFinite());
    CHECK(report.steps.front().residual > 1e-14);
    CHECK(report.steps.front().iterations < 5000);
    CHECK(report.convergence.steps_short_of_tolerance == 1);
    CHECK(report.convergence.steps_stagnated == 1);
    REQUIRE_FALSE(report.remarks.empty());
    const auto speaks_of_it = [](const std::string& remark) {
        return remark.find("in 1 of them more would not have helped") != std::string::npos;
    };
    CHECK(std::ranges::any_of(report.remarks, speaks_of_it));
}

TEST_CASE("converged steps by GMRES give the same bits for every number of threads")
{
    for (const PolygonMesh& mesh : {make_mixed_polygons(3000), make_triangles(3000)}) {
        FlowOptions options = krylov_options(24, 1e-8);
        options.accuracy.converge_iterations = 40;
        options.resources.threads = 1;
        const Points expected = flowed(mesh, options);
        for (const int threads : {2, 5}) {
            CAPTURE(threads);
            options.resources.threads = threads;
            const Points found = flowed(mesh, options);
            CHECK(std::memcmp(found.data(), expected.data(), static_cast<std::size_t>(found.size()) * sizeof(double)) ==
                  0);
        }
    }
}

TEST_CASE("the boundary keeps its bits, a flat mesh stays where it is, and one with nothing to move too")
{
    PolygonMesh mesh = make_quads(900);
    mesh.vertices.col(2).setConstant(5.0);
    PolygonMesh moved = mesh;
    CHECK(mean_curvature_flow(moved, krylov_options(6)).remarks.empty());
    CHECK((moved.vertices.col(2).array() - 5.0).abs().maxCoeff() < 1e-13);
    PolygonMesh triangle;
    triangle.vertices.resize(3, 3);
    triangle.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    triangle.add_face(std::array<Index, 3>{0, 1, 2});
    CHECK(flowed(triangle, krylov_options(1)) == triangle.vertices);
}

TEST_CASE("a limit of memory that all factorisations fit into is kept, a lower one refused")
{
    PolygonMesh mesh = make_quads(400);
    FlowOptions options = krylov_options(4);
    options.resources.memory_limit = 100;
    CHECK_THROWS_AS(mean_curvature_flow(mesh, options), OptionError);
    options.resources.memory_limit = 100'000'000;
    CHECK_NOTHROW(mean_curvature_flow(mesh, options));
}
