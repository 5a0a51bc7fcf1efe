#include "solvers/denoising/spikes.h"

#include <algorithm>
#include <limits>

namespace seamflow {

std::vector<Index> find_spikes(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                               const Executor& exec)
{
    constexpr double least_ratio = 10.0;
    return select(exec, mesh.n_vertices(), [&](Index v) {
        double shortest = std::numeric_limits<double>::infinity();
        double longest_around = 0.0;
        const auto corners = topology.corners_at(v);
        for (const Index corner : corners) {
            const auto face = mesh.face(topology.face_of[corner]);
            for (std::size_t k = 0; k < face.size(); ++k) {
                const Index from = face[k];
                const Index to = face[k + 1 < face.size() ? k + 1 : 0];
                const double squared = (positions.row(to) - positions.row(from)).squaredNorm();
                if (from == v || to == v)
                    shortest = std::min(shortest, squared);
                else
                    longest_around = std::max(longest_around, squared);
            }
        }
        return !corners.empty() && shortest > least_ratio * least_ratio * longest_around;
    });
}

}  // namespace seamflow
