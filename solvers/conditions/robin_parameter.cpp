#include "solvers/conditions/robin_parameter.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <utility>

#include "partition/decomposition/sub_mesh.h"

namespace seamflow {

namespace {

/// The edges of a sub-mesh by vertex, with lengths. Each edge is listed at both of its ends, and twice where it has two
/// faces.
struct EdgeLists {
    IndexLists neighbours;
    std::vector<double> lengths;
};

/// The edges of all faces of a sub-mesh.
/// @param positions #local by 3.
EdgeLists list_edges(const SubMesh& sub_mesh, const Points& positions)
{
    EdgeLists lists;
    lists.neighbours = make_lists(sub_mesh.n_vertices, [&](auto&& add) {
        for (Index f = 0; f < sub_mesh.face_vertices.size(); ++f) {
            const auto corners = sub_mesh.face_vertices[f];
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const Index next = corners[(k + 1) % corners.size()];
                add(corners[k], next);
                add(next, corners[k]);
            }
        }
    });
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        for (const Index w : lists.neighbours[v])
            lists.lengths.push_back((positions.row(w) - positions.row(v)).norm());
    return lists;
}

/// The length of the edge that represents ‖e‖; infinite if no edge has a positive length.
double representative_edge(const EdgeLists& edges, PEdge which)
{
    constexpr double percentile = 0.05;
    constexpr double sliver = 0.1;
    std::vector<double> lengths;
    std::copy_if(edges.lengths.begin(), edges.lengths.end(), std::back_inserter(lengths),
                 [](double length) { return length > 0.0; });
    if (lengths.empty())
        return std::numeric_limits<double>::infinity();
    std::sort(lengths.begin(), lengths.end());
    const double shortest = lengths.front();
    const double short_one = lengths[static_cast<std::size_t>(percentile * static_cast<double>(lengths.size()))];
    switch (which) {
    case PEdge::Automatic:
        return shortest < sliver * short_one ? short_one : shortest;
    case PEdge::Minimum:
        return shortest;
    case PEdge::Percentile:
        return short_one;
    case PEdge::Mean:
        break;
    }
    return std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
}

/// The largest distance along edges from any vertex to the nearest one of Γ (Dijkstra's algorithm).
double largest_distance_from_interface(const SubMesh& sub_mesh, const EdgeLists& edges)
{
    using Reached = std::pair<double, Index>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
    std::vector<double> distance(sub_mesh.n_vertices, std::numeric_limits<double>::infinity());
    for (const Index v : sub_mesh.interface.vertices) {
        distance[v] = 0.0;
        front.emplace(0.0, v);
    }
    double largest = 0.0;
    while (!front.empty()) {
        const auto [reached, v] = front.top();
        front.pop();
        if (reached > distance[v])
            continue;
        largest = reached;
        for (Index e = edges.neighbours.offsets[v]; e < edges.neighbours.offsets[v + 1]; ++e) {
            const Index neighbour = edges.neighbours.values[e];
            const double through_v = reached + edges.lengths[e];
            if (through_v < distance[neighbour]) {
                distance[neighbour] = through_v;
                front.emplace(through_v, neighbour);
            }
        }
    }
    return largest;
}

}  // namespace

double optimal_robin_parameter(const SubMesh& sub_mesh, const Points& positions, double eta, PEdge edge)
{
    if (sub_mesh.interface.vertices.empty())
        return 0.0;
    const EdgeLists edges = list_edges(sub_mesh, positions);
    const double length = representative_edge(edges, edge);
    if (!std::isfinite(length))
        return 0.0;
    const double width = std::max(length, largest_distance_from_interface(sub_mesh, edges));
    const double k_min = std::numbers::pi / width;
    const double k_max = std::numbers::pi / length;
    return std::sqrt(std::sqrt((k_min * k_min + eta) * (k_max * k_max + eta)));
}

}  // namespace seamflow
