#include "engine/mesh_size.h"

#include "engine/parallel_loop.h"
#include "partition/loop.h"
#include "partition/metrics/vertex_distance.h"
#include "solvers/geometry.h"

namespace seamflow {

double total_area(const PolygonMesh& mesh)
{
    return sum(run_in_parallel, mesh.n_faces(), [&](Index f) { return area(mesh.face(f), mesh.vertices); });
}

MeshSize size_of(const PolygonMesh& mesh)
{
    return {mesh.n_vertices(), total_area(mesh), mean_edge_length(mesh, mesh.vertices, run_in_parallel)};
}

}  // namespace seamflow
