#include "engine/measure/mesh_size.h"

#include "engine/tasks/parallel_loop.h"
#include "partition/loop.h"
#include "partition/metrics/vertex_distance.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

BoundingBox box_of_faces(const PolygonMesh& mesh)
{
    if (mesh.face_vertices.empty())
        return {};
    const Point first = mesh.vertices.row(mesh.face_vertices.front());
    BoundingBox box{first, first};
    for (const Index v : mesh.face_vertices) {
        const Point position = mesh.vertices.row(v);
        box.low = box.low.cwiseMin(position);
        box.high = box.high.cwiseMax(position);
    }
    return box;
}

double total_area(const PolygonMesh& mesh)
{
    return sum(run_in_parallel, mesh.n_faces(), [&](Index f) { return area(mesh.face(f), mesh.vertices); });
}

MeshSize size_of(const PolygonMesh& mesh)
{
    return {mesh.n_vertices(), total_area(mesh), mean_edge_length(mesh, mesh.vertices, run_in_parallel)};
}

}  // namespace seamflow
