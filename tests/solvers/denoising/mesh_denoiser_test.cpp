#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "solvers/denoising/denoised_normals.h"
#include "solvers/denoising/filter_sample.h"
#include "solvers/denoising/flatter_normals.h"
#include "solvers/denoising/mesh_denoiser.h"
#include "solvers/denoising/vertex_averages.h"
#include "solvers/normals/face_neighbours.h"
#include "tests/support/denoising.h"
#include "tests/support/random_meshes.h"
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

/// How the rims of a tube are closed: by one polygon, by triangles from one vertex, or in a zigzag.
enum class Lid { Polygon, Fan, Zigzag };

void close(PolygonMesh& mesh, std::span<const Index> rim, Lid lid)
{
    if (lid == Lid::Polygon)
        return mesh.add_face(rim);
    std::size_t first = lid == Lid::Fan ? 1 : 0;
    std::size_t last = rim.size() - 1;
    for (; lid == Lid::Fan && first < last; ++first)
        mesh.add_face(std::array{rim[0], rim[first], rim[first + 1]});
    for (bool from_first = true; first + 1 < last; from_first = !from_first) {
        mesh.add_face(std::array{rim[first], from_first ? rim[first + 1] : rim[last - 1], rim[last]});
        (from_first ? first : last) += from_first ? 1 : std::size_t{0} - 1;
    }
}

/// A ball whose triangles are long and thin at the poles, with all its meridians in one vertex each.
PolygonMesh globe(Index meridians, Index parallels)
{
    PolygonMesh mesh;
    mesh.vertices.resize(2 + meridians * parallels, 3);
    mesh.vertices.row(0) << 0.0, 0.0, 1.0;
    mesh.vertices.row(1) << 0.0, 0.0, -1.0;
    const auto at = [&](Index i, Index k) { return Index(2 + i * meridians + k % meridians); };
    for (Index i = 0; i < parallels; ++i)
        for (Index k = 0; k < meridians; ++k) {
            const double polar = std::numbers::pi * (i + 1) / (parallels + 1);
            const double angle = 2.0 * std::numbers::pi * k / meridians;
            mesh.vertices.row(at(i, k)) << std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                std::cos(polar);
        }
    for (Index k = 0; k < meridians; ++k) {
        mesh.add_face(std::array{Index{0}, at(0, k), at(0, k + 1)});
        for (Index i = 0; i + 1 < parallels; ++i) {
            mesh.add_face(std::array{at(i, k), at(i + 1, k), at(i + 1, k + 1)});
            mesh.add_face(std::array{at(i, k), at(i + 1, k + 1), at(i, k + 1)});
        }
        mesh.add_face(std::array{Index{1}, at(parallels - 1, k + 1), at(parallels - 1, k)});
    }
    return mesh;
}

}  // namespace

TEST_CASE("noise goes from long thin triangles and from their poles, and the surface is not drawn to the larger ones")
{
    const PolygonMesh truth = globe(128, 63);
    PolygonMesh noisy = truth;
    std::mt19937 random(5);
    std::normal_distribution<double> lengths(0.0, 0.01);
    for (auto place : noisy.vertices.rowwise())
        place *= 1.0 + lengths(random);
    const Topology topology = make_topology(noisy);
    const Points result = MeshDenoiser(noisy, topology).denoise(noisy.vertices);
    const auto distance = [](const Points& positions) {
        return std::sqrt((positions.rowwise().norm().array() - 1.0).square().mean());
    };
    CHECK(distance(result) < 0.2 * distance(noisy.vertices));
}

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

