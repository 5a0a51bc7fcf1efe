#include "samples/figures/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "partition/topology.h"
#include "partition/vector_area.h"
#include "samples/meshes/meshes.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow {

namespace {

/// Maps the unit square to that from -1 to 1; heights grow with it.
PolygonMesh doubled(PolygonMesh mesh)
{
    mesh.vertices *= 2.0;
    mesh.vertices.leftCols<2>().array() -= 1.0;
    return mesh;
}

/// Moves each vertex off the boundary by up to this length in x and in y.
void jitter(PolygonMesh& mesh, double length)
{
    const Topology topology = make_topology(mesh);
    RandomNumbers random(1);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (topology.kind[v] == VertexKind::Interior)
            for (Eigen::Index axis = 0; axis < 2; ++axis)
                mesh.vertices(v, axis) += length * random.symmetric();
}

/// z = height · cos(2π waves x) · cos(2π waves y), with `waves` waves per unit of length.
void raise_bumps(PolygonMesh& mesh, double height, double waves)
{
    const double turn = 2.0 * std::numbers::pi * waves;
    for (auto p : mesh.vertices.rowwise())
        p.z() = height * std::cos(turn * p.x()) * std::cos(turn * p.y());
}

/// n by n cells over the square from -1 to 1, jittered off the boundary, each cut into two triangles along a random
/// diagonal.
PolygonMesh drawn_triangles(Index n)
{
    PolygonMesh mesh;
    mesh.vertices.setZero((n + 1) * (n + 1), 3);
    RandomNumbers random(1);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const Index column = v % (n + 1);
        const Index row = v / (n + 1);
        const double jitter = column % n > 0 && row % n > 0 ? 0.2 : 0.0;
        mesh.vertices(v, 0) = 2.0 * (column + jitter * random.symmetric()) / n - 1.0;
        mesh.vertices(v, 1) = 2.0 * (row + jitter * random.symmetric()) / n - 1.0;
    }
    for (Index cell = 0; cell < n * n; ++cell) {
        const Index a = cell / n * (n + 1) + cell % n;
        const Index b = a + 1;
        const Index c = b + n + 1;
        const Index d = a + n + 1;
        const bool rising = random.below(2) == 1;
        mesh.add_face(rising ? std::array{a, b, c} : std::array{a, b, d});
        mesh.add_face(rising ? std::array{a, c, d} : std::array{b, c, d});
    }
    return mesh;
}

/// A polygon around each vertex of a mesh, between the centroids of its faces; on the boundary the vertices themselves
/// and the midpoints of their edges are corners, too.
PolygonMesh dual_of(const PolygonMesh& mesh)
{
    const Topology topology = make_topology(mesh);
    PolygonMesh dual;
    std::vector<Point> places;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        Point sum = Point::Zero();
        for (const Index v : mesh.face(f))
            sum += mesh.vertices.row(v);
        places.emplace_back(sum / static_cast<double>(mesh.face(f).size()));
    }
    const auto added = [&](const Point& place) {
        places.push_back(place);
        return static_cast<Index>(places.size()) - 1;
    };
    std::map<std::pair<Index, Index>, Index> midpoints;
    const auto midpoint = [&](Index a, Index b) {
        const auto [known, is_new] = midpoints.try_emplace(std::minmax(a, b));
        if (is_new)
            known->second = added(0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b)));
        return known->second;
    };
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const Fan fan = fans_at(mesh, topology, v, {}, 0).front();
        std::vector<Index> corners;
        if (!fan.closed)
            corners = {added(mesh.vertices.row(v)), midpoint(v, fan.first)};
        for (const Index corner : fan.corners)
            corners.push_back(topology.face_of[corner]);
        if (!fan.closed)
            corners.push_back(midpoint(v, fan.last));
        dual.add_face(corners);
    }
    dual.vertices.resize(static_cast<Eigen::Index>(places.size()), 3);
    for (std::size_t k = 0; k < places.size(); ++k)
        dual.vertices.row(static_cast<Eigen::Index>(k)) = places[k];
    return dual;
}

/// Flat polygons of about four to eight corners over the square from -1 to 1; three edges meet at each vertex off the
/// boundary.
PolygonMesh drawn_polygons(Index vertices)
{
    // Each of the n² cells gives two vertices, each of the 4n edges of the boundary two more.
    const double n = std::sqrt(0.5 * vertices + 4.0) - 2.0;
    return dual_of(drawn_triangles(static_cast<Index>(std::lround(n))));
}

}  // namespace

PolygonMesh quads_with_bumps(Index vertices)
{
    return doubled(make_quads(vertices));
}

PolygonMesh polygons_with_bumps(Index vertices)
{
    PolygonMesh mesh = drawn_polygons(vertices);
    raise_bumps(mesh, 0.2, 1.0);
    return mesh;
}

PolygonMesh triangles_with_bumps(Index vertices)
{
    return doubled(make_triangles(vertices));
}

PolygonMesh hexagons_with_bumps(Index vertices)
{
    // In a honeycomb of n vertices an edge is 0.88 / √n long; the shortest one is 0.005 for n = 6,118 in the paper.
    PolygonMesh mesh = make_hexagons(vertices, {.amplitude = 0.0});
    jitter(mesh, 0.22 / std::sqrt(static_cast<double>(vertices)));
    raise_bumps(mesh, 0.1, 2.0);
    return mesh;
}

PolygonMesh polygons_with_hill_and_hollow(Index vertices)
{
    PolygonMesh mesh = drawn_polygons(vertices);
    for (auto p : mesh.vertices.rowwise())
        p.z() = 0.7 * std::cos(std::numbers::pi / 2.0 * p.x()) * std::sin(std::numbers::pi * p.y());
    return mesh;
}

PolygonMesh wavy_cylinder(Index vertices)
{
    CylinderShape shape;
    shape.radius = std::numbers::sqrt2;
    shape.amplitude = 0.5;
    shape.waves_around = 0;
    shape.waves_along = 1;
    return make_cylinder(vertices, shape);
}

PolygonMesh bulging_two_level_cylinder(Index vertices)
{
    CylinderShape shape;
    shape.radius = 1.6;
    shape.amplitude = 0.3;
    shape.waves_around = 0;
    shape.waves_along = 1;
    shape.noise = 0.2;
    return make_two_level_cylinder(vertices, shape);
}

}  // namespace seamflow
