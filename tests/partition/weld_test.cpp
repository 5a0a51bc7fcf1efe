#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include <doctest/doctest.h>

#include "partition/vector_area.h"
#include "partition/weld.h"
#include "tests/support/random_meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// The topology that comes with a weld is that of its mesh.
std::optional<Weld> welded(const PolygonMesh& mesh, double distance = 0.0)
{
    std::optional<Weld> result = weld(mesh, make_topology(mesh), distance);
    if (!result)
        return result;
    const Topology& topology = result->topology;
    const Topology expected = make_topology(result->mesh);
    CHECK(topology.twin == expected.twin);
    CHECK(topology.vertex_offsets == expected.vertex_offsets);
    CHECK(topology.vertex_corners == expected.vertex_corners);
    CHECK(topology.kind == expected.kind);
    CHECK(topology.fixed == expected.fixed);
    CHECK(topology.oriented == expected.oriented);
    bool same_faces = true;
    for (Index h = 0; h < result->mesh.n_corners(); ++h)
        same_faces = same_faces && topology.face_of[usize(h)] == expected.face_of[usize(h)];
    CHECK(same_faces);
    return result;
}

Index count_kind(const Topology& topology, VertexKind kind)
{
    return static_cast<Index>(std::ranges::count(topology.kind, kind));
}

/// Every face has a label of its own.
std::vector<Index> all_apart(const PolygonMesh& mesh)
{
    std::vector<Index> labels(usize(mesh.n_faces()));
    std::iota(labels.begin(), labels.end(), 0);
    return labels;
}

PolygonMesh make(const std::vector<Point>& points, const std::vector<std::vector<Index>>& faces)
{
    PolygonMesh mesh;
    mesh.vertices.resize(std::ssize(points), 3);
    for (std::size_t v = 0; v < points.size(); ++v)
        mesh.vertices.row(static_cast<Eigen::Index>(v)) = points[v];
    for (const auto& face : faces)
        mesh.add_face(face);
    return mesh;
}

}  // namespace

TEST_CASE("a surface in pieces is welded to what it was")
{
    for (const PolygonMesh& whole : {triangle_torus(9, 7), quad_grid(6, 5), cylinder(8, 4), hexagon_sheet(5, 4)})
        for (const auto& labels :
             {random_labels(whole.n_faces(), 2, 1), random_labels(whole.n_faces(), 5, 2), all_apart(whole)}) {
            const PolygonMesh parts = split(whole, labels);
            REQUIRE(parts.n_vertices() > whole.n_vertices());
            const auto joined = welded(parts);
            REQUIRE(joined);
            const Topology topology = make_topology(whole);
            // Pieces that meet in a single vertex have no edge there to be joined along.
            if (labels == all_apart(whole)) {
                CHECK(joined->mesh.face_vertices == whole.face_vertices);
                CHECK(joined->topology.twin == topology.twin);
                CHECK(count_kind(joined->topology, VertexKind::Interior) == count_kind(topology, VertexKind::Interior));
                CHECK(joined->n_edges == (whole.n_corners() - std::ranges::count(topology.twin, -1)) / 2);
            }
            CHECK(count_kind(joined->topology, VertexKind::NonManifold) == 0);
            CHECK(std::ranges::count(joined->topology.twin, -1) == std::ranges::count(topology.twin, -1));
            CHECK(joined->mesh.vertices == parts.vertices);
        }
}

