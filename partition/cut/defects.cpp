#include "partition/cut/defects.h"

#include <algorithm>
#include <vector>

#include "partition/cut/at.h"

namespace seamflow
{

namespace
{

/// Marks all faces that hang together with f and have its label.
void flood(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, Index f,
           std::vector<bool>& reached)
{
    std::vector<Index> stack{f};
    reached[at(f)] = true;
    while (!stack.empty()) {
        const Index g = stack.back();
        stack.pop_back();
        for (Index h = mesh.face_offsets[at(g)]; h < mesh.face_offsets[at(g) + 1]; ++h) {
            const Index twin = topology.twin[at(h)];
            const Index across = twin < 0 ? g : topology.face_of[at(twin)];
            if (reached[at(across)] || labels[at(across)] != labels[at(f)])
                continue;
            reached[at(across)] = true;
            stack.push_back(across);
        }
    }
}

std::optional<std::string> first_disconnected(const PolygonMesh& mesh, const Topology& topology,
                                              std::span<const Index> labels)
{
    if (labels.empty())
        return std::nullopt;
    std::vector<bool> reached(labels.size(), false);
    std::vector<Index> sorted(labels.begin(), labels.end());
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    std::vector<bool> met(sorted.size(), false);
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        if (reached[at(f)])
            continue;
        const auto rank = std::lower_bound(sorted.begin(), sorted.end(), labels[at(f)]) - sorted.begin();
        if (met[static_cast<std::size_t>(rank)])
            return "Part " + std::to_string(labels[at(f)]) + " is not connected: face " + std::to_string(f) +
                   " lies apart.";
        met[static_cast<std::size_t>(rank)] = true;
        flood(mesh, topology, labels, f, reached);
    }
    return std::nullopt;
}

/// The number of the umbrella that holds a corner.
std::size_t umbrella_of(const std::vector<Fan>& umbrellas, Index corner)
{
    const auto holds = [&](const Fan& umbrella) {
        return std::find(umbrella.corners.begin(), umbrella.corners.end(), corner) != umbrella.corners.end();
    };
    return static_cast<std::size_t>(std::find_if(umbrellas.begin(), umbrellas.end(), holds) - umbrellas.begin());
}

std::optional<std::string> pinch_at(const PolygonMesh& mesh, const Topology& topology, Index v,
                                    std::span<const Index> labels)
{
    std::vector<Index> around;
    for (const Index corner : topology.corners_at(v))
        around.push_back(labels[at(topology.face_of[at(corner)])]);
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    if (around.size() < 2)
        return std::nullopt;
    const std::vector<Fan> umbrellas = fans_at(mesh, topology, v, {}, 0);
    for (const Index label : around) {
        std::vector<bool> met(umbrellas.size(), false);
        for (const Fan& fan : fans_at(mesh, topology, v, labels, label)) {
            const std::size_t umbrella = umbrella_of(umbrellas, fan.corners.front());
            if (met[umbrella])
                return "Part " + std::to_string(label) + " is pinched at vertex " + std::to_string(v) +
                       ": its faces there form several fans.";
            met[umbrella] = true;
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

}  // namespace seamflow
