#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/flipped_faces.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/vector_area.h"
#include "samples/meshes/meshes.h"
#include "solvers/denoising/mesh_denoiser.h"
#include "solvers/denoising/thinned_mesh.h"
#include "solvers/denoising/vertex_averages.h"
#include "tests/support/denoising.h"
#include "tests/support/random_meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

Topology with_free_rims(const PolygonMesh& mesh)
{
    Topology topology = make_topology(mesh);
    free_boundary(topology);
    return topology;
}

/// Noise along the normals that is the mean of that of the vertices around each, several times.
/// @param sigma in mean edges.
PolygonMesh with_correlated_noise(const PolygonMesh& truth, double sigma, int rounds, std::uint32_t seed)
{
    const Topology topology = make_topology(truth);
    const VertexAverages around(truth, topology);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<double> noise(usize(truth.n_vertices()));
    std::ranges::generate(noise, [&] { return normal(random); });
    for (int round = 0; round < rounds; ++round) {
        const std::vector<double> before = noise;
        for (Index v = 0; v < truth.n_vertices(); ++v) {
            for (const Index w : around.neighbours()[v])
                noise[v] += before[w];
            noise[v] /= static_cast<double>(1 + around.neighbours()[v].size());
        }
    }
    double squares = 0.0;
    for (const double one : noise)
        squares += one * one;
    const double scale = sigma * mean_edge_length(truth) * std::sqrt(truth.n_vertices() / squares);
    PolygonMesh noisy = truth;
    for (Index v = 0; v < truth.n_vertices(); ++v) {
        Point normals = Point::Zero();
        for (const Index corner : topology.corners_at(v))
            normals += vector_area(truth.face(topology.face_of[corner]), truth.vertices);
        noisy.vertices.row(v) += scale * noise[v] * normals.normalized();
    }
    return noisy;
}

PolygonMesh denoised(const PolygonMesh& mesh, const Executor& exec = run_in_parallel)
{
    PolygonMesh result = mesh;
    result.vertices = MeshDenoiser(mesh, with_free_rims(mesh), exec).denoise(mesh.vertices, {}, exec);
    return result;
}

}  // namespace

TEST_CASE("a thinned mesh has a quarter of the vertices, none beside another, and every other beside one")
{
    for (const char* kind : {"triangles", "gear", "noisy-sphere"}) {
        CAPTURE(kind);
        const PolygonMesh mesh = make_mesh(kind, 4000);
        Topology topology = with_free_rims(mesh);
        topology.fixed[100] = topology.fixed[101] = topology.fixed[102] = 1;
        const VertexAverages around(mesh, topology);
        std::vector<int> n_chosen(usize(mesh.n_vertices()), 0);
        for (int round = 0; round < 6; ++round) {
            const ThinnedMesh thinned = thin_out(mesh, topology, around.neighbours(), mesh.vertices, n_chosen,
                                                 static_cast<std::uint64_t>(round));
            std::vector<std::uint8_t> is_in(n_chosen.size(), 0);
            for (const Index v : thinned.vertices)
                is_in[v] = 1;
            CHECK(std::ranges::is_sorted(thinned.vertices));
            for (Index v = 0; v < mesh.n_vertices(); ++v) {
                const bool is_near =
                    std::ranges::any_of(around.neighbours()[v], [&](Index w) { return is_in[w] != 0; });
                CHECK(is_near != (is_in[v] != 0));
            }
            CHECK(thinned.vertices.size() == test::relative(mesh.n_vertices() / 4.0, 0.2));
            CHECK(thinned.mesh.n_faces() == test::relative(mesh.n_faces() / 4.0, 0.25));
            CHECK(thinned.mesh.vertices == mesh.vertices(thinned.vertices, Eigen::all));
            Index n_moving = 0;
            for (Index i = 0; i < thinned.mesh.n_vertices(); ++i)
                if (const Index v = thinned.vertices[i]; thinned.topology.moves(i)) {
                    ++n_moving;
                    CHECK(topology.moves(v));
                    CHECK(thinned.topology.kind[i] == topology.kind[v]);
                }
            CHECK(n_moving > thinned.mesh.n_vertices() / 2);
            for (const Index v : thinned.vertices)
                ++n_chosen[v];
        }
        CHECK(std::ranges::count(n_chosen, 0) <= mesh.n_vertices() / 1000);
    }
}

