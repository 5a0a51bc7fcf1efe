#include <algorithm>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "solvers/normals/face_neighbours.h"
#include "solvers/normals/feature_lines.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// The vertex of a grid of unit squares that is there.
Index vertex_at(const PolygonMesh& mesh, double x, double y)
{
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (mesh.vertices.row(v) == Point(x, y, 0.0))
            return v;
    FAIL("no vertex there");
    return -1;
}

/// A line across the grid, at this x, from the lower rim to so far.
std::vector<Edge> line_at(const PolygonMesh& mesh, double x, int length)
{
    std::vector<Edge> edges;
    for (int y = 0; y < length; ++y)
        edges.push_back({vertex_at(mesh, x, y + 1), vertex_at(mesh, x, y)});
    return edges;
}

}  // namespace

TEST_CASE("faces on both sides of a line share nothing along it, and go on beyond its end")
{
    const PolygonMesh mesh = quad_grid(6, 4);
    const Topology topology = make_topology(mesh);
    for (const int length : {4, 2}) {
        CAPTURE(length);
        const FeatureLines lines(mesh, topology, line_at(mesh, 3, length));
        const PolygonMesh open = lines.cut_open(mesh, topology);
        // Of a line that ends inside, the last vertex stays one.
        CHECK(open.n_vertices() == mesh.n_vertices() + (length == 4 ? 5 : 2));
        const FaceNeighbours neighbours = make_face_neighbours(open, make_topology(open));
        const auto middle = [&](Index f) {
            return mesh.vertices(std::vector(mesh.face(f).begin(), mesh.face(f).end()), Eigen::all)
                .colwise()
                .mean()
                .eval();
        };
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            CHECK(open.face(f).size() == 4);
            for (const Index g : neighbours[f]) {
                const bool crosses = (middle(f)[0] < 3.0) != (middle(g)[0] < 3.0);
                // The vertex at the end has faces beside the line, too.
                CHECK((!crosses || std::max(middle(f)[1], middle(g)[1]) > (length == 4 ? 4 : length - 1)));
            }
        }
    }
}

TEST_CASE("a closed line divides its mesh in two, and lines that meet divide what is around")
{
    const PolygonMesh torus = quad_torus(8, 5);
    const Topology topology = make_topology(torus);
    // Around the torus twice: all edges between a ring of faces and the next, on both sides of the ring.
    std::set<Edge> across;
    for (Index h = 0; h < static_cast<Index>(torus.face_vertices.size()); ++h) {
        const Index v = torus.face_vertices[h];
        const Index w = torus.face_vertices[topology.next(torus, h)];
        if (topology.face_of[h] < 5 && topology.face_of[topology.twin[h]] >= 5)
            across.insert({std::min(v, w), std::max(v, w)});
    }
    const std::vector<Edge> edges(across.begin(), across.end());
    const FeatureLines lines(torus, topology, edges);
    const PolygonMesh open = lines.cut_open(torus, topology);
    CHECK(open.n_vertices() > torus.n_vertices());
    const FaceNeighbours neighbours = make_face_neighbours(open, make_topology(open));
    for (Index f = 0; f < 5; ++f)
        for (const Index g : neighbours[f])
            CHECK(g < 5);
}

TEST_CASE("vertices stay on their line, between the middles of its edges; ends and junctions stay")
{
    const PolygonMesh mesh = quad_grid(6, 4);
    const Topology topology = make_topology(mesh);
    std::vector<Edge> edges = line_at(mesh, 3, 4);
    edges.push_back({vertex_at(mesh, 3, 2), vertex_at(mesh, 4, 2)});
    edges.push_back(edges.front());
    const FeatureLines lines(mesh, topology, edges);
    CHECK_FALSE(lines.empty());
    const auto ends_at = [&](double x, double y, const Point& p) { return lines.on_line(vertex_at(mesh, x, y), p); };
    CHECK(ends_at(3, 1, Point(3.4, 1.25, 0.7)) == Point(3, 1.25, 0));
    CHECK(ends_at(3, 1, Point(2.0, 0.9, -1)).isApprox(Point(3, 0.9, 0)));
    CHECK(ends_at(3, 1, Point(3, 7, 0)) == Point(3, 1.5, 0));
    CHECK(ends_at(3, 0, Point(3, 0.2, 0)) == Point(3, 0, 0));
    for (const Point& p : {Point(3, 2.2, 0), Point(3, 1.8, 0), Point(3.2, 2, 0)})
        CHECK(ends_at(3, 2, p) == Point(3, 2, 0));
    CHECK(ends_at(4, 2, Point(4.2, 2, 1)) == Point(4, 2, 0));
    CHECK(ends_at(5, 2, Point(9, 9, 9)) == Point(9, 9, 9));
    CHECK(FeatureLines().on_line(0, Point(1, 2, 3)) == Point(1, 2, 3));
    CHECK(FeatureLines(mesh, topology, {}).empty());
}

TEST_CASE("pairs that are no edge are refused by their numbers")
{
    const PolygonMesh mesh = quad_grid(6, 4);
    const Topology topology = make_topology(mesh);
    const Index v = vertex_at(mesh, 2, 2);
    for (const Index w : {vertex_at(mesh, 3, 3), vertex_at(mesh, 4, 2), v, Index{-1}, mesh.n_vertices()})
        CHECK_THROWS_AS(FeatureLines(mesh, topology, std::vector<Edge>{{v, w}}), InputError);
}
