#include "engine/fields/distance_bounds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "engine/tasks/parallel_executor.h"

namespace seamflow {

EdgePaths paths_along_edges(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> from)
{
    using Front = std::pair<double, Index>;
    EdgePaths paths{std::vector<double>(usize(mesh.n_vertices()), std::numeric_limits<double>::infinity()),
                    std::vector<Index>(usize(mesh.n_vertices()), -1)};
    std::priority_queue<Front, std::vector<Front>, std::greater<>> fronts;
    for (const Index v : from) {
        paths.length[v] = 0.0;
        paths.from[v] = v;
        fronts.emplace(0.0, v);
    }
    while (!fronts.empty()) {
        const auto [length, v] = fronts.top();
        fronts.pop();
        if (length > paths.length[v])
            continue;
        for (const Index corner : topology.corners_at(v))
            for (const Index end : {topology.next(mesh, corner), topology.previous(mesh, corner)}) {
                const Index w = mesh.face_vertices[end];
                const double to_w = length + (mesh.vertices.row(w) - mesh.vertices.row(v)).norm();
                if (to_w < paths.length[w]) {
                    paths.length[w] = to_w;
                    paths.from[w] = paths.from[v];
                    fronts.emplace(to_w, w);
                }
            }
    }
    return paths;
}

std::vector<double> straight_within_faces(const PolygonMesh& mesh, const Topology& topology,
                                          std::span<const Index> from)
{
    std::vector<double> straight(usize(mesh.n_vertices()), std::numeric_limits<double>::infinity());
    for (const Index v : from)
        for (const Index corner : topology.corners_at(v))
            for (const Index w : mesh.face(topology.face_of[usize(corner)]))
                straight[w] = std::min(straight[w], (mesh.vertices.row(w) - mesh.vertices.row(v)).norm());
    return straight;
}

std::vector<double> straight_distances(const PolygonMesh& mesh, std::span<const Index> from)
{
    constexpr double most_pairs = 1e9;
    std::vector<double> straight(usize(mesh.n_vertices()), 0.0);
    if (static_cast<double>(from.size()) * mesh.n_vertices() > most_pairs)
        return straight;
    for_each(run_in_parallel, mesh.n_vertices(), [&](Index v) {
        double least = std::numeric_limits<double>::infinity();
        for (const Index w : from)
            least = std::min(least, (mesh.vertices.row(v) - mesh.vertices.row(w)).squaredNorm());
        straight[v] = std::sqrt(least);
    });
    return straight;
}

}  // namespace seamflow
