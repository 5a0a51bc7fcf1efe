#pragma once

#include <span>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Data from one sub-mesh to another: the rows `source` of the sender's positions become the rows `target` of the
/// receiver's positions. Both are lists of local indices, of the same length.
struct Transfer {
    Index from = -1;
    Index to = -1;
    std::vector<Index> source;
    std::vector<Index> target;
};

/// One row of a transfer, see Transfer.
struct TransferRow {
    Index from;
    Index source;
    Index target;
};

/// The transfers to sub-mesh `to`: one from each sender, in ascending order of senders. Rows of the same sender keep
/// their order.
std::vector<Transfer> transfers_to(Index to, std::vector<TransferRow> rows);

/// A mesh cut into sub-meshes, and the data that sub-meshes exchange between two steps.
struct Decomposition {
    std::vector<SubMesh> sub_meshes;
    /// For each sub-mesh: the sub-meshes with which it shares a vertex of Γ, in ascending order.
    std::vector<std::vector<Index>> adjacency;
    /// For each sub-mesh: the transfers into its halo: of Vᵏ, the positions after k steps, before step k + 1, and of
    /// Vᵏ⁺¹ before the correction of Γ. Senders are adjacent to the receiver, in ascending order.
    std::vector<std::vector<Transfer>> halo;
    /// Number of vertices on Γ, each counted once.
    Index n_interface_vertices = 0;
};

/// The faces of every sub-mesh, in ascending order.
/// @param labels #F, each in 0 to n_parts - 1.
std::vector<std::vector<Index>> faces_by_label(std::span<const Index> labels, Index n_parts,
                                               const Executor& exec = run_serially);

/// The sub-mesh of every face: inverse of faces_by_label. @param n_faces of the mesh, each in one sub-mesh.
std::vector<Index> labels_by_face(const Decomposition& decomposition, Index n_faces);

/// Joins sub-meshes made by make_sub_mesh: sets the sharing of Γ and the halo transfers.
Decomposition connect(std::vector<SubMesh> sub_meshes, const Topology& topology, std::span<const Index> labels,
                      const Executor& exec = run_serially);

/// Cuts a mesh into its sub-meshes.
/// @param labels #F, each in 0 to n_parts - 1, every value used; each part connected and with one fan of faces around
///        each of its vertices, except at junctions (see cut_into and cut_by_labels).
Decomposition decompose(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, Index n_parts,
                        const Executor& exec = run_serially);

}  // namespace seamflow
