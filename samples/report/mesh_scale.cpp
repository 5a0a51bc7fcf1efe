#include "samples/report/mesh_scale.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "partition/metrics/bounding_box.h"
#include "partition/metrics/edge_measures.h"
#include "partition/metrics/vertex_distance.h"

namespace seamflow {

MeshScale measure_scale(const PolygonMesh& mesh, const Executor& exec)
{
    const std::vector<std::uint8_t> is_used = used_by_faces(mesh, exec);
    const std::vector<Index> unused = select(exec, mesh.n_vertices(), [&](Index v) { return is_used[v] == 0; });
    const BoundingBox box = box_of_vertices(mesh.vertices, is_used, exec);
    MeshScale scale{.diagonal = box.diagonal(), .far_vertices = far_from_faces(box, mesh.vertices, unused)};
    EdgeMeasures edges = measure_edges(mesh, mesh.vertices, exec);
    scale.mean_edge = edges.mean;
    scale.spikes = std::move(edges.spikes);
    return scale;
}

}  // namespace seamflow
