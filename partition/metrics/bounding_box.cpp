#include "partition/metrics/bounding_box.h"

#include <fmt/format.h>

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

std::vector<Index> far_from_faces(const BoundingBox& of_faces, const Points& positions, std::span<const Index> vertices)
{
    std::vector<Index> far;
    for (const Index v : vertices) {
        const Point position = positions.row(v);
        const Point inside = position.cwiseMax(of_faces.low).cwiseMin(of_faces.high);
        if ((position - inside).norm() > of_faces.diagonal())
            far.push_back(v);
    }
    return far;
}

Remark remark_on_far_vertices(const std::vector<Index>& vertices)
{
    const bool is_one = vertices.size() == 1;
    return fmt::format(
        "{} no face and lie{} further from the surface than it is large: {}; remove {} where other programs mind.",
        is_one ? fmt::format("Vertex {} (numbered from 0) has", vertices.front())
               : fmt::format("{} vertices, the first of which is {} (numbered from 0), have", vertices.size(),
                             vertices.front()),
        is_one ? "s" : "",
        is_one ? "it stays there, and counts in no length" : "they stay there, and count in no length",
        is_one ? "it" : "them");
}

}  // namespace seamflow
