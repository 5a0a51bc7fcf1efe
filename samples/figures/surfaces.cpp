#include "samples/figures/surfaces.h"

#include <cmath>
#include <numbers>

#include "partition/topology.h"
#include "samples/common/meshes.h"
#include "samples/common/meshes/random_numbers.h"

namespace seamflow {

namespace {

/// From the unit square to that from -1 to 1; heights grow with it.
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
        if (topology.kind[at(v)] == VertexKind::Interior)
            for (Eigen::Index axis = 0; axis < 2; ++axis)
                mesh.vertices(v, axis) += length * random.symmetric();
}

}  // namespace

PolygonMesh quads_with_bumps(Index vertices)
{
    return doubled(make_quads(vertices));
}

PolygonMesh polygons_with_bumps(Index vertices)
{
    return doubled(make_mixed_polygons(vertices));
}

PolygonMesh triangles_with_bumps(Index vertices)
{
    return doubled(make_triangles(vertices));
}

PolygonMesh hexagons_with_bumps(Index vertices)
{
    // In a honeycomb of n vertices an edge is 0.88 / √n long; the shortest one is 0.005 for n = 6,118 in the paper.
    PolygonMesh mesh = make_hexagons(vertices);
    jitter(mesh, 0.22 / std::sqrt(static_cast<double>(vertices)));
    return mesh;
}

PolygonMesh polygons_with_hill_and_hollow(Index vertices)
{
    MixedPolygonsShape flat;
    flat.surface.amplitude = 0.0;
    PolygonMesh mesh = doubled(make_mixed_polygons(vertices, flat));
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