TEST_CASE("vertices of faces that reach far go no further than others, however these are cut into triangles")
{
    constexpr Index m = 256;
    constexpr Index n = 20;
    constexpr double edge = 2.0 * std::numbers::pi / m;
    PolygonMesh tube = test::cylinder(m, n);
    tube.vertices.col(2) *= edge;
    for (const double sigma : {0.1, 0.3})
        for (const Lid lid : {Lid::Polygon, Lid::Fan, Lid::Zigzag}) {
            CAPTURE(sigma);
            CAPTURE(static_cast<int>(lid));
            PolygonMesh noisy = test::with_gaussian_noise(tube, sigma, 3);
            std::vector<Index> rim(usize(m));
            std::iota(rim.rbegin(), rim.rend(), Index{0});
            close(noisy, rim, lid);
            std::iota(rim.begin(), rim.end(), m * n);
            close(noisy, rim, lid);
            const Topology topology = make_topology(noisy);
            const Points result = MeshDenoiser(noisy, topology).denoise(noisy.vertices);
            // From the circles of the rims, and from the side.
            const auto error = [&](const Points& positions, Index v) {
                const double out = positions.row(v).head<2>().norm() - 1.0;
                const bool on_rim = v < m || v >= m * n;
                return on_rim ? std::hypot(out, positions(v, 2) - tube.vertices(v, 2)) : std::abs(out);
            };
            const auto squares = [&](const Points& positions, Index begin, Index end) {
                double total = 0.0;
                for (Index v = begin; v < end; ++v)
                    total += error(positions, v) * error(positions, v);
                return total;
            };
            CHECK((result - noisy.vertices).rowwise().norm().maxCoeff() < (1.0 + 5.0 * sigma) * edge);
            CHECK(squares(result, 0, m) < 1.05 * squares(noisy.vertices, 0, m));
            CHECK(squares(result, m * n, m * n + m) < 1.05 * squares(noisy.vertices, m * n, m * n + m));
            // Beside a fan, noise of a tenth of an edge is not told from how the surface bends.
            if (sigma > 0.1 || lid != Lid::Fan)
                CHECK(squares(result, m, m * n) < 0.4 * squares(noisy.vertices, m, m * n));
        }
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
        for (const double sigma : {0.05, i % 2 == 0 ? 0.1 : 0.2, 0.4}) {
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
    CHECK(noise_of(test::shuffled(noisy, 5).mesh).deviation / noise.deviation == test::relative(1.0, 0.03));
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

TEST_CASE(
    "with little noise parts come much nearer to the truth where normals diffuse between edges, others no less near")
{
    const auto angle = [](const PolygonMesh& truth, const PolygonMesh& noisy, std::optional<double> edge_angle) {
        PolygonMesh result = noisy;
        const Topology topology = make_topology(noisy);
        result.vertices = MeshDenoiser(noisy, topology, run_serially, edge_angle).denoise(noisy.vertices);
        return test::angle_to_truth(truth, result);
    };
    for (const double sigma : {0.05, 0.1, 0.2}) {
        CAPTURE(sigma);
        const double most = sigma < 0.15 ? 0.75 : 1.02;
        for (const PolygonMesh& part : {make_box(3000), make_gear(3000), make_chamfered_plate(3000)}) {
            CAPTURE(part.n_faces());
            const PolygonMesh noisy = test::with_gaussian_noise(part, sigma, 3);
            CHECK(angle(part, noisy, 30.0) < most * angle(part, noisy, {}));
        }
        for (const PolygonMesh& body : {bumpy_sphere(3000), make_noisy_sphere(642, {.amplitude = 0.0, .noise = 0.0})}) {
            CAPTURE(body.n_faces());
            const PolygonMesh noisy = test::with_gaussian_noise(body, sigma, 3);
            CHECK(angle(body, noisy, 30.0) < 1.02 * angle(body, noisy, {}));
        }
    }
    // With more noise single normals are better estimated.
    const PolygonMesh noisy = test::with_gaussian_noise(make_gear(3000), 0.9, 3);
    const Topology topology = make_topology(noisy);
    CHECK(MeshDenoiser(noisy, topology, run_serially, {}).denoise(noisy.vertices) ==
          MeshDenoiser(noisy, topology).denoise(noisy.vertices));
}

TEST_CASE("a sample says whether normals of a large surface diffuse between edges, too")
{
    const auto denoised = [](const PolygonMesh& noisy, std::optional<double> edge_angle) {
        PolygonMesh result = noisy;
        const Topology topology = make_topology(noisy);
        result.vertices =
            MeshDenoiser(noisy, topology, run_in_parallel, edge_angle).denoise(noisy.vertices, {}, run_in_parallel);
        return result;
    };
    constexpr Index vertices = 55'000;
    const PolygonMesh part = make_gear(vertices);
    const PolygonMesh noisy_part = test::with_gaussian_noise(part, 0.1, 3);
    CHECK(test::angle_to_truth(part, denoised(noisy_part, 30.0)) <
          0.75 * test::angle_to_truth(part, denoised(noisy_part, {})));
    const PolygonMesh noisy = test::with_gaussian_noise(bumpy_sphere(vertices), 0.1, 3);
    CHECK(denoised(noisy, 30.0).vertices == denoised(noisy, {}).vertices);
}

TEST_CASE("where normals diffuse between edges, neither a second part of another size matters nor threads")
{
    const PolygonMesh part = test::with_gaussian_noise(make_gear(3000), 0.05, 3);
    PolygonMesh other = test::with_gaussian_noise(make_box(2000), 0.1, 5);
    other.vertices *= 100.0;
    const PolygonMesh both = test::together({part, other});
    const Topology topology = make_topology(part);
    const Topology of_both = make_topology(both);
    const Points alone = MeshDenoiser(part, topology).denoise(part.vertices);
    const Points beside = MeshDenoiser(both, of_both).denoise(both.vertices).topRows(part.n_vertices());
    // Rounding may decide at a place.
    CHECK((beside - alone).rowwise().norm().maxCoeff() < 5e-3 * mean_edge_length(part));
    CHECK(MeshDenoiser(part, topology, run_in_parallel).denoise(part.vertices, {}, run_in_parallel) == alone);
}

TEST_CASE("under much noise facets become flatter than the estimated normals are")
{
    struct Case {
        PolygonMesh part;
        /// In degrees: between the angle that is left and that without flatter normals.
        double most;
    };
    for (const Case& one :
         {Case{make_box(8000), 0.84}, Case{make_gear(8000), 3.24}, Case{make_chamfered_plate(8000), 3.48}}) {
        CAPTURE(one.part.n_faces());
        PolygonMesh result = with_noise(one.part, 0.3);
        const Topology topology = make_topology(result);
        result.vertices = MeshDenoiser(result, topology).denoise(result.vertices);
        CHECK(test::angle_to_truth(one.part, result) < one.most);
    }
}

TEST_CASE("normals become flatter on facets alone, where there is noise, whichever way faces turn and on any threads")
{
    const auto n_changed = [](const PolygonMesh& mesh, double share) {
        const Topology topology = make_topology(mesh);
        const VertexAverages averages(mesh, topology);
        const std::vector<std::int8_t> signs = face_signs(mesh, topology);
        const std::vector<double> shares(usize(mesh.n_vertices()), share);
        const NoisySurface surface{mesh, topology, averages, signs, mesh.vertices, shares};
        const DenoisedNormals estimated = denoise_normals(mesh, topology, mesh.vertices);
        DenoisedNormals found = estimated;
        DenoisedNormals found_in_parallel = estimated;
        const bool is_any = take_flatter_normals(surface, found);
        CHECK(take_flatter_normals(surface, found_in_parallel, run_in_parallel) == is_any);
        CHECK(found_in_parallel.normals == found.normals);
        CHECK(is_any == (found.normals != estimated.normals));
        return ((found.normals - estimated.normals).rowwise().norm().array() > 0.0).count();
    };
    const PolygonMesh box = with_noise(make_box(8000), 0.3);
    CHECK(static_cast<double>(n_changed(box, 1.0)) > 0.95 * box.n_faces());
    CHECK(static_cast<double>(n_changed(test::with_faces_flipped(box, 5), 1.0)) > 0.95 * box.n_faces());
    CHECK(n_changed(box, 0.0) == 0);
    CHECK(n_changed(with_noise(make_box(8000), 0.1), 1.0) == 0);
    CHECK(n_changed(with_noise(test::triangle_torus(100, 50), 0.3), 1.0) == 0);
    CHECK(n_changed(with_noise(bumpy_sphere(3000), 0.3), 1.0) == 0);
}
