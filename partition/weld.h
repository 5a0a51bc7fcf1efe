#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/topology.h"

namespace seamflow {

/// A mesh whose surface continues across the seams at which its vertices are duplicated, as in many files along the
/// seams of a texture. Vertices keep their numbers; those merged into another have no faces.
struct Weld {
    /// The same faces, whose corners are representatives only. A representative lies at the mean of the vertices that
    /// were merged into it.
    PolygonMesh mesh;
    /// The topology of `mesh`.
    Topology topology;
    /// #V: the lowest vertex of the group into which a vertex was merged; its own number if it was not merged.
    std::vector<Index> representative;
    /// The number of vertices that were merged with others.
    Index n_vertices = 0;
    /// The number of pairs of boundary edges that became one edge each.
    Index n_edges = 0;
};

/// Joins boundary edges in pairs: two edges whose ends have equal positions and that run in opposite directions, if no
/// third edge has the same ends. Surfaces that touch in points, edges of three faces, and sheets that lie on each other
/// thus do not change. Pairs are not joined if this would leave a face with a vertex twice, an edge with three faces or
/// a non-manifold vertex. Linear in the size of the mesh; takes hardly any time if the mesh has no boundary.
/// @param mesh valid, but coordinates need not be finite. @param topology of `mesh`.
/// @param distance within which positions count as equal, in units of length; at least 0, and small compared with
///        edges: positions this near to more than a few others are not joined. 0: coordinates must be equal.
/// @returns nothing if nothing is joined.
std::optional<Weld> weld(const PolygonMesh& mesh, const Topology& topology, double distance,
                         const Executor& exec = run_serially);

/// A sentence for the user about seams, joined or not; nothing if none are joined and positions had to be equal. If the
/// joined vertices were further apart than cracks are, and are a tenth of all vertices or more, it is a warning: the
/// distance may be too large.
/// @param n_vertices, n_edges the numbers of merged vertices and of joined pairs of edges (see Weld). @param n_of_mesh
/// the number of all vertices. @param distance as for weld: within which positions counted as equal. @param apart the
/// largest distance by which vertices moved to be joined, in mean edge lengths.
std::optional<Remark> remark_on_seams(Index n_vertices, Index n_edges, std::int64_t n_of_mesh, double distance,
                                      double apart);

}  // namespace seamflow
