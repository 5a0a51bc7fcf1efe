#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "solvers/denoising/filter_sample.h"
#include "solvers/denoising/mesh_denoiser.h"
#include "tests/support/denoising.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

SurfaceNoise noise_of(const PolygonMesh& mesh, const Executor& exec = run_serially)
{
    return measure_noise(mesh, make_topology(mesh), exec);
}

PolygonMesh bumpy_sphere(Index vertices)
{
    return make_noisy_sphere(vertices, {.amplitude = 0.1, .noise = 0.0});
}

/// With noise along random directions, so that a third of its variance is along the normals.
/// @param sigma along the normals, in mean edges.
PolygonMesh with_noise(const PolygonMesh& truth, double sigma)
{
    return test::with_gaussian_noise(truth, std::sqrt(3.0) * sigma, 3);
}

PolygonMesh renumbered(PolygonMesh mesh)
{
    std::vector<Index> order(usize(mesh.n_vertices()));
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::shuffle(order, std::mt19937(5));
    const Points before = mesh.vertices;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        mesh.vertices.row(order[v]) = before.row(v);
    for (Index& v : mesh.face_vertices)
        v = order[v];
    return mesh;
}

}  // namespace

TEST_CASE("a flat lake, however much of a terrain it covers, and blocks without data do not hide the noise of the rest")
{
    PolygonMesh truth = make_quads(6400);
    truth.vertices *= 1.0 / mean_edge_length(truth);
    for (auto row : truth.vertices.rowwise())
        row.z() = 4.0 * std::sin(row.x() / 9.0) * std::cos(row.y() / 11.0);
    const double noise = noise_of(with_noise(truth, 0.13)).deviation;
    CHECK(noise > 0.1);
    for (const double level : {0.0, 2.0, 2.8}) {
        PolygonMesh mesh = with_noise(truth, 0.13);
        Index n_land = 0;
        for (Index v = 0; v < mesh.n_vertices(); ++v) {
            if (truth.vertices(v, 2) < level)
                mesh.vertices.row(v) << truth.vertices(v, 0), truth.vertices(v, 1), level;
            else
                ++n_land;
        }
        const SurfaceNoise found = noise_of(mesh);
        CHECK(found.deviation == test::relative(noise, 0.3));
        // The shore counts as land.
        CHECK(found.part == test::relative(static_cast<double>(n_land) / mesh.n_vertices(), 0.35));
    }
    PolygonMesh mesh = with_noise(truth, 0.13);
    for (const Index v : {2000, 2001, 3500, 5000, 5001})
        mesh.vertices(v, 2) = -9999.0;
    CHECK(noise_of(mesh).deviation == test::relative(noise, 0.05));
}

TEST_CASE("the noise of a mesh is measured from itself, from little to as large as the edges")
{
    std::vector<PolygonMesh> truths{make_hexagons(6000), make_quads(4000), bumpy_sphere(4000),
                                    test::triangle_torus(80, 40)};
    const std::size_t n_polygons = 2;
    for (const char* kind : {"gear", "box", "chamfered-plate"})
        truths.push_back(make_mesh(kind, 8000));
    for (std::size_t i = 0; i < truths.size(); ++i) {
        CAPTURE(i);
        const double edge = mean_edge_length(truths[i]);
        for (const double sigma : {0.05, 0.1, 0.2, 0.4}) {
            CAPTURE(sigma);
            const SurfaceNoise noise = noise_of(with_noise(truths[i], sigma));
            // On polygons more of a little noise stays.
            const bool polygons = i < n_polygons;
            CHECK(noise.deviation / (sigma * edge) == test::relative(1.0, !polygons ? 0.1 : sigma < 0.1 ? 0.4 : 0.15));
            CHECK(noise.edge / edge == test::relative(1.0, 0.2));
            CHECK(noise.part > 0.9);
        }
        CHECK(noise_of(truths[i]).deviation == 0.0);
        CHECK(noise_of(truths[i]).part == 0.0);
    }
}

TEST_CASE("patches of a large mesh say what the whole says, in any order of vertices and on any threads")
{
    // Rows of a grid whose length divides the number of vertices.
    PolygonMesh grid = test::triangle_grid(250, 200);
    for (Index v = 0; v < grid.n_vertices(); ++v)
        grid.vertices(v, 2) = 3.0 * std::sin(0.1 * grid.vertices(v, 0)) * std::cos(0.07 * grid.vertices(v, 1));
    const PolygonMesh noisy = with_noise(grid, 0.15);
    const Topology topology = make_topology(noisy);
    REQUIRE(static_cast<Index>(take_filter_sample(noisy, topology).vertices.size()) < noisy.n_vertices());
    MeshDenoiser whole(noisy, topology);
    whole.denoise(noisy.vertices);
    const SurfaceNoise noise = noise_of(noisy);
    CHECK(noise.deviation / whole.noise().deviation == test::relative(1.0, 0.03));
    CHECK(noise.part > 0.9);
    CHECK(noise_of(renumbered(noisy)).deviation / noise.deviation == test::relative(1.0, 0.03));
    CHECK(noise_of(noisy, run_in_parallel).deviation == noise.deviation);
    CHECK(noise_of(grid).deviation == 0.0);
}

TEST_CASE("noise is measured where it is, whatever else is in the file")
{
    const PolygonMesh noisy = with_noise(bumpy_sphere(3000), 0.2);
    PolygonMesh clean = bumpy_sphere(3000);
    clean.vertices = (100.0 * clean.vertices).rowwise() + Point(1e4, 0.0, 0.0);
    const SurfaceNoise alone = noise_of(noisy);
    const SurfaceNoise beside = noise_of(test::together({noisy, clean}));
    CHECK(beside.deviation / alone.deviation == test::relative(1.0, 1e-3));
    CHECK(beside.part == test::relative(0.5 * alone.part, 1e-3));
    // Bodies of other sizes with as much noise, measured by their edges.
    PolygonMesh large = noisy;
    large.vertices = (100.0 * noisy.vertices).rowwise() + Point(1e4, 0.0, 0.0);
    const SurfaceNoise both = noise_of(test::together({noisy, large}));
    CHECK(both.deviation / both.edge == test::relative(alone.deviation / alone.edge, 1e-3));
}

TEST_CASE("meshes of few faces, of none, and without size have no noise")
{
    CHECK(noise_of(PolygonMesh{}).part == 0.0);
    CHECK(noise_of(with_noise(test::triangle_grid(6, 6), 0.3)).part == 0.0);
    PolygonMesh point = make_box(600);
    point.vertices.setConstant(2.0);
    CHECK(noise_of(point).deviation == 0.0);
}

TEST_CASE("polygons lose as much noise as triangles")
{
    // Polygons left whole kept twice as much on hexagons.
    for (const PolygonMesh& truth : {make_quads(6000), make_hexagons(6000), make_mixed_polygons(6000)}) {
        CAPTURE(truth.n_faces());
        const PolygonMesh noisy = with_noise(truth, 0.2);
        const Topology topology = make_topology(noisy);
        PolygonMesh result = noisy;
        result.vertices = MeshDenoiser(noisy, topology).denoise(noisy.vertices);
        CHECK(test::angle_to_truth(truth, result) < 0.35 * test::angle_to_truth(truth, noisy));
    }
}
