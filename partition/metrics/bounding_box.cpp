#include "partition/metrics/bounding_box.h"

#include "partition/metrics/box.h"

namespace seamflow {

BoundingBox box_of_faces(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    return box_of_vertices(positions, used_by_faces(mesh, exec), exec);
}

BoundingBox box_of_vertices(const Points& positions, std::span<const std::uint8_t> is_used, const Executor& exec)
{
    const Box box = reduce(
        exec, static_cast<Index>(positions.rows()), Box(),
        [&](Box& part, Index v) {
            const Point position = positions.row(v);
            if (is_used[v] == 0 || !position.allFinite())
                return;
            part.add(position);
        },
        [](Box& all, const Box& part) { all.add(part); });
    return box.low[0] <= box.high[0] ? BoundingBox{box.low, box.high} : BoundingBox{};
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
