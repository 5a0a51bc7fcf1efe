#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <doctest/doctest.h>

#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/normals/face_neighbours.h"
#include "solvers/normals/normal_diffusion.h"
#include "solvers/normals/vertex_fit.h"
#include "tests/support/denoising.h"
#include "tests/support/flows.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

Points smoothed(const PolygonMesh& mesh, double time_step, double angle)
{
    return NormalDiffusion(mesh, make_topology(mesh)).smoothed(mesh.vertices, time_step, angle);
}

/// Triangles around the origin, as many as asked for, and as many further out.
PolygonMesh two_rings(Index n)
{
    PolygonMesh mesh;
    mesh.vertices.setZero(2 * n + 1, 3);
    const auto around = [&](Index k) { return 1 + k % n; };
    for (Index k = 0; k < n; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / n;
        mesh.vertices.row(around(k)) << std::cos(angle), std::sin(angle), 0.0;
        mesh.vertices.row(n + around(k)) = 2.0 * mesh.vertices.row(around(k));
        mesh.add_face(std::array{Index{0}, around(k), around(k + 1)});
        mesh.add_face(std::array{around(k), Index(n + around(k)), Index(n + around(k + 1)), around(k + 1)});
    }
    return mesh;
}

}  // namespace

TEST_CASE("the neighbours of a face share a vertex with it; through a vertex of many faces some")
{
    const PolygonMesh grid = test::quad_grid(5, 5);
    const FaceNeighbours of_grid = make_face_neighbours(grid, make_topology(grid));
    for (Index f = 0; f < grid.n_faces(); ++f)
        for (Index g = 0; g < grid.n_faces(); ++g) {
            const bool share =
                std::ranges::any_of(grid.face(f), [&](Index v) { return std::ranges::count(grid.face(g), v) > 0; });
            CHECK(std::ranges::count(of_grid[f], g) == (share && f != g ? 1 : 0));
        }
    const PolygonMesh few = two_rings(24);
    CHECK(make_face_neighbours(few, make_topology(few))[0].size() == 23 + 3);
    const PolygonMesh many = two_rings(250);
    CHECK(make_face_neighbours(many, make_topology(many))[0].size() == 23 + 2 + 3);
}

TEST_CASE("signs turn all faces to the same side")
{
    const PolygonMesh mesh = make_noisy_sphere(300);
    CHECK(face_signs(mesh, make_topology(mesh)).empty());
    const PolygonMesh flipped = test::with_faces_flipped(mesh, 3);
    const auto signs = face_signs(flipped, make_topology(flipped));
    REQUIRE(signs.size() == usize(mesh.n_faces()));
    const auto side = [&](Index f) {
        return signs[f] * vector_area(flipped.face(f), mesh.vertices).dot(centroid(mesh.face(f), mesh.vertices));
    };
    for (Index f = 1; f < mesh.n_faces(); ++f)
        CHECK(side(f) * side(0) > 0.0);
}

TEST_CASE("normals diffuse as by the Laplacian of the surface where nothing stops them")
{
    for (const bool quads : {false, true}) {
        const HeightFieldShape waves{.amplitude = 1e-4, .waves = 2};
        const PolygonMesh mesh = quads ? make_quads(6400, waves) : make_triangles(6400, waves);
        // Without noise all that bends is shape, and stops them.
        PolygonMesh noisy = mesh;
        noisy.vertices.col(2) += 0.02 * (test::with_gaussian_noise(mesh, 0.05, 1).vertices - mesh.vertices).col(2);
        const double squared_wave_number = 2.0 * std::pow(2.0 * std::numbers::pi * waves.waves, 2);
        const double time_step = 0.5 / squared_wave_number;
        const Points normals = smoothed(noisy, time_step, 90.0);
        double before = 0.0;
        double after = 0.0;
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            const Point offset = centroid(mesh.face(f), mesh.vertices) - Point(0.5, 0.5, 0.0);
            const Point normal = vector_area(mesh.face(f), mesh.vertices).normalized();
            if (offset.head<2>().cwiseAbs().maxCoeff() > 0.25)
                continue;
            before += normal.head<2>().squaredNorm();
            after += normals.row(f).head<2>().dot(normal.head<2>());
        }
        // Four backward Euler steps.
        CHECK(after / before == test::relative(std::pow(1.0 + 0.5 / 4.0, -4.0), 0.08));
    }
}

TEST_CASE("true normals come back from noise, sharp edges and corners included")
{
    for (const char* kind : {"box", "box-quads", "chamfered-plate-quads"}) {
        CAPTURE(kind);
        const PolygonMesh truth = make_mesh(kind, 6000);
        const PolygonMesh noisy = test::with_gaussian_noise(truth, 0.15, 1);
        const double edge = mean_edge_length(truth, truth.vertices);
        const Points normals = smoothed(noisy, 16.0 * edge * edge, 30.0);
        double sum = 0.0;
        for (Index f = 0; f < truth.n_faces(); ++f) {
            CHECK(normals.row(f).norm() == test::relative(1.0, 1e-5));
            const Point normal = vector_area(truth.face(f), truth.vertices).normalized();
            sum += std::acos(std::min(normal.dot(normals.row(f)), 1.0)) * 180.0 / std::numbers::pi;
        }
        CHECK(sum / truth.n_faces() < 1.0);
    }
}