TEST_CASE("a slit is closed up to its ends, and the first of copies stands for all")
{
    const PolygonMesh grid = quad_grid(6, 4);
    PolygonMesh slit = grid;
    // Along the middle of the lower half.
    std::vector<Index> labels(usize(grid.n_faces()), 0);
    const Topology topology = make_topology(grid);
    REQUIRE(topology.kind[2 * 7 + 3] == VertexKind::Interior);
    slit.vertices.conservativeResize(grid.n_vertices() + 1, 3);
    slit.vertices.row(grid.n_vertices()) = grid.vertices.row(2 * 7 + 3);
    // Two of the four faces at an interior vertex, side by side, get the copy.
    const auto fan = fans_at(grid, topology, 2 * 7 + 3, {}, 0).front();
    for (const int i : {0, 1})
        slit.face_vertices[fan.corners[i]] = grid.n_vertices();
    REQUIRE(make_topology(slit).kind[grid.n_vertices()] == VertexKind::Boundary);
    const auto joined = welded(slit);
    REQUIRE(joined);
    CHECK(joined->mesh.face_vertices == grid.face_vertices);
    CHECK(joined->representative.back() == 2 * 7 + 3);
    CHECK(joined->n_vertices == 2);
    CHECK(joined->n_edges == 2);
    CHECK(joined->topology.kind[2 * 7 + 3] == VertexKind::Interior);
    CHECK(joined->topology.kind.back() == VertexKind::Isolated);
}

TEST_CASE("what does not meet along edges stays apart")
{
    // Three sheets at one edge; two that run along an edge in the same direction; sheets that lie on each other; what
    // touches in a vertex.
    const std::vector<Point> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::array<Point, 3> tips{Point(1, 1, 0), Point(1, 1, 1), Point(1, 1, -1)};
    const Point a = corners[1];
    const Point b = corners[2];
    CHECK(welded(make({corners[0], a, b, a, b, tips[0]}, {{0, 1, 2}, {4, 3, 5}})));
    CHECK_FALSE(welded(make({corners[0], a, b, a, b, tips[0]}, {{0, 1, 2}, {3, 4, 5}})));
    CHECK_FALSE(welded(make({corners[0], a, b, a, b, tips[0], a, b, tips[1]}, {{0, 1, 2}, {4, 3, 5}, {7, 6, 8}})));
    CHECK_FALSE(welded(make({corners[0], a, b, corners[0], a, b}, {{0, 1, 2}, {3, 4, 5}})));
    CHECK_FALSE(welded(make({corners[0], a, b, corners[0], a, b}, {{0, 1, 2}, {5, 4, 3}})));
    CHECK_FALSE(welded(make({corners[0], a, b, a, tips[0], tips[1]}, {{0, 1, 2}, {3, 4, 5}})));
    // A leaf of two sheets of many faces.
    PolygonMesh leaf = side_by_side({quad_grid(4, 4), quad_grid(4, 4)});
    leaf.vertices.bottomRows(25) = leaf.vertices.topRows(25);
    for (Index f = 16; f < 32; ++f)
        std::reverse(leaf.face_vertices.begin() + leaf.face_offsets[f],
                     leaf.face_vertices.begin() + leaf.face_offsets[f + 1]);
    CHECK_FALSE(welded(leaf));
}

TEST_CASE("nothing is joined that would make a mesh worse")
{
    // A pillow whose two sheets have both an edge between the same corners: four faces would share it.
    const std::vector<Point> rim{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<Point> points = rim;
    points.insert(points.end(), rim.begin(), rim.end());
    points.insert(points.end(), {{0.7, 0.3, 1}, {0.3, 0.7, 1}});
    CHECK_FALSE(
        welded(make(points, {{0, 1, 2}, {0, 2, 3}, {6, 5, 8}, {5, 4, 8}, {4, 6, 8}, {7, 6, 9}, {4, 7, 9}, {6, 4, 9}})));
    // A strip of one quad whose ends lie on each other.
    CHECK_FALSE(welded(make({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}}, {{0, 1, 2, 3}})));
    // What is sound elsewhere is joined all the same.
    PolygonMesh both = side_by_side(
        {split(quad_grid(2, 1), {0, 1}), make({{0, 0, 5}, {1, 0, 5}, {1, 0, 5}, {0, 0, 5}}, {{0, 1, 2, 3}})});
    const auto joined = welded(both);
    REQUIRE(joined);
    CHECK(joined->n_edges == 1);
    // A tube of two quads, one of which has lost its seam to a strip that would close on itself.
    PolygonMesh several = side_by_side({make({{0, 0, 5}, {1, 0, 5}, {1, 0, 5}, {0, 0, 5}}, {{0, 1, 2, 3}}),
                                        split(triangle_torus(5, 4), random_labels(40, 3, 7)),
                                        make({{0, 0, 7}, {1, 0, 7}, {1, 0, 7}, {0, 0, 7}}, {{0, 1, 2, 3}})});
    CHECK(welded(several)->n_edges > 1);
    // Copies at vertices that are not manifold.
    CHECK_FALSE(welded(three_wings()));
    CHECK_FALSE(welded(hourglass()));
}

