#pragma once

#include <optional>
#include <string>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// A mesh whose surface goes on across the seams at which its vertices are doubled, as they are in many files along the
/// seams of a texture. A vertex has the number that it had; those that have become one with another have no faces.
struct Weld {
    /// The same faces, of the first vertices alone. What became one lies in the middle of what it was.
    PolygonMesh mesh;
    /// Of that mesh.
    Topology topology;
    /// #V: the lowest of the vertices that each has become one with; its own number if it is none with another.
    std::vector<Index> first;
    /// How many vertices have become one with others.
    Index n_vertices = 0;
    /// How many pairs of boundary edges have become one edge each.
    Index n_edges = 0;
};

/// Joins boundary edges in pairs: two whose ends are at equal places, that run in opposite directions, and that have no
/// third one at their place. So what touches in points, edges of three faces, and sheets that lie on each other stay as
/// they are. Pairs are given up where joining them would leave a face with a vertex twice, an edge with three faces or
/// a vertex that is not manifold. Linear in the size of the mesh; where it has no boundary, next to nothing.
/// @param mesh valid, but that coordinates need not be finite. @param topology of it.
/// @param distance within which places count as equal, in units of length; at least 0, and small against edges: places
///        that are so near to more than a few others are joined to none. 0: coordinates have to be equal.
/// @returns nothing if nothing is joined.
std::optional<Weld> weld(const PolygonMesh& mesh, const Topology& topology, double distance,
                         const Executor& exec = run_serially);

/// What became of seams, a sentence for the user.
/// @param n_vertices, n_edges see Weld.
std::string remark_on_seams(Index n_vertices, Index n_edges);

}  // namespace seamflow
