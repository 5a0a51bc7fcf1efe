#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "partition/topology.h"
#include "partition/vector_area.h"
#include "solvers/denoising/rim_filter.h"
#include "solvers/laplacian/geometry.h"
#include "tests/support/denoising.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

/// The faces of a grid of n by n squares whose centroids fulfil a condition on x and y from the middle of the grid.
template <class Condition>
PolygonMesh cut_of_grid(Index n, Condition&& is_inside)
{
    const PolygonMesh grid = test::triangle_grid(n, n);
    const Point middle(0.5 * static_cast<double>(n), 0.5 * static_cast<double>(n), 0.0);
    PolygonMesh cut;
    std::vector<Index> number_of(usize(grid.n_vertices()), -1);
    std::vector<Index> vertices;
    std::vector<std::vector<Index>> faces;
    for (Index f = 0; f < grid.n_faces(); ++f) {
        const Point at = centroid(grid.face(f), grid.vertices) - middle;
        if (!is_inside(at.x(), at.y()))
            continue;
        std::vector<Index>& face = faces.emplace_back();
        for (const Index v : grid.face(f)) {
            if (number_of[v] < 0) {
                number_of[v] = static_cast<Index>(vertices.size());
                vertices.push_back(v);
            }
            face.push_back(number_of[v]);
        }
    }
    cut.vertices = grid.vertices(vertices, Eigen::all).rowwise() - middle;
    for (const std::vector<Index>& face : faces)
        cut.add_face(face);
    return cut;
}

/// Where a filter moves a flat mesh.
/// @param part of the surface that has noise.
Points filtered(const PolygonMesh& mesh, bool is_free = true, double part = 0.0)
{
    Topology topology = make_topology(mesh);
    if (is_free)
        free_boundary(topology);
    Points up = Points::Zero(mesh.n_faces(), 3);
    up.col(2).setOnes();
    const std::vector<double> shares(usize(mesh.n_vertices()), part);
    return mesh.vertices + RimFilter(mesh, topology).motions(mesh, topology, up, shares, mesh.vertices);
}

/// The root mean square of a distance from the true rim over the vertices of the boundary, and its mean.
template <class Distance>
std::pair<double, double> from_rim(const PolygonMesh& mesh, const Points& positions, Distance&& distance)
{
    const Topology topology = make_topology(mesh);
    double squares = 0.0;
    double total = 0.0;
    double count = 0.0;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (topology.kind[v] == VertexKind::Boundary) {
            const double d = distance(Point(positions.row(v)));
            squares += d * d;
            total += d;
            count += 1.0;
        }
    return {std::sqrt(squares / count), total / count};
}

}  // namespace

TEST_CASE("stairs of a rim become a smooth curve of the same place, on a surface without noise")
{
    constexpr double radius = 25.3;
    const PolygonMesh disc = cut_of_grid(60, [&](double x, double y) { return std::hypot(x, y) < radius; });
    const auto distance = [&](const Point& p) { return std::hypot(p.x(), p.y()) - radius; };
    const Points moved = filtered(disc);
    CHECK(from_rim(disc, disc.vertices, distance).first > 0.25);
    CHECK(from_rim(disc, moved, distance).first < 0.12);
    CHECK(std::abs(from_rim(disc, moved, distance).second) < 0.06);
    double inside = 0.0;
    for (Index v = 0; v < disc.n_vertices(); ++v)
        if (std::hypot(disc.vertices(v, 0), disc.vertices(v, 1)) < radius - 6.0)
            inside = std::max(inside, (moved.row(v) - disc.vertices.row(v)).norm());
    CHECK(inside == 0.0);
    for (Index f = 0; f < disc.n_faces(); ++f)
        CHECK(vector_area(disc.face(f), moved).z() > 0.0);
    // Held, it stays.
    CHECK(filtered(disc, false).cwiseEqual(disc.vertices).all());
}

TEST_CASE("a rim loses its noise within the surface and keeps its corners")
{
    PolygonMesh square = test::triangle_grid(60, 40);
    const Points truth = square.vertices;
    for (const std::uint32_t seed : {4U, 5U}) {
        square.vertices = truth;
        square.vertices = test::with_gaussian_noise(square, 0.2, seed).vertices;
        square.vertices.col(2).setZero();
        const Points moved = filtered(square, true, 1.0);
        const Topology topology = make_topology(square);
        const auto distance_from_rim = [&](const Points& where) {
            double squares = 0.0;
            for (Index v = 0; v < square.n_vertices(); ++v)
                if (topology.kind[v] == VertexKind::Boundary)
                    for (int x = 0; x < 2; ++x)
                        if (const double at_rim = truth(v, x);
                            at_rim == truth.col(x).minCoeff() || at_rim == truth.col(x).maxCoeff())
                            squares += std::pow(where(v, x) - at_rim, 2);
            return std::sqrt(squares);
        };
        CHECK(distance_from_rim(moved) < 0.75 * distance_from_rim(square.vertices));
    }
}

TEST_CASE("rims that are made as they are stay bit for bit")
{
    const auto stays = [](const PolygonMesh& mesh) {
        for (const double part : {0.0, 1.0})
            if (!filtered(mesh, true, part).cwiseEqual(mesh.vertices).all())
                return false;
        return true;
    };
    CHECK(stays(test::triangle_grid(30, 40)));
    // A comb with teeth of three edges, an L, and stairs that are all alike.
    CHECK(stays(cut_of_grid(60, [](double x, double y) {
        return std::abs(x) < 24.0 && y > -20.0 && y < (std::fmod(x + 30.0, 6.0) < 3.0 ? 20.0 : 17.0);
    })));
    CHECK(stays(cut_of_grid(
        60, [](double x, double y) { return std::abs(x) < 24.0 && std::abs(y) < 20.0 && (x < 0.0 || y < 0.0); })));
    CHECK(stays(cut_of_grid(60, [](double x, double y) { return std::abs(x) + std::abs(y) < 25.2; })));
    // A toothed wheel: 60 teeth of four vertices.
    PolygonMesh wheel;
    constexpr Index n = 240;
    constexpr Index rings = 8;
    wheel.vertices.resize(n * rings, 3);
    for (Index r = 0; r < rings; ++r)
        for (Index i = 0; i < n; ++i) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / n;
            const double radius = 31.0 + static_cast<double>(r) + (r + 1 == rings && i % 4 < 2 ? 1.0 : 0.0);
            wheel.vertices.row(r * n + i) = radius * Point(std::cos(angle), std::sin(angle), 0.0);
        }
    for (Index r = 0; r + 1 < rings; ++r)
        for (Index i = 0; i < n; ++i) {
            const Index next = i + 1 < n ? i + 1 : 0;
            wheel.add_face(std::vector{r * n + i, (r + 1) * n + i, (r + 1) * n + next, r * n + next});
        }
    CHECK(stays(wheel));
}
