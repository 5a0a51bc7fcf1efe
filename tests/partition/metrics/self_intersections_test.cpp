#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/self_intersections.h"
#include "partition/metrics/triangle_crossing.h"
#include "partition/metrics/triangulation.h"
#include "samples/meshes/meshes.h"
#include "tests/support/random_meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

using Pairs = std::vector<FacePair>;

/// All pairs of faces, one after the other. How two triangles cross is for other tests.
Pairs brute_force(const PolygonMesh& mesh)
{
    std::vector<std::vector<TriangleCorners>> pieces(usize(mesh.n_faces()));
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        std::vector<Triangle> triangles;
        triangulate(mesh.face(f), mesh.vertices, triangles);
        for (const auto& [a, b, c] : triangles)
            pieces[f].push_back({mesh.vertices.row(a), mesh.vertices.row(b), mesh.vertices.row(c)});
    }
    Pairs pairs;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (Index g = f + 1; g < mesh.n_faces(); ++g)
            if (std::ranges::any_of(pieces[f], [&](const TriangleCorners& a) {
                    return std::ranges::any_of(pieces[g], [&](const TriangleCorners& b) { return cross(a, b); });
                }))
                pairs.push_back({f, g});
    return pairs;
}

/// Faces that share no vertices.
/// @param size of a face, where all are in a box of 2.
PolygonMesh soup(Index n_faces, int most_corners, double size, RandomNumbers& random)
{
    std::vector<Point> points;
    const auto point = [&] { return Point(random.symmetric(), random.symmetric(), random.symmetric()); };
    PolygonMesh mesh;
    for (Index f = 0; f < n_faces; ++f) {
        std::vector<Index> corners;
        const Point middle = point();
        for (int k = 3 + random.below(most_corners - 2); k > 0; --k) {
            corners.push_back(static_cast<Index>(points.size()));
            points.push_back(middle + size * point());
        }
        mesh.add_face(corners);
    }
    mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t v = 0; v < points.size(); ++v)
        mesh.vertices.row(static_cast<Eigen::Index>(v)) = points[v];
    return mesh;
}

/// A flat grid of m by n squares that is folded along its middle, the upper half at this height.
PolygonMesh folded_grid(Index m, Index n, double height)
{
    PolygonMesh mesh = quad_grid(m, n);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (mesh.vertices(v, 0) > 0.5 * m) {
            mesh.vertices(v, 0) = m - mesh.vertices(v, 0);
            mesh.vertices(v, 2) = height;
        }
    return mesh;
}

/// The same pairs with other numbers.
Pairs with_numbers(const Pairs& pairs, const std::vector<Index>& new_face)
{
    Pairs result;
    for (const auto& [f, g] : pairs)
        result.push_back({std::min(new_face[f], new_face[g]), std::max(new_face[f], new_face[g])});
    std::ranges::sort(result);
    return result;
}

}  // namespace

TEST_CASE("surfaces that do not cross themselves have no crossing faces")
{
    for (const PolygonMesh& mesh :
         {make_noisy_sphere(3000, {.noise = 0.0}), make_quads(900), make_hexagons(900), make_gear(900),
          make_cylinder(900), make_two_level_cylinder(900), quad_grid(7, 5), triangle_grid(5, 4), PolygonMesh{}})
        CHECK(self_intersections(mesh, mesh.vertices).empty());
}

TEST_CASE("a grid that is folded onto itself has as many crossings as squares that lie on each other")
{
    const PolygonMesh folded = folded_grid(12, 5, 0.0);
    const Pairs pairs = self_intersections(folded, folded.vertices);
    CHECK(pairs.size() == 30);
    CHECK(pairs == brute_force(folded));
    const PolygonMesh raised = folded_grid(12, 5, 0.125);
    CHECK(self_intersections(raised, raised.vertices).empty());
    // Moved along by half a square, each lies on six others, and on four at the end.
    PolygonMesh shifted = side_by_side({quad_grid(6, 1), quad_grid(6, 1)});
    for (Index v = shifted.n_vertices() / 2; v < shifted.n_vertices(); ++v)
        shifted.vertices.row(v) = shifted.vertices.row(v - shifted.n_vertices() / 2) + Point(0.5, 0, 0);
    for (const auto& [f, g] : self_intersections(shifted, shifted.vertices))
        CHECK((g - 6 == f || g - 6 == f - 1));
    CHECK(self_intersections(shifted, shifted.vertices).size() == 11);
}

TEST_CASE("loose faces cross as each pair of them does")
{
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        RandomNumbers random(seed);
        for (const auto& [n, corners, size] :
             {std::tuple(300, 3, 0.3), std::tuple(1000, 3, 0.08), std::tuple(200, 6, 0.3)}) {
            const PolygonMesh mesh = soup(n, corners, size, random);
            const Pairs pairs = self_intersections(mesh, mesh.vertices);
            CHECK(pairs.size() > 10);
            CHECK(pairs == brute_force(mesh));
        }
    }
}

