#include <cmath>
#include <numbers>
#include <vector>

#include "samples/meshes/building.h"
#include "samples/meshes/meshes.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow {

namespace {

/// A circle of latitude with evenly spaced vertices, numbered from `first` on.
struct Latitude {
    double polar_angle = 0.0;
    Index first = 0;
    Index count = 0;

    [[nodiscard]] Index vertex(Index k) const { return first + k % count; }
};

/// Circles from the north to the south pole, which are circles of one vertex. Vertices are distributed by the length of
/// the circles, and the running total is rounded, so that all are used.
std::vector<Latitude> choose_latitudes(Index vertices)
{
    const auto n_circles = static_cast<Index>(std::lround(std::sqrt(std::numbers::pi / 4.0 * vertices)));
    const auto angle = [&](Index i) { return std::numbers::pi * i / (n_circles + 1); };
    double length = 0.0;
    for (Index i = 1; i <= n_circles; ++i)
        length += std::sin(angle(i));
    std::vector<Latitude> latitudes{{0.0, 0, 1}};
    double length_so_far = 0.0;
    for (Index i = 1; i <= n_circles; ++i) {
        length_so_far += std::sin(angle(i));
        const Index first = latitudes.back().first + latitudes.back().count;
        const auto end = 1 + static_cast<Index>(std::lround((vertices - 2) * length_so_far / length));
        latitudes.push_back({angle(i), first, end - first});
    }
    latitudes.push_back({std::numbers::pi, vertices - 1, 1});
    return latitudes;
}

/// Triangles between two circles: from edge to edge, advancing along the circle whose next vertex comes first.
void add_triangles(PolygonMesh& mesh, const Latitude& upper, const Latitude& lower)
{
    const Index upper_edges = upper.count > 1 ? upper.count : 0;
    const Index lower_edges = lower.count > 1 ? lower.count : 0;
    Index u = 0;
    Index l = 0;
    while (u < upper_edges || l < lower_edges) {
        const double upper_next = (u + 0.5) / upper.count;
        const double lower_next = (l + 0.5) / lower.count;
        if (l == lower_edges || (u < upper_edges && upper_next < lower_next)) {
            add_face(mesh, {upper.vertex(u), lower.vertex(l), upper.vertex(u + 1)});
            ++u;
        } else {
            add_face(mesh, {upper.vertex(u), lower.vertex(l), lower.vertex(l + 1)});
            ++l;
        }
    }
}

void place(PolygonMesh& mesh, const Latitude& latitude, const NoisySphereShape& shape, RandomNumbers& random)
{
    const double displacement =
        shape.noise * shape.radius * std::sqrt(4.0 * std::numbers::pi / static_cast<double>(mesh.n_vertices()));
    for (Index k = 0; k < latitude.count; ++k) {
        const double longitude = 2.0 * std::numbers::pi * k / latitude.count;
        Eigen::RowVector3d p(std::sin(latitude.polar_angle) * std::cos(longitude),
                             std::sin(latitude.polar_angle) * std::sin(longitude), std::cos(latitude.polar_angle));
        const Eigen::Array3d bumps = (shape.waves * p.array()).sin();
        p *= shape.radius * (1.0 + shape.amplitude * bumps.prod());
        for (Eigen::Index axis = 0; axis < 3; ++axis)
            p(axis) += displacement * random.symmetric();
        mesh.vertices.row(latitude.vertex(k)) = p;
    }
}

}  // namespace

PolygonMesh make_noisy_sphere(Index vertices, const NoisySphereShape& shape)
{
    require_vertices(vertices);
    require_between("radius", shape.radius, 1e-6, 1e6);
    require_between("amplitude", shape.amplitude, 0.0, 0.9);
    require_between("waves", shape.waves, 0, 1e6);
    require_between("noise", shape.noise, 0.0, 1e6);
    const auto n_triangles = 2 * static_cast<std::size_t>(vertices) - 4;
    PolygonMesh mesh = mesh_with_room(vertices, 3 * n_triangles, n_triangles);
    const auto latitudes = choose_latitudes(vertices);
    RandomNumbers random(shape.seed);
    for (const Latitude& latitude : latitudes)
        place(mesh, latitude, shape, random);
    for (std::size_t i = 0; i + 1 < latitudes.size(); ++i)
        add_triangles(mesh, latitudes[i], latitudes[i + 1]);
    return mesh;
}

}  // namespace seamflow
