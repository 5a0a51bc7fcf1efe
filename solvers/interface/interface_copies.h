#pragma once

#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/index_lists.h"
#include "solvers/interface/interface_ranks.h"
#include "solvers/interface/shared_rows.h"

namespace seamflow {

/// The vertices of Γ and their copies in the sub-meshes. Copies are numbered sub-mesh by sub-mesh, in the order of the
/// vertices of the sub-mesh's own Γ. Of a sub-mesh that is not present as a whole (see decompose_part), only the copies
/// that it shares with whole sub-meshes are listed.
struct InterfaceCopies {
    /// @param decomposition without overlap.
    explicit InterfaceCopies(const Decomposition& decomposition);

    [[nodiscard]] Index n_vertices() const { return of_vertex.size(); }
    [[nodiscard]] Index n_copies() const { return offsets.back(); }
    [[nodiscard]] Index n_sub_meshes() const { return static_cast<Index>(offsets.size()) - 1; }

    /// The number of copies in sub-mesh s.
    [[nodiscard]] Index n_in(Index s) const { return offsets[s + 1] - offsets[s]; }

    /// #sub-meshes + 1: the copies of sub-mesh s are numbered from offsets[s] up to offsets[s + 1].
    std::vector<Index> offsets{0};
    /// #sub-meshes + 1: the vertices whose lowest copy is in sub-mesh s are numbered from first_vertex[s] up to
    /// first_vertex[s + 1].
    std::vector<Index> first_vertex{0};
    /// Per copy: its vertex of Γ, and its sub-mesh.
    std::vector<Index> vertex;
    std::vector<Index> sub_mesh;
    /// Per vertex of Γ: its copies, in ascending order of the sub-meshes.
    IndexLists of_vertex;
};

/// The exchange of rows of copies between ranks. Afterwards, every rank with a copy of a vertex has the rows of all
/// copies of this vertex.
/// @param ranks must outlive the result.
SharedRows shared_copies(const InterfaceCopies& copies, InterfaceRanks& ranks);

}  // namespace seamflow
