// Which vertices move: a free boundary, vertices that are held.

#include <algorithm>
#include <numeric>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "partition/topology.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

FlowOptions constrained_options(Laplacian laplacian, Index subdomains)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.time_step = 0.002;
    options.steps = 3;
    options.cut.subdomains = subdomains;
    return options;
}

std::vector<PolygonMesh> open_meshes()
{
    return {make_triangles(900),      make_quads(900),    make_hexagons(900),
            make_mixed_polygons(900), make_cylinder(900), moebius_band(30, 8)};
}

/// Every k-th vertex.
std::vector<Index> every(Index k, Index n_vertices)
{
    std::vector<Index> vertices;
    for (Index v = 0; v < n_vertices; v += k)
        vertices.push_back(v);
    return vertices;
}

bool same_bits(const Points& a, const Points& b, Index v)
{
    return (a.row(v).array() == b.row(v).array()).all();
}

}  // namespace

TEST_CASE("with a free boundary the converged flow in many sub-meshes is the undecomposed one, and boundaries move")
{
    for (const PolygonMesh& mesh : open_meshes())
        for (const Laplacian laplacian : symmetric_laplacians) {
            CAPTURE(name_of(laplacian));
            FlowOptions options = constrained_options(laplacian, 1);
            options.motion.boundary = Boundary::Free;
            PolygonMesh undecomposed = mesh;
            const FlowReport report = mean_curvature_flow(undecomposed, options);
            CHECK_FALSE(report.convergence.tolerance);
            CHECK(report.mesh.fixed_vertices == 0);
            const Topology topology = make_topology(mesh);
            for (Index v = 0; v < mesh.n_vertices(); ++v)
                CHECK_FALSE(same_bits(undecomposed.vertices, mesh.vertices, v));

            options.accuracy.tolerance = 1e-11;
            for (const Index subdomains : {2, 7, 20}) {
                options.cut.subdomains = subdomains;
                PolygonMesh moved = mesh;
                const FlowReport cut = mean_curvature_flow(moved, options);
                CHECK(cut.convergence.steps_short_of_tolerance == 0);
                CHECK(largest_difference(moved.vertices, undecomposed.vertices) < 1e-9);
            }
        }
}

TEST_CASE("with a free boundary the centre of mass stays where it is")
{
    // The equations are M (V' - V) = -dt S V', and the columns of S add up to zero.
    PolygonMesh mesh = make_quads(900);
    mesh.vertices.col(2).setZero();
    FlowOptions options = constrained_options(Laplacian::AlexaWardetzky, 1);
    options.motion.boundary = Boundary::Free;
    options.steps = 1;
    const Topology topology = make_topology(mesh);
    std::vector<double> mass(mesh.n_vertices(), 0.0);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (const Index v : mesh.face(f))
            mass[v] += vector_area(mesh.face(f), mesh.vertices).norm() / static_cast<double>(mesh.face(f).size());
    const Points moved = flowed(mesh, options);
    const auto total = Eigen::Map<const Eigen::VectorXd>(mass.data(), static_cast<Eigen::Index>(mass.size()));
    CHECK((total.transpose() * (moved - mesh.vertices)).cwiseAbs().maxCoeff() < 1e-13);
    CHECK(largest_difference(moved, mesh.vertices) > 0.01);
}

TEST_CASE("sub-meshes that share a free boundary are converged unless sweeps are asked for, which are refused")
{
    FlowOptions options = constrained_options(Laplacian::Fujiwara, 4);
    options.motion.boundary = Boundary::Free;
    PolygonMesh open = make_triangles(900);
    const FlowReport report = mean_curvature_flow(open, options);
    CHECK(report.convergence.tolerance.has_value());
    REQUIRE_FALSE(report.choices.empty());
    CHECK(sentence(report.choices.front()).find("free boundary") != std::string::npos);
    options.accuracy.approach = Approach::Sweep;
    CHECK_THROWS_AS(mean_curvature_flow(open, options), OptionError);
    // Sub-meshes that share no boundary may sweep.
    PolygonMesh closed = make_noisy_sphere(900);
    CHECK_FALSE(mean_curvature_flow(closed, options).convergence.tolerance);
    PolygonMesh two = side_by_side({make_triangles(400), make_quads(400)});
    options.cut.labels.assign(two.n_faces(), 1);
    std::fill_n(options.cut.labels.begin(), make_triangles(400).n_faces(), 0);
    CHECK_FALSE(mean_curvature_flow(two, options).convergence.tolerance);
    options.cut.labels.clear();
    options.laplacian = Laplacian::PtackovaVelho;
    CHECK_THROWS_AS(mean_curvature_flow(two, options), OptionError);
}

TEST_CASE("an explicit step moves a free boundary as a short implicit one does")
{
    const PolygonMesh mesh = make_triangles(400);
    for (const Laplacian laplacian : symmetric_laplacians) {
        FlowOptions options = constrained_options(laplacian, 1);
        options.motion.boundary = Boundary::Free;
        options.steps = 1;
        options.time_step = 1e-8;
        const Points implicit = flowed(mesh, options);
        options.scheme = Scheme::ExplicitEuler;
        const Points explicit_step = flowed(mesh, options);
        const double moved = largest_difference(implicit, mesh.vertices);
        CHECK(moved > 1e-8);
        CHECK(largest_difference(implicit, explicit_step) < 1e-3 * moved);
    }
}

