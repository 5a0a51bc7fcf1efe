#include "engine/measure/surface_measures.h"

#include <algorithm>
#include <cmath>

#include "engine/tasks/parallel_loop.h"
#include "partition/metrics/vertex_distance.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/mean_curvature.h"

namespace seamflow {

namespace {

/// Around position(0) … position(n - 1).
template <class Position>
BoundingBox box_of(Index n, Position&& position)
{
    if (n == 0)
        return {};
    std::vector<BoundingBox> of_block(at(n / block_size) + 1, {position(0), position(0)});
    for_each_block(run_in_parallel, n, [&](Index block, Index begin, Index end) {
        BoundingBox box = of_block[block];
        for (Index i = begin; i < end; ++i) {
            box.low = box.low.cwiseMin(position(i));
            box.high = box.high.cwiseMax(position(i));
        }
        of_block[block] = box;
    });
    BoundingBox box = of_block.front();
    for (const BoundingBox& part : of_block) {
        box.low = box.low.cwiseMin(part.low);
        box.high = box.high.cwiseMax(part.high);
    }
    return box;
}

double curvature_at(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                    const ScaledLaplacian& laplacian, Index v)
{
    return topology.moves(v) && topology.kind[v] == VertexKind::Interior
               ? mean_curvature_vector(mesh, topology, positions, laplacian, v).norm()
               : 0.0;
}

}  // namespace

BoundingBox box_of_faces(const PolygonMesh& mesh)
{
    return box_of(mesh.n_corners(), [&](Index corner) { return mesh.vertices.row(mesh.face_vertices[corner]); });
}

double total_area(const PolygonMesh& mesh)
{
    return sum(run_in_parallel, mesh.n_faces(), [&](Index f) { return area(mesh.face(f), mesh.vertices); });
}

MeshSize size_of(const PolygonMesh& mesh)
{
    return {mesh.n_vertices(), total_area(mesh), mean_edge_length(mesh, mesh.vertices, run_in_parallel)};
}

double extent_of(const Points& positions)
{
    const BoundingBox box = box_of(static_cast<Index>(positions.rows()), [&](Index v) { return positions.row(v); });
    return (box.high - box.low).norm();
}

std::vector<double> measure_curvature(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                      const ScaledLaplacian& laplacian)
{
    std::vector<double> curvature(mesh.n_vertices());
    for_each(run_in_parallel, mesh.n_vertices(),
             [&](Index v) { curvature[v] = curvature_at(mesh, topology, positions, laplacian, v); });
    return curvature;
}

double largest_curvature(const std::vector<double>& curvature)
{
    double largest = 0.0;
    for (const double value : curvature)
        if (std::isfinite(value))
            largest = std::max(largest, value);
    return largest;
}

double measure_largest_curvature(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                 const ScaledLaplacian& laplacian)
{
    std::vector<double> of_block(at(mesh.n_vertices() / block_size) + 1, 0.0);
    for_each_block(run_in_parallel, mesh.n_vertices(), [&](Index block, Index begin, Index end) {
        for (Index v = begin; v < end; ++v)
            if (const double value = curvature_at(mesh, topology, positions, laplacian, v); std::isfinite(value))
                of_block[block] = std::max(of_block[block], value);
    });
    return largest_curvature(of_block);
}

}  // namespace seamflow
