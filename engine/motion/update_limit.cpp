#include "engine/motion/update_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"

namespace seamflow {

namespace {

/// The first vertex whose position is not finite; if all are finite, the vertex with the largest displacement.
/// @param unit about the size of the mesh, so that squares neither overflow nor vanish.
Index farthest_mover(const Points& before, const Points& after, double unit)
{
    struct Mover {
        Index vertex = 0;
        double square = -1.0;
        void meet(Index v, double of_v)
        {
            if (of_v <= square)
                return;
            vertex = v;
            square = of_v;
        }
    };
    const auto n = static_cast<Index>(after.rows());
    const double scale = std::isnormal(1.0 / unit) ? 1.0 / unit : 1.0;
    // A displacement whose square overflows is large, but counts as less than a position that is not finite.
    const auto square_of = [scale](const auto& to, const auto& from) {
        return to.allFinite() ? std::min(((to - from) * scale).squaredNorm(), std::numeric_limits<double>::max())
                              : std::numeric_limits<double>::infinity();
    };
    return reduce(
               run_in_parallel, n, Mover{},
               [&](Mover& farthest, Index v) { farthest.meet(v, square_of(after.row(v), before.row(v))); },
               [](Mover& farthest, const Mover& mover) { farthest.meet(mover.vertex, mover.square); })
        .vertex;
}

}  // namespace

UpdateLimit::UpdateLimit(const PolygonMesh& mesh, double diagonals)
    : mesh_(mesh)
{
    const BoundingBox box = box_of_faces(mesh, run_in_parallel);
    diagonal_ = (box.high - box.low).stableNorm();
    largest_ = diagonals * diagonal_;
}

std::optional<UpdateLimit::Excess> UpdateLimit::find(const Points& before, const Points& after) const
{
    if (after.rows() == 0)
        return std::nullopt;
    const Index vertex = farthest_mover(before, after, diagonal_);
    if (!after.row(vertex).allFinite())
        return Excess{vertex, "would go to a position that is not finite"};
    const double update = (after.row(vertex) - before.row(vertex)).stableNorm();
    if (!(update > largest_))
        return std::nullopt;
    return Excess{vertex,
                  fmt::format(fmt::runtime(largest_ == diagonal_
                                               ? "would move by {:.3g}, but the mesh is {:.3g} across"
                                               : "would move by {:.3g}, but largest_update allows {:.3g} at most"),
                              update, largest_)};
}

void UpdateLimit::require(const Points& before, const Points& after, std::span<const Index> labels) const
{
    const std::optional<Excess> excess = find(before, after);
    if (!excess)
        return;
    Index face = 0;
    const Index n_labels = static_cast<Index>(labels.size());
    while (face < n_labels && std::ranges::find(mesh_.face(face), excess->vertex) == mesh_.face(face).end())
        ++face;
    const std::string where = face < n_labels ? fmt::format("sub-mesh {}, ", labels[face]) : "";
    const std::string_view remedy = labels.empty() ? "smooth less" : "use a smaller time step or another Laplacian";
    throw ComputationError(
        fmt::format("{}vertex {} {}: {}, or repair the mesh there", where, excess->vertex, excess->what, remedy));
}

}  // namespace seamflow
