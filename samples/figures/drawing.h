#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "partition/formats/palette.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// A picture: red, green, blue and opacity of each pixel, row by row from the top.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;
};

/// The view of surfaces: obliquely from above, in parallel projection. It is the same for all pictures of a figure, so
/// that they can be compared.
class Viewpoint {
  public:
    /// @param mesh fills the picture; it has faces; vertices without faces are ignored.
    explicit Viewpoint(const PolygonMesh& mesh);

    /// In pixels to the right and downwards; the third coordinate grows towards the eye.
    [[nodiscard]] Points seen(const Points& positions) const;

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

  private:
    /// Columns: to the right, downwards, to the eye.
    Eigen::Matrix3d axes_;
    Eigen::RowVector3d corner_ = Eigen::RowVector3d::Zero();
    double scale_ = 1.0;
    int width_ = 0;
    int height_ = 0;
};

/// The colour at a point of a triangle, from the value that the vertices' values have there.
using Paint = std::function<Colour(Index triangle, double value)>;

/// Draws a surface lit by a lamp over the viewer's shoulder, each triangle flat, both sides alike. Triangles with
/// coordinates that are not finite are left out; parts outside the picture are cut off.
/// @param values #V, looked up pixel by pixel, like a texture.
Image draw(const PolygonMesh& triangles, std::span<const double> values, const Paint& paint,
           const Viewpoint& viewpoint);

/// Writes a picture as PNG, whole or not at all.
/// @throws OutputError naming the file.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace seamflow
