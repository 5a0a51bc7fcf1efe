#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/metrics/vertex_normals.h"
#include "samples/meshes/meshes.h"
#include "solvers/denoising/chebyshev.h"
#include "solvers/denoising/denoising_amount.h"
#include "solvers/denoising/mesh_denoiser.h"
#include "tests/support/denoising.h"
#include "tests/support/random_meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

constexpr Index n_terms_of_filters = 60;

/// The mesh after the filter, whole: it has fewer than thirty thousand vertices.
PolygonMesh filtered(PolygonMesh mesh, double amount)
{
    const FilterSample sample = take_filter_sample(mesh, make_topology(mesh));
    Signals signals = Signals::Zero(mesh.n_vertices(), 4);
    signals.leftCols<3>() = mesh.vertices;
    const Eigen::VectorXd coefficients = ChebyshevExpansion(n_terms_of_filters).coefficients([&](double eigenvalue) {
        return 1.0 / (1.0 + std::pow(amount * eigenvalue, 3));
    });
    mesh.vertices.setZero();
    visit_chebyshev_basis(sample, signals, n_terms_of_filters,
                          [&](Index j, const Signals& term) { mesh.vertices += coefficients[j] * term.leftCols<3>(); });
    return mesh;
}

/// Root mean square along the normals of the first.
double distance(const PolygonMesh& from, const PolygonMesh& to)
{
    const Topology topology = make_topology(from);
    const VertexNormals normals(from, topology);
    double sum = 0.0;
    Index n = 0;
    for (Index v = 0; v < from.n_vertices(); ++v)
        if (topology.moves(v)) {
            const Point move = to.vertices.row(v) - from.vertices.row(v);
            sum += std::pow(move.dot(normals(v, from.vertices)), 2);
            ++n;
        }
    return std::sqrt(sum / n);
}

/// Root mean square of the moves along the normals of the result.
double moved(const PolygonMesh& from, const PolygonMesh& to)
{
    return distance(to, from);
}

double noise_along_normals(double sigma, const PolygonMesh& mesh)
{
    return sigma / std::sqrt(3.0) * mean_edge_length(mesh);
}

DenoisingAmount amount_for(const PolygonMesh& mesh, double noise)
{
    return denoising_amount(mesh, make_topology(mesh), noise);
}

bool is_same(const DenoisingAmount& one, const DenoisingAmount& other)
{
    return one.amount == other.amount && one.risk == other.risk && one.move == other.move;
}

/// The faces between the cubes of a lattice whose centres are inside a ball and those outside.
PolygonMesh ball_of_cubes(double radius, bool as_triangles)
{
    const auto n = static_cast<Index>(2.0 * radius) + 5;
    const auto is_inside = [&](const std::array<Index, 3>& cube) {
        const Eigen::Array3d from_centre = Eigen::Array3i(cube[0], cube[1], cube[2]).cast<double>() - (radius + 2.37);
        return from_centre.matrix().norm() < radius;
    };
    std::map<std::array<Index, 3>, Index> numbers;
    PolygonMesh mesh;
    const auto add = [&](const std::array<std::array<Index, 3>, 4>& corners) {
        std::array<Index, 4> face{};
        for (std::size_t k = 0; k < face.size(); ++k)
            face[k] = numbers.try_emplace(corners[k], static_cast<Index>(numbers.size())).first->second;
        if (!as_triangles)
            return mesh.add_face(face);
        mesh.add_face(std::array{face[0], face[1], face[2]});
        mesh.add_face(std::array{face[0], face[2], face[3]});
    };
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j)
            for (Index k = 0; k < n; ++k)
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const std::array<Index, 3> here{i, j, k};
                    std::array<Index, 3> next = here;
                    ++next[axis];
                    if (is_inside(here) == is_inside(next))
                        continue;
                    std::array<std::array<Index, 3>, 4> corners{next, next, next, next};
                    ++corners[1][(axis + 1) % 3];
                    ++corners[2][(axis + 1) % 3];
                    ++corners[2][(axis + 2) % 3];
                    ++corners[3][(axis + 2) % 3];
                    if (is_inside(next))
                        std::swap(corners[1], corners[3]);
                    add(corners);
                }
    mesh.vertices.resize(static_cast<Index>(numbers.size()), 3);
    for (const auto& [place, v] : numbers)
        mesh.vertices.row(v) << place[0], place[1], place[2];
    return mesh;
}

}  // namespace

TEST_CASE("the amount does not jump between a ball of cubes of triangles and of quadrilaterals, or of another size")
{
    // In units of the cubes.
    std::vector<double> reaches;
    for (const double radius : {9.2, 12.3, 16.1})
        for (const bool as_triangles : {false, true}) {
            const PolygonMesh ball = ball_of_cubes(radius, as_triangles);
            const double noise = measure_noise(ball, make_topology(ball)).deviation;
            reaches.push_back(std::sqrt(amount_for(ball, noise).amount) * mean_edge_length(ball));
        }
    const auto [least, most] = std::ranges::minmax(reaches);
    CHECK(least > 0.0);
    CHECK(most < 1.2 * least);
}

