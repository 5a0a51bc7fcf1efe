#include "samples/figures/surfaces.h"

#include <cmath>
#include <numbers>

#include "samples/common/meshes.h"

namespace seamflow {

namespace {

/// From the unit square to that from -1 to 1; heights grow with it.
PolygonMesh doubled(PolygonMesh mesh)
{
    mesh.vertices *= 2.0;
    mesh.vertices.leftCols<2>().array() -= 1.0;
    return mesh;
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
    return make_hexagons(vertices);
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
    shape.amplitude = 0.2;
    shape.waves_around = 0;
    shape.waves_along = 3;
    return make_cylinder(vertices, shape);
}

PolygonMesh bulging_two_level_cylinder(Index vertices)
{
    CylinderShape shape;
    shape.radius = 1.6;
    shape.amplitude = 0.3;
    shape.waves_around = 0;
    shape.waves_along = 1;
    return make_two_level_cylinder(vertices, shape);
}

}  // namespace seamflow
