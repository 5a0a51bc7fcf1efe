#include "engine/near_origin.h"

#include <cmath>
#include <optional>
#include <utility>

namespace seamflow {

namespace {

/// From this distance on, in extents, a mesh lies far away.
constexpr double far = 16.0;

}  // namespace

Point offset_of(const Points& positions)
{
    if (positions.rows() == 0)
        return Point::Zero();
    const Point low = positions.colwise().minCoeff();
    const Point high = positions.colwise().maxCoeff();
    const double extent = (high - low).maxCoeff();
    if (!(positions.allFinite() && std::isnormal(extent)))
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
{
    mesh_->vertices.rowwise() -= offset_;
}

NearOrigin::~NearOrigin()
{
    mesh_->vertices.rowwise() += offset_;
}

PolygonMesh NearOrigin::brought_back(PolygonMesh mesh) const
{
    mesh.vertices.rowwise() += offset_;
    return mesh;
}

StepObserver NearOrigin::observing(const StepObserver& inner) const
{
    if (!inner)
        return {};
    return [this, inner](const StepState& state) {
        const Points positions = state.positions.rowwise() + offset_;
        std::optional<Points> reference;
        if (state.reference_positions != nullptr)
            reference = state.reference_positions->rowwise() + offset_;
        std::optional<PolygonMesh> pieces;
        if (state.pieces != nullptr)
            pieces = brought_back(*state.pieces);
        inner({state.step, positions, state.report, pieces ? &*pieces : nullptr, reference ? &*reference : nullptr,
               state.capture});
    };
}

}  // namespace seamflow
