#include <algorithm>
#include <cmath>
#include <numbers>

#include "samples/meshes/building.h"
#include "samples/meshes/meshes.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow {

namespace {

void require_valid(const CylinderShape& shape)
{
    require_between("radius", shape.radius, 1e-6, 1e6);
    require_between("height", shape.height, 1e-6, 1e6);
    require_between("amplitude", shape.amplitude, 0.0, 0.9);
    require_between("waves_around", shape.waves_around, 0, 1e6);
    require_between("waves_along", shape.waves_along, 0, 1e6);
    require_between("noise", shape.noise, 0, 1e6);
}

/// A run of rings with the same number of vertices, numbered from `first` on.
struct Rings {
    Index first = 0;
    Index around = 0;
    Index rings = 0;

    [[nodiscard]] Index vertex(Index k, Index ring) const { return first + ring * around + k % around; }
    [[nodiscard]] Index size() const { return around * rings; }
};

void place(PolygonMesh& mesh, Index vertex, double angle, double z, const CylinderShape& shape)
{
    const double along = std::cos(shape.waves_along * 2.0 * std::numbers::pi * z / shape.height);
    const double r = shape.radius * (1.0 + shape.amplitude * std::cos(shape.waves_around * angle) * along);
    mesh.vertices.row(vertex) << r * std::cos(angle), r * std::sin(angle), z;
}

/// Rings from z = low upwards, `spacing` apart.
void place_rings(PolygonMesh& mesh, const Rings& rings, double low, double spacing, const CylinderShape& shape)
{
    for (Index ring = 0; ring < rings.rings; ++ring)
        for (Index k = 0; k < rings.around; ++k)
            place(mesh, rings.vertex(k, ring), 2.0 * std::numbers::pi * k / rings.around, low + spacing * ring, shape);
}

void add_quads(PolygonMesh& mesh, const Rings& rings)
{
    for (Index ring = 0; ring + 1 < rings.rings; ++ring)
        for (Index k = 0; k < rings.around; ++k)
            add_face(mesh, {rings.vertex(k, ring), rings.vertex(k + 1, ring), rings.vertex(k + 1, ring + 1),
                            rings.vertex(k, ring + 1)});
}

/// Displaces all vertices except the `first` and the `last` ones, which lie on the boundary.
void add_noise(PolygonMesh& mesh, Index first, Index last, const CylinderShape& shape)
{
    RandomNumbers random(shape.seed);
    const double area = 2.0 * std::numbers::pi * shape.radius * shape.height;
    const double displacement = shape.noise * std::sqrt(area / mesh.n_vertices());
    for (Index v = first; v < mesh.n_vertices() - last; ++v)
        for (Eigen::Index axis = 0; axis < 3; ++axis)
            mesh.vertices(v, axis) += displacement * random.symmetric();
}

/// At least three rings of at least six vertices, whose quads are about square.
Rings choose_rings(Index vertices, const CylinderShape& shape)
{
    const double aspect = 2.0 * std::numbers::pi * shape.radius / shape.height;
    Rings rings;
    const double around = std::clamp(std::sqrt(aspect * vertices), 6.0, vertices / 5.0);
    rings.around = static_cast<Index>(std::lround(around));
    rings.rings = static_cast<Index>(std::lround(static_cast<double>(vertices) / rings.around));
    return rings;
}

/// The rings of the coarse and of the fine half; their quads are about square.
std::pair<Rings, Rings> choose_two_levels(Index vertices, const CylinderShape& shape)
{
    const double aspect = 2.0 * std::numbers::pi * shape.radius / shape.height;
    const double around = std::clamp(std::sqrt(aspect * vertices / 2.5), 3.0, vertices / 12.0);
    Rings coarse;
    coarse.around = static_cast<Index>(std::lround(around));
    coarse.rings = std::max(Index{2}, static_cast<Index>(std::lround(0.2 * vertices / coarse.around)));
    Rings fine;
    fine.first = coarse.size();
    fine.around = 2 * coarse.around;
    fine.rings = std::max(Index{2},
                          static_cast<Index>(std::lround(static_cast<double>(vertices - coarse.size()) / fine.around)));
    return {coarse, fine};
}

}  // namespace

PolygonMesh make_cylinder(Index vertices, const CylinderShape& shape)
{
    require_vertices(vertices);
    require_valid(shape);
    const Rings rings = choose_rings(vertices, shape);
    const auto n_quads = static_cast<std::size_t>(rings.size() - rings.around);
    PolygonMesh mesh = mesh_with_room(rings.size(), 4 * n_quads, n_quads);
    place_rings(mesh, rings, -shape.height / 2.0, shape.height / (rings.rings - 1), shape);
    add_quads(mesh, rings);
    add_noise(mesh, rings.around, rings.around, shape);
    return mesh;
}

PolygonMesh make_two_level_cylinder(Index vertices, const CylinderShape& shape)
{
    require_vertices(vertices);
    require_valid(shape);
    const auto [coarse, fine] = choose_two_levels(vertices, shape);
    const auto n = static_cast<std::size_t>(coarse.size() + fine.size());
    PolygonMesh mesh = mesh_with_room(coarse.size() + fine.size(), 4 * n, n);
    // The pentagons are as high as the coarse quads below them.
    const double below = shape.height / 2.0 / coarse.rings;
    place_rings(mesh, coarse, -shape.height / 2.0, below, shape);
    place_rings(mesh, fine, 0.0, shape.height / 2.0 / (fine.rings - 1), shape);
    add_quads(mesh, coarse);
    for (Index k = 0; k < coarse.around; ++k)
        add_face(mesh, {coarse.vertex(k, coarse.rings - 1), coarse.vertex(k + 1, coarse.rings - 1),
                        fine.vertex(2 * k + 2, 0), fine.vertex(2 * k + 1, 0), fine.vertex(2 * k, 0)});
    add_quads(mesh, fine);
    add_noise(mesh, coarse.around, fine.around, shape);
    return mesh;
}

}  // namespace seamflow
