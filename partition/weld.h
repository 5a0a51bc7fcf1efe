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
    /// The same faces, of the `first` vertices only. A merged vertex lies at the mean of its copies.
    PolygonMesh mesh;
    /// The topology of `mesh`.
    Topology topology;
    /// #V: the lowest of the vertices that each was merged with; its own number if it was not merged.
    std::vector<Index> first;
    /// How many vertices were merged with others.
    Index n_vertices = 0;
    /// How many pairs of boundary edges became one edge each.
    Index n_edges = 0;
};

/// Joins boundary edges in pairs: two whose ends are at equal places, that run in opposite directions, with no third
/// one at their place. So surfaces touching in points, edges of three faces, and sheets that lie on each other stay as
/// they are. Pairs are not joined where this would leave a face with a vertex twice, an edge with three faces or a
/// non-manifold vertex. Linear in the size of the mesh; almost free if it has no boundary.
/// @param mesh valid, but coordinates need not be finite. @param topology of `mesh`.
/// @param distance within which places count as equal, in units of length; at least 0, and small compared with edges:
///        places this near to more than a few others are not joined. 0: coordinates must be equal.
/// @returns nothing if nothing is joined.
std::optional<Weld> weld(const PolygonMesh& mesh, const Topology& topology, double distance,
                         const Executor& exec = run_serially);

/// On joined seams; nothing where none are joined and places had to be equal. If they are
/// further apart than cracks are, and hold a tenth of all vertices or more, it is a warning: the distance may be too
/// large.
/// @param n_vertices, n_edges see Weld. @param n_of_mesh all vertices. @param distance see weld. @param apart how far
/// vertices went to be joined, at most, in mean edge lengths.
std::optional<Remark> remark_on_seams(Index n_vertices, Index n_edges, std::int64_t n_of_mesh, double distance,
                                      double apart);

}  // namespace seamflow
