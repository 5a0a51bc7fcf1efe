#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/laplacian/laplacian.h"
#include "solvers/systems/block_row_matrix.h"

namespace seamflow {

/// The assignment of the vertices to the rows of the equations of a whole mesh.
struct WholeMeshRows {
    /// The vertices that have no row, not even one of the identity.
    std::vector<Index> without_row;
    /// The vertices of the rows, in blocks of vertices that are near each other.
    IndexLists vertices;
    /// #V: the row of each vertex; -1 for a vertex without a row.
    std::vector<Index> row_of;
};

/// Gives a row to each vertex, except to those without faces if most vertices have none.
WholeMeshRows make_whole_mesh_rows(const PolygonMesh& mesh, const Topology& topology, const Executor& exec);

/// A matrix with an entry for each coefficient of these rows, all 0. Vertices that do not move have the row of the
/// identity.
/// @throws ComputationError if there are 2³¹ coefficients or more.
BlockRowMatrix make_matrix(const PolygonMesh& mesh, const Topology& topology, const WholeMeshRows& rows, Reach reach,
                           const Executor& exec);

}  // namespace seamflow