namespace {

/// Triangles, and some quads, at two edges with a common vertex and through them.
/// @param n_angles many are at the same angle, on one side of the edge in the same plane or nearly so.
PolygonMesh crowded_edges(Index n_of_edge, int n_angles, std::uint32_t seed)
{
    RandomNumbers random(seed);
    std::vector<Point> points{Point(0, 0, 0), Point(0, 0, 1), Point(2, 0, 1)};
    PolygonMesh mesh = soup(40, 4, 0.8, random);
    const Index first = mesh.n_vertices();
    for (Index i = 0; i < 2 * n_of_edge; ++i) {
        const Index edge = i % 2;
        const double angle = 2.0 * std::numbers::pi * random.below(n_angles) / n_angles;
        const double radius = random.below(4) == 0 ? 0.3 : std::exp2(random.below(3));
        const Point upright = radius * Point(0, std::sin(angle), std::cos(angle));
        const Point end = edge == 0 ? Point(upright[2], upright[1], 0.25) : Point(0.5, upright[1], 1 + upright[2]);
        std::vector<Index> corners{first + edge, first + edge + 1, first + static_cast<Index>(points.size())};
        points.push_back(end);
        if (random.below(8) == 0) {
            corners.push_back(first + static_cast<Index>(points.size()));
            points.push_back(end - Point(0.1, 0.05, 0.3));
        }
        std::rotate(corners.begin(), corners.begin() + random.below(3), corners.end());
        mesh.add_face(corners);
    }
    mesh.vertices.conservativeResize(first + std::ssize(points), 3);
    for (std::size_t v = 0; v < points.size(); ++v)
        mesh.vertices.row(first + static_cast<Eigen::Index>(v)) = points[v];
    return mesh;
}

}  // namespace

TEST_CASE("many faces around an edge cross as each pair of them does")
{
    for (const std::uint32_t seed : {1U, 2U}) {
        for (const int n_angles : {200, 100000}) {
            const PolygonMesh mesh = crowded_edges(501, n_angles, seed);
            const Pairs pairs = self_intersections(mesh, mesh.vertices);
            const Pairs expected = brute_force(mesh);
            CHECK(pairs == expected);
            const Index first = 40;
            const auto at_one_edge = [&](const FacePair& p) { return p[0] >= first && (p[1] - p[0]) % 2 == 0; };
            if (n_angles == 200)
                CHECK(std::ranges::count_if(pairs, at_one_edge) > 500);
            CHECK(std::ranges::count_if(pairs, [&](const FacePair& p) { return !at_one_edge(p); }) > 500);
        }
    }
}

TEST_CASE("a hundred thousand faces around one edge are searched in seconds, and in one plane up to the limit")
{
    constexpr Index n = 100000;
    PolygonMesh mesh;
    mesh.vertices = Points::Zero(n + 2, 3);
    mesh.vertices(1, 2) = 1.0;
    for (Index i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        mesh.vertices.row(i + 2) = Point(std::cos(angle), std::sin(angle), 0.5);
        mesh.add_face(std::array<Index, 3>{1, i + 2, 0});
    }
    CHECK(self_intersections(mesh, mesh.vertices).empty());
    for (Index i = 0; i < n; ++i)
        mesh.vertices.row(i + 2) = Point(1.0, 0.0, 1.0 * i / n);
    CHECK(self_intersections(mesh, mesh.vertices).size() == most_self_intersections);
}

namespace {

/// Triangles in a closed ring around a vertex at this height over their middle.
PolygonMesh wheel(Index n, double height)
{
    PolygonMesh mesh;
    mesh.vertices.resize(n + 1, 3);
    for (Index i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        mesh.vertices.row(i) = Point(std::cos(angle), std::sin(angle), 0.0);
        mesh.add_face(std::array<Index, 3>{n, i, (i + 1) % n});
    }
    mesh.vertices.row(n) = Point(0.0, 0.0, height);
    return mesh;
}

}  // namespace

TEST_CASE("many faces around a vertex cross as each pair of them does")
{
    RandomNumbers random(4);
    // The last ones turn by wide angles.
    for (const auto& [height, noise, stride] :
         {std::tuple(0.5, 0.2, 1), std::tuple(0.0, 0.01, 1), std::tuple(0.0, 0.0, 1), std::tuple(0.3, 0.1, 311)}) {
        const Index n = 900;
        PolygonMesh mesh = wheel(n, height);
        for (Index i = 0; i < n; ++i)
            mesh.vertices.row(i) += noise * Point(random.symmetric(), random.symmetric(), random.symmetric());
        for (Index corner = 2; corner < mesh.n_corners(); corner += 3)
            mesh.face_vertices[corner] = (mesh.face_vertices[corner - 1] + stride) % n;
        const Pairs pairs = self_intersections(mesh, mesh.vertices);
        CHECK(pairs == brute_force(mesh));
        CHECK(pairs.empty() == (noise == 0.0));
    }
}

