#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "solvers/laplacian/geometry.h"
#include "tests/support/denoising.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"
#include "tests/support/random_meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::flowed;
using test::largest_difference;

namespace {

/// @param edges dt in squared mean edge lengths.
AllOptions edge_options(const PolygonMesh& mesh, double edges = 16.0, double angle = 30.0)
{
    AllOptions options;
    options.keep_edges = angle;
    options.time_step = edges * std::pow(mean_edge_length(mesh, mesh.vertices), 2);
    return options;
}

double total_area(const PolygonMesh& mesh, const Points& positions)
{
    double sum = 0.0;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        sum += area(mesh.face(f), positions);
    return sum;
}

/// What the best of some plain flows leaves.
double best_of_plain_flows(const PolygonMesh& truth, const PolygonMesh& noisy)
{
    double best = std::numeric_limits<double>::infinity();
    for (const double edges : {0.3, 0.6, 1.0, 1.6}) {
        PolygonMesh result = noisy;
        AllOptions options = edge_options(truth, edges);
        options.keep_edges.reset();
        smooth_surface(result, options);
        best = std::min(best, test::angle_to_truth(truth, result));
    }
    return best;
}

}  // namespace

TEST_CASE("much less is left of noise than by the plain flow, by Taubin and by bilateral normals, and volume stays")
{
    // Larger meshes, all noises and finer grids of parameters: see engine/accuracy.md.
    constexpr double part = 0.5;
    const test::BilateralGrid filters{{0.25, 0.35}, {30, 60}, {50}};
    for (const char* kind : {"box", "gear", "stepped-cylinder", "chamfered-plate"})
        for (const double noise : {0.05, 0.1, 0.2, 0.3}) {
            CAPTURE(kind);
            CAPTURE(noise);
            const PolygonMesh truth = make_mesh(kind, 8000);
            const PolygonMesh noisy = test::with_gaussian_noise(truth, noise, 1);
            PolygonMesh result = noisy;
            smooth_surface(result, edge_options(truth, 32.0));
            const test::Denoised left = test::compare_with_truth(truth, result);
            CHECK(left.angle < part * best_of_plain_flows(truth, noisy));
            CHECK(left.angle < part * test::angle_to_truth(truth, test::taubin_smoothed(noisy, 15)));
            CHECK(left.angle < test::angle_to_truth(truth, test::best_of_bilateral_filters(truth, noisy, filters)));
            CHECK(left.distance < 0.05);
            CHECK(std::abs(left.volume) < 3e-3);
        }
}

TEST_CASE("parts without noise keep their edges and corners, step after step")
{
    for (const char* kind : {"box", "gear-quads"}) {
        CAPTURE(kind);
        const PolygonMesh truth = make_mesh(kind, 3000);
        PolygonMesh result = truth;
        AllOptions options = edge_options(truth, 8.0);
        options.steps = 3;
        const FlowReport report = smooth_surface(result, options);
        const test::Denoised left = test::compare_with_truth(truth, result);
        CHECK(left.angle < 0.1);
        CHECK(left.distance < 0.005);
        CHECK(std::abs(left.volume) < 2e-3);
        CHECK(report.steps.size() == 3);
        CHECK(test::count_with(report.remarks, "Nothing was smoothed") == 1);
    }
}

TEST_CASE("steps of rounded heights go, though most faces lie in planes")
{
    constexpr Index n = 48;
    constexpr double radius = 38.0;
    PolygonMesh truth = test::triangle_grid(n, n);
    for (auto place : truth.vertices.rowwise())
        place[2] = std::sqrt(radius * radius - std::pow(place[0] - 0.5 * n, 2) - std::pow(place[1] - 0.5 * n, 2));
    for (const double step : {0.3, 0.5}) {
        CAPTURE(step);
        PolygonMesh result = truth;
        for (auto place : result.vertices.rowwise())
            place[2] = step * std::round(place[2] / step);
        const double before = test::angle_to_truth(truth, result);
        AllOptions options = edge_options(result, 8.0);
        options.motion.boundary = Boundary::Free;
        smooth_surface(result, options);
        CHECK(test::angle_to_truth(truth, result) < 0.25 * before);
    }
}

