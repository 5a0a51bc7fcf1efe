#include "partition/metrics/bounding_box.h"

#include <limits>

namespace seamflow {

namespace {

/// Around nothing.
BoundingBox empty_box()
{
    constexpr double farthest = std::numeric_limits<double>::infinity();
    return {Point::Constant(farthest), Point::Constant(-farthest)};
}

}  // namespace

BoundingBox box_of_faces(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    return box_of_vertices(positions, used_by_faces(mesh, exec), exec);
}

BoundingBox box_of_vertices(const Points& positions, std::span<const std::uint8_t> is_used, const Executor& exec)
{
    const BoundingBox box = reduce(
        exec, static_cast<Index>(positions.rows()), empty_box(),
        [&](BoundingBox& part, Index v) {
            const Point position = positions.row(v);
            if (is_used[v] == 0 || !position.allFinite())
                return;
            part.low = part.low.cwiseMin(position);
            part.high = part.high.cwiseMax(position);
        },
        [](BoundingBox& all, const BoundingBox& part) {
            all.low = all.low.cwiseMin(part.low);
            all.high = all.high.cwiseMax(part.high);
        });
    return box.low[0] <= box.high[0] ? box : BoundingBox{};
}

BoundingBox box_of_faces(const PolygonMesh& mesh, const Executor& exec)
{
    return box_of_faces(mesh, mesh.vertices, exec);
}

std::vector<Index> far_from_faces(const PolygonMesh& mesh, std::span<const Index> vertices, const Executor& exec)
{
    std::vector<Index> far;
    if (vertices.empty())
        return far;
    const BoundingBox box = box_of_faces(mesh, exec);
    for (const Index v : vertices) {
        const Point position = mesh.vertices.row(v);
        const Point inside = position.cwiseMax(box.low).cwiseMin(box.high);
        if ((position - inside).norm() > box.diagonal())
            far.push_back(v);
    }
    return far;
}

}  // namespace seamflow