TEST_CASE("the amount comes nearest to the true surface, and the distance left is known")
{
    for (const PolygonMesh& truth :
         {make_triangles(8000), make_quads(8000), make_hexagons(8000), make_mixed_polygons(8000), make_cylinder(6000),
          make_noisy_sphere(6000, {.noise = 0.0}), make_noisy_sphere(3000, {.waves = 9, .noise = 0.0}),
          make_box(3000)}) {
        for (const double sigma : {0.1, 0.3}) {
            CAPTURE(truth.n_vertices());
            CAPTURE(sigma);
            const PolygonMesh noisy = test::with_gaussian_noise(truth, sigma, 1);
            const double noise = noise_along_normals(sigma, truth);
            const DenoisingAmount found = amount_for(noisy, noise);
            REQUIRE(found.amount > 0.0);
            const double left = distance(truth, filtered(noisy, found.amount));
            double least = left;
            for (double amount = 0.3; amount < 12.0; amount *= 1.2)
                least = std::min(least, distance(truth, filtered(noisy, amount)));
            CHECK(left < 1.08 * least);
            CHECK(left < 0.9 * distance(truth, noisy));
            // In squares, over that of the noise.
            CHECK(std::abs(found.risk - left * left) < 0.1 * noise * noise);
            CHECK(found.move <= noise);
            CHECK(found.move == test::relative(moved(noisy, filtered(noisy, found.amount)), 0.06));
            CHECK(found.move > 0.3 * noise);
            // Where only the estimate is known, the result is not much worse, and much better than before.
            const double estimated = measure_noise(noisy, make_topology(noisy)).deviation;
            CHECK(distance(truth, filtered(noisy, amount_for(noisy, estimated).amount)) < 1.5 * least);
        }
    }
}

TEST_CASE("nothing is smoothed without noise, nor where smoothing takes more off the shape than noise")
{
    const PolygonMesh part = make_gear(3000);
    CHECK(amount_for(part, 0.0).amount == 0.0);
    CHECK(amount_for(part, -1.0).amount == 0.0);
    const double noise = 1e-3 * mean_edge_length(part);
    const DenoisingAmount none = amount_for(part, noise);
    CHECK(none.amount == 0.0);
    CHECK(none.move == 0.0);
    CHECK(none.risk == noise * noise);
}

TEST_CASE("something is smoothed only where it is clear that it comes nearer to the truth")
{
    int n_left = 0;
    int n_smoothed = 0;
    for (const Index vertices : {250, 350, 500, 800, 1500})
        for (const double sigma : {0.01, 0.02, 0.03, 0.05, 0.08, 0.12}) {
            CAPTURE(vertices);
            CAPTURE(sigma);
            const PolygonMesh truth = make_noisy_sphere(vertices, {.waves = 7, .noise = 0.0});
            const double noise = noise_along_normals(sigma, truth);
            const DenoisingAmount found = amount_for(test::with_gaussian_noise(truth, sigma, 6), noise);
            (found.amount > 0.0 ? n_smoothed : n_left) += 1;
            CHECK((found.amount == 0.0 || found.risk < 0.9 * noise * noise));
        }
    CHECK(n_left > 3);
    CHECK(n_smoothed > 3);
}

TEST_CASE("meshes in which nothing moves have no amount")
{
    CHECK(amount_for(PolygonMesh{}, 1.0).amount == 0.0);
    CHECK(amount_for(test::triangle_grid(1, 5), 0.1).amount == 0.0);
    PolygonMesh sheet = make_triangles(900);
    Topology topology = make_topology(sheet);
    std::vector<Index> all(usize(sheet.n_vertices()));
    std::iota(all.begin(), all.end(), Index{0});
    fix_vertices(topology, all);
    CHECK(denoising_amount(sheet, topology, 0.1).amount == 0.0);
}

TEST_CASE("the amount does not depend on threads, scale, place or direction")
{
    const PolygonMesh noisy = test::with_gaussian_noise(make_mixed_polygons(9000), 0.2, 2);
    const double noise = noise_along_normals(0.2, noisy);
    const DenoisingAmount found = amount_for(noisy, noise);
    REQUIRE(found.amount > 0.0);
    CHECK(is_same(denoising_amount(noisy, make_topology(noisy), noise, run_in_parallel), found));
    PolygonMesh other = noisy;
    for (const double scale : {0x1p-30, 0x1p20}) {
        other.vertices = scale * noisy.vertices;
        const DenoisingAmount scaled = amount_for(other, scale * noise);
        CHECK(is_same(scaled, {found.amount, scale * scale * found.risk, scale * found.move}));
    }
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
    other.vertices = (noisy.vertices * rotation.transpose()).rowwise() + Eigen::RowVector3d(30.0, -4.0, 70.0);
    CHECK(amount_for(other, noise).amount / found.amount == test::relative(1.0, 1e-4));
}

TEST_CASE("patches of a large mesh say what the whole says, and do not depend on threads")
{
    const PolygonMesh one = test::with_gaussian_noise(make_noisy_sphere(20'000, {.noise = 0.0}), 0.2, 3);
    const PolygonMesh three = test::side_by_side({one, one, one});
    const double noise = noise_along_normals(0.2, one);
    const DenoisingAmount of_three = amount_for(three, noise);
    CHECK(std::abs(of_three.amount / amount_for(one, noise).amount - 1.0) < 0.2);
    CHECK(is_same(denoising_amount(three, make_topology(three), noise, run_in_parallel), of_three));
}

TEST_CASE("the amount hardly depends on the order of vertices")
{
    const PolygonMesh noisy = test::with_gaussian_noise(make_triangles(9000), 0.2, 4);
    const double noise = noise_along_normals(0.2, noisy);
    const PolygonMesh shuffled = test::shuffled(noisy, 5).mesh;
    CHECK(std::abs(amount_for(shuffled, noise).amount / amount_for(noisy, noise).amount - 1.0) < 0.1);
}
