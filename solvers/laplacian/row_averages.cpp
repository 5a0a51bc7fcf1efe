#include "solvers/laplacian/row_averages.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "partition/errors.h"
#include "partition/index_lists.h"
#include "solvers/laplacian/vertex_row.h"

namespace seamflow {

namespace {

/// About this many vertices, evenly spread, are averaged over.
constexpr Index sample_size = 512;

}  // namespace

RowAverages average_rows(const PolygonMesh& mesh, const Topology& topology, const ScaledLaplacian& laplacian)
{
    RowAverages sum;
    double n = 0.0;
    with_kernel(laplacian, [&]<class Kernel>(Kernel kernel) {
        if constexpr (EdgeKernel<Kernel> || FaceKernel<Kernel>) {
            std::vector<Index> neighbours;
            for (Index v = 0; v < mesh.n_vertices(); v += std::max(mesh.n_vertices() / sample_size, Index{1})) {
                if (!topology.moves(v) || topology.kind[v] != VertexKind::Interior)
                    continue;
                neighbours.clear();
                double diagonal = 0.0;
                const double mass = visit_row(kernel, mesh, topology, mesh.vertices, v, [&](Index w, double k) {
                    neighbours.push_back(w);
                    diagonal -= k;
                });
                if (!std::isfinite(diagonal / mass))
                    continue;
                sort_unique(neighbours);
                sum.length += static_cast<double>(neighbours.size());
                sum.stiffness += diagonal / mass;
                n += 1.0;
            }
        } else {
            throw OptionError("the Laplacian is not symmetric");
        }
    });
    return n > 0.0 ? RowAverages{sum.length / n, sum.stiffness / n} : RowAverages{};
}

}  // namespace seamflow
