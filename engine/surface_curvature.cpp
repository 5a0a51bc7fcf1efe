#include "engine/surface_curvature.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel_loop.h"
#include "solvers/mean_curvature.h"

namespace seamflow {

std::vector<double> measure_curvature(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                      Laplacian laplacian)
{
    std::vector<double> curvature(at(mesh.n_vertices()), 0.0);
    for_each(run_in_parallel, mesh.n_vertices(), [&](Index v) {
        if (topology.moves(v) && topology.kind[at(v)] == VertexKind::Interior)
            curvature[at(v)] = mean_curvature_vector(mesh, topology, positions, laplacian, v).norm();
    });
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

}  // namespace seamflow
