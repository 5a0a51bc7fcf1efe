#pragma once

#include <vector>

#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Appends `start` and all nodes of a graph that can be reached from it to `nodes`, breadth first.
/// @param expand called with each node in this order, and with a function to call for each neighbour of the node not
///        reached before; it must itself mark the nodes that are reached; `start` counts as reached.
template <class Expand>
void append_reachable(Index start, std::vector<Index>& nodes, Expand&& expand)
{
    std::size_t next = nodes.size();
    nodes.push_back(start);
    for (; next < nodes.size(); ++next)
        expand(nodes[next], [&nodes](Index node) { nodes.push_back(node); });
}

/// The connected components of a graph.
struct Components {
    /// One entry per node, from 0 to count() - 1, numbered by their lowest nodes.
    std::vector<Index> component_of;
    /// The nodes of each component, breadth first from its lowest one.
    IndexLists nodes;

    [[nodiscard]] Index count() const { return nodes.size(); }
};

/// Finds the connected components of a graph.
/// @param for_each_neighbour called with a node and a function that it calls for each neighbour of the node; the
///        neighbour relation must be symmetric.
template <class ForEachNeighbour>
Components connected_components(Index n_nodes, ForEachNeighbour&& for_each_neighbour)
{
    Components found;
    found.component_of.assign(n_nodes, -1);
    for (Index lowest = 0; lowest < n_nodes; ++lowest) {
        if (found.component_of[lowest] >= 0)
            continue;
        const Index component = found.count();
        found.component_of[lowest] = component;
        append_reachable(lowest, found.nodes.values, [&](Index node, auto&& reach) {
            for_each_neighbour(node, [&](Index neighbour) {
                if (found.component_of[neighbour] >= 0)
                    return;
                found.component_of[neighbour] = component;
                reach(neighbour);
            });
        });
        found.nodes.close();
    }
    return found;
}

/// The most faces at an edge that are all neighbours of each other. At an edge of more faces, only consecutive ones are
/// neighbours: the number of all pairs is quadratic.
inline constexpr Index most_mutual_neighbours = 16;

/// Calls visit with half-edges at the edge of h, if it is a junction (see free_junctions): with all whose faces are
/// neighbours of h's face. These are all others there, or, at more than most_mutual_neighbours faces, the next and the
/// previous one.
template <class Visit>
void for_each_at_junction(const Topology& topology, Index h, Visit&& visit)
{
    const Index index = topology.junction_index(h);
    if (index < 0)
        return;
    const JunctionLink& link = topology.junctions[index];
    visit(link.next);
    if (link.n_faces > most_mutual_neighbours)
        visit(link.previous);
    else
        for (Index other = topology.next_at_junction(link.next); other != h; other = topology.next_at_junction(other))
            visit(other);
}

/// Calls visit(half-edge of f, neighbouring face) for each half-edge of face f that has a twin; for a half-edge at a
/// junction, once for each neighbour there.
template <class Visit>
void for_each_neighbour(const PolygonMesh& mesh, const Topology& topology, Index f, Visit&& visit)
{
    for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h)
        if (const Index twin = topology.twin[h]; twin >= 0)
            visit(h, topology.face_of[twin]);
        else
            for_each_at_junction(topology, h, [&](Index other) { visit(h, topology.face_of[other]); });
}

/// The connected components of the faces of a mesh. Faces are connected through edges of exactly two faces: a shared
/// vertex connects nothing, nor does an edge of three or more faces without free_junctions. Linear in the size of the
/// mesh.
inline Components face_components(const PolygonMesh& mesh, const Topology& topology)
{
    return connected_components(mesh.n_faces(), [&](Index f, auto&& visit) {
        for_each_neighbour(mesh, topology, f, [&](Index, Index g) { visit(g); });
    });
}

}  // namespace seamflow
