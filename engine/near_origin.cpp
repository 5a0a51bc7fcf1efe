#include "engine/near_origin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "engine/mesh_size.h"
#include "partition/loop.h"

namespace seamflow {

namespace {

/// From this distance on, in extents, a mesh lies far away.
constexpr double far = 16.0;

bool has_sound_corners(const PolygonMesh& mesh)
{
    return std::ranges::all_of(mesh.face_vertices, [&](Index v) { return v >= 0 && v < mesh.n_vertices(); });
}

/// False where a few corners already show that the surface does not lie far away, which is nearly always. Every vertex
/// of one that does is further than `far` - ½ extents from the origin in some coordinate, and extents of a few are
/// smaller.
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

std::vector<Index> vertices_without_faces(const PolygonMesh& mesh)
{
    std::vector<std::uint8_t> has_face(at(mesh.n_vertices()), 0);
    for (const Index v : mesh.face_vertices)
        has_face[at(v)] = 1;
    return select(run_serially, mesh.n_vertices(), [&](Index v) { return has_face[at(v)] == 0; });
}

}  // namespace

Point offset_of(const PolygonMesh& mesh)
{
    if (!may_lie_far(mesh) || !has_sound_corners(mesh) || !mesh.vertices.allFinite())
        return Point::Zero();
    const auto [low, high] = box_of_faces(mesh);
    const double extent = (high - low).maxCoeff();
    if (!std::isnormal(extent))
        return Point::Zero();
    // Multiples of the grid have few bits: what is left of a coordinate beside one has no more than it had itself.
    const double grid = std::exp2(std::ilogb(extent) + 1);
    Point offset = Point::Zero();
    for (int c = 0; c < 3; ++c) {
        const double middle = low[c] + (high[c] - low[c]) / 2.0;
        if (std::abs(middle) >= far * extent)
            offset[c] = std::round(middle / grid) * grid;
    }
    return offset;
}

NearOrigin::NearOrigin(PolygonMesh& mesh, const Point& offset)
    : mesh_(&mesh)
    , offset_(offset)
    , isolated_(vertices_without_faces(mesh))
    , of_isolated_(mesh.vertices(isolated_, Eigen::all))
{
    mesh_->vertices.rowwise() -= offset_;
}

NearOrigin::~NearOrigin()
{
    bring_back(mesh_->vertices);
}

/// @param positions #V by 3, and any number of further rows.
void NearOrigin::bring_back(Points& positions) const
{
    positions.rowwise() += offset_;
    for (std::size_t i = 0; i < isolated_.size(); ++i)
        positions.row(isolated_[i]) = of_isolated_.row(static_cast<Eigen::Index>(i));
}

PolygonMesh NearOrigin::brought_back(PolygonMesh mesh) const
{
    bring_back(mesh.vertices);
    return mesh;
}

StepObserver NearOrigin::observing(const StepObserver& inner) const
{
    if (!inner)
        return {};
    return [this, inner](const StepState& state) {
        Points positions = state.positions;
        bring_back(positions);
        std::optional<Points> reference;
        if (state.reference_positions != nullptr)
            bring_back(reference.emplace(*state.reference_positions));
        std::optional<PolygonMesh> pieces;
        if (state.pieces != nullptr)
            pieces = brought_back(*state.pieces);
        inner({state.step, positions, state.report, pieces ? &*pieces : nullptr, reference ? &*reference : nullptr,
               state.capture});
    };
}

}  // namespace seamflow