TEST_CASE("which vertices are left depends on where they are, not on their order or the unit of length")
{
    const PolygonMesh mesh = make_noisy_sphere(3000, {.amplitude = 0.1, .noise = 0.0});
    const auto left = [](const PolygonMesh& of, std::uint64_t round) {
        const Topology topology = with_free_rims(of);
        const VertexAverages around(of, topology);
        return thin_out(of, topology, around.neighbours(), of.vertices, std::vector<int>(usize(of.n_vertices()), 0),
                        round);
    };
    auto [other, number] = test::shuffled(mesh, 5);
    other.vertices *= 0.25;
    std::vector<Index> of_mesh = left(mesh, 3).vertices;
    for (Index& v : of_mesh)
        v = number[v];
    std::ranges::sort(of_mesh);
    CHECK(of_mesh == left(other, 3).vertices);
    CHECK(left(mesh, 3).vertices != left(mesh, 4).vertices);
    CHECK(left(mesh, 3).mesh.n_faces() == left(other, 3).mesh.n_faces());
}

TEST_CASE("correlated noise goes, from flat parts and curved surfaces, and no face turns over")
{
    struct Case {
        PolygonMesh truth;
        double sigma;
        int rounds;
        /// Of the angle of the noisy surface.
        double left;
    };
    const PolygonMesh gear = make_mesh("gear", 20'000);
    const PolygonMesh sphere = make_noisy_sphere(20'000, {.amplitude = 0.1, .noise = 0.0});
    for (const Case& one : {Case{gear, 0.1, 1, 0.3},
                            {gear, 0.3, 1, 0.4},
                            {sphere, 0.1, 1, 0.4},
                            {sphere, 0.3, 1, 0.25},
                            {sphere, 0.3, 3, 0.5}}) {
        CAPTURE(one.sigma);
        CAPTURE(one.rounds);
        const PolygonMesh noisy = with_correlated_noise(one.truth, one.sigma, one.rounds, 3);
        const PolygonMesh result = denoised(noisy);
        CHECK(test::angle_to_truth(one.truth, result) < one.left * test::angle_to_truth(one.truth, noisy));
        CHECK(
            folded_faces(noisy, noisy.vertices, result.vertices, flipped_faces(noisy, noisy.vertices, result.vertices))
                .empty());
        if (one.rounds > 1)
            CHECK(denoised(noisy, run_serially).vertices == result.vertices);
    }
}

TEST_CASE("where noise is independent thinned meshes take no part, nor where there is none beside")
{
    const PolygonMesh truth = make_noisy_sphere(12'000, {.amplitude = 0.1, .noise = 0.0});
    const PolygonMesh white = test::with_gaussian_noise(truth, 0.2, 3);
    const PolygonMesh alike = with_correlated_noise(truth, 0.3, 1, 3);
    const Points of_white = denoised(white).vertices;
    const Points of_alike = denoised(alike).vertices;
    PolygonMesh all;
    all.vertices.resize(3 * truth.n_vertices(), 3);
    const std::array<const PolygonMesh*, 3> parts{&white, &truth, &alike};
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const auto first = static_cast<Index>(p) * truth.n_vertices();
        all.vertices.middleRows(first, truth.n_vertices()) = parts[p]->vertices;
        all.vertices.middleRows(first, truth.n_vertices()).col(0).array() += 8.0 * static_cast<double>(p);
        for (Index f = 0; f < truth.n_faces(); ++f) {
            const auto face = truth.face(f);
            all.add_face(std::array{first + face[0], first + face[1], first + face[2]});
        }
    }
    PolygonMesh result = denoised(all);
    const auto part = [&](Index p) {
        Points of_part = result.vertices.middleRows(p * truth.n_vertices(), truth.n_vertices());
        of_part.col(0).array() -= 8.0 * p;
        return of_part;
    };
    const double edge = mean_edge_length(truth);
    CHECK((part(0) - of_white).rowwise().norm().mean() < 1e-3 * edge);
    CHECK(result.vertices.middleRows(truth.n_vertices(), truth.n_vertices()) ==
          all.vertices.middleRows(truth.n_vertices(), truth.n_vertices()));
    PolygonMesh of_third = truth;
    of_third.vertices = part(2);
    PolygonMesh alone = truth;
    alone.vertices = of_alike;
    CHECK(test::angle_to_truth(truth, of_third) == test::relative(test::angle_to_truth(truth, alone), 0.1));
}