TEST_CASE("places that are near count as equal, and what is joined comes to their middle")
{
    const PolygonMesh whole = triangle_grid(8, 6);
    const std::vector<Index> labels = all_apart(whole);
    PolygonMesh parts = split(whole, labels);
    for (Index v = 0; v < parts.n_vertices(); ++v)
        parts.vertices.row(v) += 1e-4 * Point(v % 3 - 1.0, v % 5 - 2.0, v % 7 - 3.0);
    CHECK_FALSE(welded(parts));
    CHECK_FALSE(welded(parts, 1e-6));
    const auto joined = welded(parts, 2e-3);
    REQUIRE(joined);
    CHECK(joined->mesh.face_vertices == whole.face_vertices);
    // Whatever the unit of length.
    for (const double unit : {0x1p-20, 0x1p20}) {
        PolygonMesh scaled = parts;
        scaled.vertices *= unit;
        CHECK(welded(scaled, 2e-3 * unit)->mesh.face_vertices == whole.face_vertices);
        CHECK_FALSE(welded(scaled, 1e-6 * unit));
    }
    for (Index v = 0; v < whole.n_vertices(); ++v) {
        Point middle = Point::Zero();
        int n = 0;
        for (Index w = 0; w < parts.n_vertices(); ++w)
            if (joined->representative[w] == v) {
                middle += parts.vertices.row(w);
                ++n;
            }
        CHECK((joined->mesh.vertices.row(v) - middle / n).norm() < 1e-12);
    }
    // Beyond the length of edges there is nothing to join, and a distance of nearly nothing is one of nothing.
    CHECK_FALSE(welded(parts, 100.0));
    CHECK(welded(split(whole, labels), 1e-300)->mesh.face_vertices == whole.face_vertices);
}

TEST_CASE("zeros of both signs are one place, and what is no number is none")
{
    PolygonMesh parts = split(quad_grid(2, 1), {0, 1});
    const Index copy = parts.n_vertices() - 1;
    for (double& x : parts.vertices.row(copy))
        if (x == 0.0)
            x = -0.0;
    CHECK(welded(parts));
    parts.vertices(copy, 2) = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(welded(parts));
    CHECK_FALSE(welded(parts, 0.1));
}

TEST_CASE("random meshes in pieces are welded to what is sound, and again to nothing more")
{
    RandomNumbers random(23);
    int n_joined = 0;
    for (int round = 0; round < 200; ++round) {
        const RandomMesh m = random_mesh(random);
        CAPTURE(round);
        CAPTURE(m.description);
        const PolygonMesh parts = split(m.mesh, random_cut(m.mesh, 2 + random.below(6), random));
        const auto joined = welded(parts);
        if (!joined)
            continue;
        ++n_joined;
        const auto n_open = [](const Topology& topology) { return std::ranges::count(topology.twin, -1); };
        // Fewer where other edges lie between what is joined.
        CHECK(n_open(joined->topology) <= n_open(make_topology(parts)) - 2 * joined->n_edges);
        CHECK(count_kind(joined->topology, VertexKind::NonManifold) <=
              count_kind(make_topology(parts), VertexKind::NonManifold));
    }
    CHECK(n_joined > 100);
}
