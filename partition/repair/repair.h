#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The parts and faces of a cut that may have defects (see repair); the others are known to have none.
struct SuspectedDefects {
    /// One entry per label: whether the part may not be connected.
    std::vector<bool> parts;
    /// Faces such that each vertex at which a part may be pinched is a corner of one of them. In any order; repetitions
    /// are allowed.
    std::vector<Index> faces;
};

/// Makes every part a manifold with boundary: connected through edges, and with one fan of faces around each of its
/// vertices (where the mesh itself has several fans at a vertex, one run of faces in each). Moves faces between
/// neighbouring parts, as few as possible; where this fails it merges parts, and a part in several connected components
/// of the mesh becomes one part in each. A cut without defects is left as it is. Always succeeds; the same input gives
/// the same result. About linear in the size of the mesh.
/// @param labels #F, at least 0; on return from 0 to n_parts - 1 without gaps. The order of labels is kept; parts that
/// had to be divided get new labels after the largest.
/// @returns the number of faces whose label changed, not counting renumbering.
Index repair(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels,
             const Executor& exec = run_serially);

/// Repairs a cut whose parts are each known to lie within one connected component of the mesh.
Index repair_within_components(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels,
                               const Executor& exec = run_serially);

/// Repairs a cut, as repair_within_components does, that is known to have defects only where they are suspected.
/// @param labels #F, from 0 to n_parts - 1 without gaps, as many as suspected.parts has entries.
Index repair_where_suspected(const PolygonMesh& mesh, const Topology& topology, const SuspectedDefects& suspected,
                             std::vector<Index>& labels, const Executor& exec = run_serially);

}  // namespace seamflow
