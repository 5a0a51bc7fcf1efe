#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

/// Sheets between the cells that labels divide space into, as of segmented images: sheets meet along edges of three
/// faces or more.
namespace seamflow {

/// The cell that a point belongs to; 0 outside all cells, negative where there is nothing, not even an outside.
using Labels = std::function<Index(const Point&)>;

/// A mesh and the labels on the two sides of each face.
struct LabelSurface {
    PolygonMesh mesh;
    /// #F: on the side that the normal points to, and on the other. Empty for meshes without labels.
    std::vector<Index> front = {};
    std::vector<Index> back = {};
};

/// The faces between cubes of different labels in a box of unit cubes: quads, whose normals point to the lower label.
/// Memory is linear in their number, time in the number of cubes.
/// @param size cubes along each axis; around the box there is nothing. @param label of the cube around a point.
LabelSurface faces_between(Index size, const Labels& label);

/// The surface with every quad cut in two.
LabelSurface cut_into_triangles(const LabelSurface& quads);

/// Labels in the unit cube, which cells are within or fill.
/// @param seed of what is drawn at random.
Labels two_balls(std::uint32_t seed = 1);
Labels three_bubbles(std::uint32_t seed = 1);
Labels honeycomb(std::uint32_t seed = 1);
Labels plates_of_a_t(std::uint32_t seed = 1);
/// @param n_cells at least 1.
Labels foam_of(int n_cells, std::uint32_t seed = 1);
Labels foam(std::uint32_t seed = 1);

inline constexpr Index fewest_vertices_of_labels = 1000;
inline constexpr Index most_vertices_of_labels = 10'000'000;

/// Quads between labels in the unit cube, in steps as of voxels.
/// @param vertices about so many, between the limits above.
/// @param noise each vertex within the cube is displaced by up to this many edge lengths in x, y and z, at least 0.
/// @param seed of the noise.
/// @throws OptionError for an argument outside its limits.
LabelSurface make_label_surface(const Labels& labels, Index vertices, double noise = 0.0, std::uint32_t seed = 1);

}  // namespace seamflow