TEST_CASE("where vertices hardly move, a remark says that nothing was smoothed")
{
    PolygonMesh mesh = test::with_gaussian_noise(make_mesh("box", 3000), 1e-4, 1);
    const FlowReport report = smooth_surface(mesh, edge_options(mesh, 8.0));
    CHECK(test::count_with(report.remarks, "Nothing was smoothed") == 1);
}

TEST_CASE("a flat mesh stays flat to the bit; boundaries and fixed vertices stay")
{
    for (PolygonMesh mesh : test::height_fields()) {
        AllOptions options = edge_options(mesh);
        options.motion.fixed_vertices = {450, 451};
        const Points result = flowed(mesh, options);
        const Topology topology = make_topology(mesh);
        for (Index v = 0; v < mesh.n_vertices(); ++v) {
            const bool stays = topology.kind[v] != VertexKind::Interior || v == 450 || v == 451;
            CHECK((result.row(v) == mesh.vertices.row(v)) == stays);
        }
        mesh.vertices.col(2).setZero();
        CHECK(flowed(mesh, options).col(2).isZero(0.0));
    }
}

TEST_CASE("a free boundary is smoothed and does not draw in")
{
    PolygonMesh sheet = make_quads(2500, {.amplitude = 0.0, .noise = 0.2});
    const double edge = mean_edge_length(sheet, sheet.vertices);
    sheet.vertices.row(10).z() = 0.3 * edge;
    AllOptions options = edge_options(sheet);
    options.motion.boundary = Boundary::Free;
    const Points result = flowed(sheet, options);
    CHECK(std::abs(result(10, 2)) < 0.1 * edge);
    CHECK(total_area(sheet, result) > 0.999);
}

TEST_CASE("faces without area and surfaces with one side do no harm")
{
    PolygonMesh mesh = make_triangles(900);
    mesh.vertices.row(400) = mesh.vertices.row(401);
    CHECK(flowed(mesh, edge_options(mesh)).allFinite());
    const PolygonMesh band = test::moebius_band(20, 6);
    CHECK(flowed(band, edge_options(band)).allFinite());
    for (const test::NamedMesh& assorted : test::assorted_meshes())
        if (assorted.mesh.n_faces() > 0)
            CHECK(flowed(assorted.mesh, edge_options(assorted.mesh, 3.0)).allFinite());
    const PolygonMesh sphere = make_noisy_sphere(500);
    CHECK(flowed(sphere, edge_options(sphere, 1e30)).allFinite());
}

TEST_CASE("feature edges divide faces that would be smoothed together")
{
    // A round tube with a scratch drawn along it, where its faces hardly bend.
    PolygonMesh mesh = make_cylinder(900, {.noise = 0.1});
    const Topology topology = make_topology(mesh);
    AllOptions options = edge_options(mesh, 4.0);
    const Points without = flowed(mesh, options);
    for (Index v = mesh.n_vertices() / 2, steps = 0; steps < 6; ++steps) {
        const Index corner = topology.corners_at(v).front();
        const Index next = mesh.face_vertices[topology.next(mesh, topology.next(mesh, corner))];
        const Index beside = mesh.face_vertices[topology.next(mesh, corner)];
        options.motion.feature_edges.push_back({v, beside});
        options.motion.feature_edges.push_back({next, beside});
        v = next;
    }
    const Points with = flowed(mesh, options);
    CHECK(largest_difference(with, without) > 1e-3 * mean_edge_length(mesh, mesh.vertices));
    // Both ends of the line stay to the bit.
    CHECK(with.row(options.motion.feature_edges.front()[0]) == mesh.vertices.row(mesh.n_vertices() / 2));
}
