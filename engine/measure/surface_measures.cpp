#include "engine/measure/surface_measures.h"

#include <algorithm>
#include <cmath>

#include "engine/tasks/parallel_executor.h"
#include "solvers/laplacian/mean_curvature.h"

namespace seamflow {

namespace {

/// ‖ΔV‖ at an interior vertex that may move, in 1/length; 0 at other vertices.
double curvature_at(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                    const ScaledLaplacian& laplacian, Index v)
{
    return topology.moves(v) && topology.kind[v] == VertexKind::Interior
               ? mean_curvature_vector(mesh, topology, positions, laplacian, v).norm()
               : 0.0;
}

/// The largest finite number among value(0) … value(n - 1), or 0.
template <class Value>
double largest_finite(Index n, Value&& value)
{
    const auto keep_larger = [](double& largest, double found) {
        if (std::isfinite(found))
            largest = std::max(largest, found);
    };
    return reduce(
        run_in_parallel, n, 0.0, [&](double& largest, Index i) { keep_larger(largest, value(i)); }, keep_larger);
}

}  // namespace

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
    return largest_finite(static_cast<Index>(curvature.size()), [&](Index v) { return curvature[v]; });
}

double measure_largest_curvature(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                 const ScaledLaplacian& laplacian)
{
    return largest_finite(mesh.n_vertices(),
                          [&](Index v) { return curvature_at(mesh, topology, positions, laplacian, v); });
}

}  // namespace seamflow
