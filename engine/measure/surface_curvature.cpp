#include "engine/measure/surface_curvature.h"

#include <algorithm>
#include <cmath>

#include "engine/tasks/parallel_loop.h"
#include "solvers/laplacian/mean_curvature.h"

namespace seamflow {

namespace {

double curvature_at(const PolygonMesh& mesh, const Topology& topology, const Points& positions, Laplacian laplacian,
                    Index v)
{
    return topology.moves(v) && topology.kind[v] == VertexKind::Interior
               ? mean_curvature_vector(mesh, topology, positions, laplacian, v).norm()
               : 0.0;
}

}  // namespace

std::vector<double> measure_curvature(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                      Laplacian laplacian)
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
                                 Laplacian laplacian)
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
