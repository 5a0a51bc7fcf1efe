#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "partition/polygon_mesh.h"
#include "samples/meshes/label_surfaces.h"

/// Small generators of test meshes. All of them
/// - take the approximate number of vertices, at least 100 (machine parts 400) and at most 100,000,000, and keep within
///   10 percent of it,
/// - run in time and memory linear in that number,
/// - give manifold meshes of simple faces, oriented alike, without vertices that no face uses,
/// - give the same mesh for the same arguments everywhere, up to the last bits of the platform's sin and cos,
/// - refuse an argument outside its limits by an OptionError.
namespace seamflow {

/// The surface z = amplitude · cos(2π waves x) · cos(2π waves y) over the unit square.
struct HeightFieldShape {
    /// Length.
    double amplitude = 0.1;
    /// Waves across the square in either direction, at least 0.
    int waves = 2;
    /// Each vertex off the boundary is displaced by up to this many mean vertex distances in z, at least 0.
    double noise = 0.0;
    /// Seed of the noise, and of anything else drawn at random.
    std::uint32_t seed = 1;
};

/// A rectangular grid, each cell cut into two triangles along the same diagonal.
PolygonMesh make_triangles(Index vertices, const HeightFieldShape& shape = {});

/// A rectangular grid of quads.
PolygonMesh make_quads(Index vertices, const HeightFieldShape& shape = {});

/// A honeycomb of regular hexagons, clipped by the square: a quad every second row at the left and at the right, and
/// hexagons with one straight angle at the bottom and at the top.
PolygonMesh make_hexagons(Index vertices, const HeightFieldShape& shape = {});

/// A height field of mixed faces.
struct MixedPolygonsShape {
    HeightFieldShape surface;
    /// Each vertex off the boundary of the grid moves by up to this fraction of a cell in x and in y, 0 to 0.24.
    double jitter = 0.2;
    /// Fraction of the cells that the draw merges or cuts, 0 to 1; the others stay quads.
    double changed = 0.8;
};

/// Triangles to nonagons, convex or not: a jittered grid in which a seeded draw merges some cells with their
/// neighbours, or with halves of them, or cuts them in two. Interior vertices keep at least three edges.
PolygonMesh make_mixed_polygons(Index vertices, const MixedPolygonsShape& shape = {});

/// An open tube around the z axis, z from -height / 2 to height / 2, whose radius is modulated in both directions:
/// radius · (1 + amplitude · cos(waves_around · angle) · cos(waves_along · 2π z / height)).
struct CylinderShape {
    /// Length, positive.
    double radius = 1.0;
    /// Length, positive.
    double height = 6.283185307179586;
    /// 0 to 0.9, of the radius.
    double amplitude = 0.1;
    /// At least 0.
    int waves_around = 4;
    int waves_along = 3;
    /// Each vertex off the boundary is displaced by up to this many mean vertex distances in x, y and z, at least 0.
    double noise = 0.0;
    /// Of the noise.
    std::uint32_t seed = 1;
};

/// A tube of quads.
PolygonMesh make_cylinder(Index vertices, const CylinderShape& shape = {});

/// A tube of quads whose upper half is twice as fine as the lower. A ring of pentagons joins the two: each has one
/// coarse edge below and two fine ones above.
PolygonMesh make_two_level_cylinder(Index vertices, const CylinderShape& shape = {});

/// A noisy, bumpy sphere around the origin, as a scan might give: the radius at the point (x, y, z) of the unit sphere
/// is radius · (1 + amplitude · sin(waves x) · sin(waves y) · sin(waves z)).
struct NoisySphereShape {
    /// Length, positive.
    double radius = 1.0;
    /// 0 to 0.9, of the radius.
    double amplitude = 0.2;
    /// At least 0.
    int waves = 5;
    /// Each vertex is displaced by up to this many mean vertex distances in x, y and z, at least 0.
    double noise = 0.3;
    /// Of the noise.
    std::uint32_t seed = 1;
};

/// A closed mesh of triangles between circles of latitude, with exactly the number of vertices asked for.
PolygonMesh make_noisy_sphere(Index vertices, const NoisySphereShape& shape = {});

/// The kind of the faces of a machine part.
enum class PartFaces { Triangles, Quads };

/// Parts with flat and round sides and sharp edges between them: the features that must survive smoothing are known.
struct MachinePartShape {
    PartFaces faces = PartFaces::Triangles;
    /// Each vertex is displaced by up to this many mean vertex distances in x, y and z, at least 0.
    double noise = 0.0;
    /// Of the noise.
    std::uint32_t seed = 1;
};

inline constexpr Index fewest_vertices_of_parts = 400;

/// A box of 1.6 by 1.2 by 1.
PolygonMesh make_box(Index vertices, const MachinePartShape& shape = {});

/// A spur gear of radius 1 with ten straight teeth and a bore.
PolygonMesh make_gear(Index vertices, const MachinePartShape& shape = {});

/// A cylinder of radius 1 with a thinner one on it, bored through.
PolygonMesh make_stepped_cylinder(Index vertices, const MachinePartShape& shape = {});

/// A plate of 2.2 by 1.8 by 0.5 with a hole. The upper edges of both are chamfered, at 45°.
PolygonMesh make_chamfered_plate(Index vertices, const MachinePartShape& shape = {});

/// A kind of mesh by its name.
struct MeshKind {
    std::string name;
    std::string_view description;
    /// Whether it has sheets that meet, between cells with labels; these are neither manifold nor oriented alike, have
    /// at least fewest_vertices_of_labels and no amplitude, and their time grows with the 1.5th power of the vertices.
    bool has_cells = false;
};

/// All kinds that make_mesh supports.
std::span<const MeshKind> mesh_kinds();

/// The parameters that all kinds of mesh share; empty: the default of the kind.
struct MeshVariation {
    std::optional<std::uint32_t> seed;
    std::optional<double> amplitude;
    std::optional<double> noise;
};

/// Makes the mesh of a kind, with labels where it has cells.
/// @throws OptionError for a name that mesh_kinds does not list.
LabelSurface make_surface(std::string_view kind, Index vertices, const MeshVariation& variation = {});

/// The mesh alone.
PolygonMesh make_mesh(std::string_view kind, Index vertices, const MeshVariation& variation = {});

}  // namespace seamflow
