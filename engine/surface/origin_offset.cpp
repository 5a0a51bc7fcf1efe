#include "engine/surface/origin_offset.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/bounding_box.h"

namespace seamflow {

namespace {

/// A mesh is far away if its distance from the origin is at least this many times its extent.
constexpr double far = 16.0;

bool has_sound_corners(const PolygonMesh& mesh)
{
    return std::ranges::all_of(mesh.face_vertices, [&](Index v) { return v >= 0 && v < mesh.n_vertices(); });
}

/// Whether the surface may lie far away. False if a few corners show that it does not, as in nearly all cases: every
/// vertex of a surface far away is further than `far` - ½ extents from the origin in some coordinate, and the extent of
/// a few corners is not larger.
bool may_lie_far(const PolygonMesh& mesh)
{
    constexpr std::size_t few = 1024;
    const std::size_t stride = std::max(mesh.face_vertices.size() / few, std::size_t{1});
    Point low = Point::Constant(std::numeric_limits<double>::infinity());
    Point high = -low;
    Point nearest = low;
    for (std::size_t corner = 0; corner < mesh.face_vertices.size(); corner += stride) {
        const Index v = mesh.face_vertices[corner];
        if (v < 0 || v >= mesh.n_vertices())
            return false;
        const Point position = mesh.vertices.row(v);
        low = low.cwiseMin(position);
        high = high.cwiseMax(position);
        nearest = nearest.cwiseMin(position.cwiseAbs());
    }
    return nearest.maxCoeff() >= (far - 0.5) * (high - low).maxCoeff();
}

}  // namespace

Point origin_offset(const PolygonMesh& mesh)
{
    if (!may_lie_far(mesh) || !has_sound_corners(mesh) || !mesh.vertices.allFinite())
        return Point::Zero();
    const auto& [low, high] = box_of_faces(mesh, run_in_parallel);
    const double extent = (high - low).maxCoeff();
    if (!std::isnormal(extent))
        return Point::Zero();
    // A multiple of the grid has few bits, so that the difference of a coordinate and the multiple has no more bits
    // than the coordinate.
    const double grid = std::exp2(std::ilogb(extent) + 1);
    Point offset = Point::Zero();
    for (int c = 0; c < 3; ++c) {
        const double middle = low[c] + (high[c] - low[c]) / 2.0;
        if (std::abs(middle) >= far * extent)
            offset[c] = std::round(middle / grid) * grid;
    }
    return offset;
}

}  // namespace seamflow