TEST_CASE("edges sharper than the angle stay as they are, others do not where there is as much noise")
{
    // Two planes that meet at x = 0.5 with 45° between them.
    PolygonMesh roof = make_quads(900, {.amplitude = 0.0});
    const double slope = std::tan(std::numbers::pi / 8.0);
    roof.vertices.col(2) = -slope * (roof.vertices.col(0).array() - 15.0 / 29.0).abs();
    const double edge = mean_edge_length(roof, roof.vertices);
    const auto turned = [&](double angle) {
        const Points normals = smoothed(roof, 16.0 * edge * edge, angle);
        double most = 0.0;
        for (Index f = 0; f < roof.n_faces(); ++f)
            most = std::max(most, (normals.row(f) - vector_area(roof.face(f), roof.vertices).normalized()).norm());
        return most * 180.0 / std::numbers::pi;
    };
    CHECK(turned(30.0) < 0.5);
    CHECK(turned(120.0) < 1e-9);
    roof = test::with_gaussian_noise(roof, 0.3, 1);
    CHECK(turned(30.0) > 5.0);
}

TEST_CASE("faces without area get no normal, and the others finite ones")
{
    PolygonMesh mesh = make_triangles(400);
    mesh.vertices.row(210) = mesh.vertices.row(211);
    const Points normals = smoothed(mesh, 0.01, 30.0);
    REQUIRE(normals.allFinite());
    Index without = 0;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        without += normals.row(f).isZero(0.0) ? 1 : 0;
    CHECK(without == 2);
    mesh.vertices.setZero();
    CHECK(smoothed(mesh, 0.01, 30.0).isZero(0.0));
}

TEST_CASE("vertices that fit their normals stay, others go to where they fit")
{
    const PolygonMesh truth = make_mesh("box", 2000);
    const Topology topology = make_topology(truth);
    Topology moving = topology;
    Points normals(truth.n_faces(), 3);
    for (Index f = 0; f < truth.n_faces(); ++f)
        normals.row(f) = vector_area(truth.face(f), truth.vertices).normalized();
    const PolygonMesh noisy = test::with_gaussian_noise(truth, 0.2, 1);
    PolygonMesh result = truth;
    fit_vertices(truth, moving, FeatureLines(), {normals, 0.1}, result.vertices);
    CHECK(test::compare_with_truth(truth, result).distance < 1e-3);
    result.vertices = noisy.vertices;
    fit_vertices(truth, moving, FeatureLines(), {normals, 0.1}, result.vertices);
    CHECK(test::angle_to_truth(truth, result) < 0.2);
    moving.fixed.assign(moving.fixed.size(), 1);
    result.vertices = noisy.vertices;
    fit_vertices(truth, moving, FeatureLines(), {normals, 0.1}, result.vertices);
    CHECK(result.vertices == noisy.vertices);
}

TEST_CASE("heights of whole numbers have as much noise as the same ones before rounding; stairs and strips have none")
{
    constexpr Index width = 50;
    const auto noise_of = [](const PolygonMesh& mesh) {
        NormalDiffusion diffusion(mesh, make_topology(mesh));
        (void)diffusion.smoothed(mesh.vertices, 1.0, 60.0);
        return diffusion.noise();
    };
    const auto with_heights = [&](PolygonMesh mesh, auto&& height) {
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            mesh.vertices.row(v) << v % width, v / width, height(v % width, v / width);
        return mesh;
    };
    const PolygonMesh triangles = test::triangle_grid(width - 1, width - 1);
    const PolygonMesh rough = with_heights(triangles, [random = std::mt19937(1)](double x, double y) mutable {
        return 0.5 * x + 0.3 * y + std::normal_distribution<double>(0.0, 0.6)(random);
    });
    const PolygonMesh rounded =
        with_heights(rough, [&, v = Index{0}](double, double) mutable { return std::round(rough.vertices(v++, 2)); });
    CHECK(noise_of(rounded) > 0.3 * noise_of(rough));
    CHECK(noise_of(rounded) < 3.0 * noise_of(rough));
    // Steps that are five wide, and bends of less than the angle between strips of two triangles.
    CHECK(noise_of(with_heights(triangles, [](double x, double) { return 0.4 * std::floor(x / 5.0) * 5.0; })) < 1e-6);
    CHECK(noise_of(with_heights(triangles, [](double x, double) { return 0.004 * x * x; })) < 1e-6);
}
