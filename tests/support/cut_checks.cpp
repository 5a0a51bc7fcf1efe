#include "tests/support/cut_checks.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "partition/connected_components.h"
#include "partition/labels.h"

namespace seamflow::test {

namespace {

std::optional<std::string> first_disconnected(const PolygonMesh& mesh, const Topology& topology,
                                              std::span<const Index> labels)
{
    const Components components = connected_components(mesh.n_faces(), [&](Index f, auto&& visit) {
        for_each_neighbour(mesh, topology, f, [&](Index, Index g) {
            if (labels[g] == labels[f])
                visit(g);
        });
    });
    std::set<Index> met;
    for (Index component = 0; component < components.count(); ++component)
        if (const Index f = components.nodes[component].front(); !met.insert(labels[f]).second)
            return "Part " + std::to_string(labels[f]) + " is not connected: face " + std::to_string(f) +
                   " lies apart.";
    return std::nullopt;
}

/// The number of the fan of the whole mesh that holds a corner.
std::size_t fan_of(const std::vector<Fan>& fans, Index corner)
{
    const auto holds = [&](const Fan& fan) {
        return std::find(fan.corners.begin(), fan.corners.end(), corner) != fan.corners.end();
    };
    return static_cast<std::size_t>(std::find_if(fans.begin(), fans.end(), holds) - fans.begin());
}

std::optional<std::string> pinch_at(const PolygonMesh& mesh, const Topology& topology, Index v,
                                    std::span<const Index> labels)
{
    std::vector<Index> around;
    labels_around(topology, labels, v, around);
    if (around.size() < 2)
        return std::nullopt;
    const std::vector<Fan> fans = fans_at(mesh, topology, v, {}, 0);
    for (const Index label : around) {
        std::vector<bool> met(fans.size(), false);
        for (const Fan& run : fans_at(mesh, topology, v, labels, label)) {
            const std::size_t fan = fan_of(fans, run.corners.front());
            if (met[fan])
                return "Part " + std::to_string(label) + " is pinched at vertex " + std::to_string(v) +
                       ": its faces there form several fans.";
            met[fan] = true;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::string> first_defect(const PolygonMesh& mesh, const Topology& topology,
                                        std::span<const Index> labels)
{
    if (auto defect = first_disconnected(mesh, topology, labels))
        return defect;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (auto defect = pinch_at(mesh, topology, v, labels))
            return defect;
    return std::nullopt;
}

Adjacency adjacency_of(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, Index n_parts)
{
    std::vector<std::pair<Index, Index>> pairs;
    std::vector<Index> around;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        if (!topology.moves(v))
            continue;
        labels_around(topology, labels, v, around);
        for (std::size_t i = 0; i < around.size(); ++i)
            for (std::size_t j = i + 1; j < around.size(); ++j)
                pairs.emplace_back(around[i], around[j]);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    Adjacency adjacency(usize(n_parts));
    for (const auto& [low, high] : pairs) {
        adjacency[low].push_back(high);
        adjacency[high].push_back(low);
    }
    for (auto& neighbours : adjacency)
        std::sort(neighbours.begin(), neighbours.end());
    return adjacency;
}

}  // namespace seamflow::test