TEST_CASE("a hundred thousand faces around one vertex are searched in seconds")
{
    PolygonMesh mesh = wheel(100000, 0.0);
    CHECK(self_intersections(mesh, mesh.vertices).empty());
    mesh.vertices.row(100000) = Point(0.99, 0.0, 0.1);
    CHECK(self_intersections(mesh, mesh.vertices).empty());
}

TEST_CASE("a noisy surface crosses itself as each pair of its faces does")
{
    for (const PolygonMesh& mesh : {make_noisy_sphere(700, {.noise = 1.0}), make_cylinder(400, {.noise = 0.8})}) {
        const Pairs pairs = self_intersections(mesh, mesh.vertices);
        CHECK_FALSE(pairs.empty());
        CHECK(pairs == brute_force(mesh));
    }
}

TEST_CASE("meshes with anything in them cross themselves as each pair of their faces does")
{
    RandomNumbers random(5);
    for (int i = 0; i < 60; ++i) {
        const RandomMesh random_case = random_mesh(random);
        INFO(random_case.description);
        CHECK(self_intersections(random_case.mesh, random_case.mesh.vertices) == brute_force(random_case.mesh));
    }
}

TEST_CASE("the crossings depend neither on numbers, size and place nor on threads")
{
    const PolygonMesh mesh = make_noisy_sphere(6000, {.noise = 0.9});
    const Pairs pairs = self_intersections(mesh, mesh.vertices);
    REQUIRE(pairs.size() > 50);
    CHECK(self_intersections(mesh, mesh.vertices, run_in_parallel) == pairs);

    PolygonMesh scaled = mesh;
    scaled.vertices *= 0x1p-60;
    CHECK(self_intersections(scaled, scaled.vertices) == pairs);
    PolygonMesh moved = mesh;
    // On a grid of 2⁻³⁰, so that moving does not round.
    for (double& x : moved.vertices.reshaped())
        x = std::round(x * 0x1p30) * 0x1p-30;
    const Pairs of_rounded = self_intersections(moved, moved.vertices);
    moved.vertices.rowwise() += Point(4096, -1024, 2);
    CHECK(self_intersections(moved, moved.vertices) == of_rounded);

    RandomNumbers random(3);
    const std::vector<Index> old_face = random_permutation(mesh.n_faces(), random);
    std::vector<Index> new_face(old_face.size());
    for (Index f = 0; f < mesh.n_faces(); ++f)
        new_face[old_face[f]] = f;
    const PolygonMesh shuffled = renumbered(mesh, random_permutation(mesh.n_vertices(), random), old_face);
    CHECK(self_intersections(shuffled, shuffled.vertices) == with_numbers(pairs, new_face));
}

TEST_CASE("where vertices are doubled along a seam, nothing crosses")
{
    const PolygonMesh mesh = make_noisy_sphere(1000, {.noise = 0.9});
    const PolygonMesh with_seams = split(mesh, random_labels(mesh.n_faces(), 3, 1));
    REQUIRE(with_seams.n_vertices() > mesh.n_vertices());
    CHECK(self_intersections(with_seams, with_seams.vertices) == self_intersections(mesh, mesh.vertices));
    CHECK_FALSE(self_intersections(mesh, mesh.vertices).empty());
}

TEST_CASE("faces that are not finite cross nothing, and others do")
{
    PolygonMesh mesh = folded_grid(12, 5, 0.0);
    mesh.vertices(0, 1) = std::numeric_limits<double>::quiet_NaN();
    CHECK(self_intersections(mesh, mesh.vertices).size() == 29);
    mesh.vertices(0, 1) = std::numeric_limits<double>::infinity();
    CHECK(self_intersections(mesh, mesh.vertices).size() == 29);
}

TEST_CASE("of a surface that has collapsed, some of the crossings are found")
{
    RandomNumbers random(1);
    const PolygonMesh mesh = soup(3000, 3, 10.0, random);
    const Pairs pairs = self_intersections(mesh, mesh.vertices);
    CHECK(pairs.size() == most_self_intersections);
    CHECK(std::ranges::is_sorted(pairs));
    CHECK(std::ranges::adjacent_find(pairs) == pairs.end());
    CHECK(self_intersections(mesh, mesh.vertices, run_in_parallel) == pairs);
}