TEST_CASE("held vertices do not move by a bit, and the rest flows as if they were a boundary")
{
    for (const PolygonMesh& mesh : {make_triangles(900), make_quads(900), make_noisy_sphere(900)})
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(name_of(laplacian));
            const std::vector<Index> held = every(7, mesh.n_vertices());
            FlowOptions options = constrained_options(laplacian, 1);
            options.motion.fixed_vertices = held;
            PolygonMesh undecomposed = mesh;
            const FlowReport report = mean_curvature_flow(undecomposed, options);
            CHECK(report.mesh.fixed_vertices >= static_cast<Index>(held.size()));
            Index n_moved = 0;
            for (Index v = 0; v < mesh.n_vertices(); ++v) {
                const bool same = same_bits(undecomposed.vertices, mesh.vertices, v);
                n_moved += same ? 0 : 1;
                if (v % 7 == 0)
                    CHECK(same);
            }
            CHECK(n_moved == mesh.n_vertices() - report.mesh.fixed_vertices);
            for (const Index subdomains : {2, 9}) {
                options.cut.subdomains = subdomains;
                const Points swept = flowed(mesh, options);
                CHECK(swept.allFinite());
                for (const Index v : held)
                    CHECK(same_bits(swept, mesh.vertices, v));
                FlowOptions converged = options;
                converged.accuracy.tolerance = 1e-10;
                CHECK(largest_difference(flowed(mesh, converged), undecomposed.vertices) < 1e-7);
            }
        }
}

TEST_CASE("holding every vertex leaves the mesh as it is; holding none that exists is refused")
{
    const PolygonMesh mesh = make_noisy_sphere(400);
    FlowOptions options = constrained_options(Laplacian::Fujiwara, 4);
    options.motion.fixed_vertices.resize(mesh.n_vertices());
    std::iota(options.motion.fixed_vertices.begin(), options.motion.fixed_vertices.end(), 0);
    CHECK(flowed(mesh, options) == mesh.vertices);
    for (const Index v : {-1, mesh.n_vertices()}) {
        options.motion.fixed_vertices = {0, v};
        PolygonMesh moved = mesh;
        CHECK_THROWS_AS(mean_curvature_flow(moved, options), InputError);
        CHECK(moved.vertices == mesh.vertices);
    }
}

TEST_CASE("degenerate vertices are held and the rest flows, or the mesh is refused where that is asked for")
{
    PolygonMesh mesh = make_triangles(900);
    const auto corners = mesh.face(700);
    mesh.vertices.row(corners[0]) = mesh.vertices.row(corners[1]);
    for (const Laplacian laplacian : geometric_laplacians)
        for (const Index subdomains : {1, 2, 8})
            for (const bool converged : {false, true}) {
                CAPTURE(name_of(laplacian));
                CAPTURE(subdomains);
                FlowOptions options = constrained_options(laplacian, subdomains);
                options.steps = 2;
                if (converged)
                    options.accuracy.tolerance = 1e-6;
                PolygonMesh moved = mesh;
                const FlowReport report = mean_curvature_flow(moved, options);
                CHECK(moved.vertices.allFinite());
                CHECK(same_bits(moved.vertices, mesh.vertices, corners[0]));
                CHECK(same_bits(moved.vertices, mesh.vertices, corners[1]));
                CHECK(largest_difference(moved.vertices, mesh.vertices) > 1e-4);
                CHECK(count_with(report.remarks, "leave the Laplacian undefined there") == 1);
                options.motion.strict = true;
                PolygonMesh refused = mesh;
                CHECK_THROWS_AS(mean_curvature_flow(refused, options), InputError);
                CHECK(refused.vertices == mesh.vertices);
            }
}

TEST_CASE("strict refuses what is not manifold, and nothing that is sound")
{
    FlowOptions options = constrained_options(Laplacian::Fujiwara, 1);
    options.motion.strict = true;
    PolygonMesh wings = three_wings();
    CHECK_THROWS_AS(mean_curvature_flow(wings, options), InputError);
    PolygonMesh sound = make_quads(400);
    const Points strict = flowed(sound, options);
    options.motion.strict = false;
    CHECK(flowed(sound, options) == strict);
    CHECK_NOTHROW(mean_curvature_flow(wings, options));
}

TEST_CASE("where no vertex could move because the Laplacian is nowhere defined the mesh is refused")
{
    PolygonMesh mesh = quad_grid(2, 2);
    mesh.vertices.row(4) = mesh.vertices.row(5);
    FlowOptions options;
    options.time_step = 0.1;
    options.cut.subdomains = 1;
    CHECK_THROWS_AS(mean_curvature_flow(mesh, options), InputError);
    // A second vertex that can.
    mesh = quad_grid(3, 2);
    mesh.vertices.row(5) = mesh.vertices.row(4);
    const FlowReport report = mean_curvature_flow(mesh, options);
    REQUIRE(report.remarks.size() == 1);
    CHECK(sentence(report.remarks[0]).find("1 vertex is held fixed") != std::string::npos);
}
