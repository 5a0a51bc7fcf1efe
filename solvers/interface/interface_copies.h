#pragma once

#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/index_lists.h"
#include "solvers/interface/interface_peers.h"
#include "solvers/interface/shared_rows.h"

namespace seamflow {

/// The vertices of Γ and their copies in the sub-meshes, sub-mesh by sub-mesh, each in the order of its own Γ. A
/// sub-mesh that is not present as a whole (see decompose_part) has those copies that whole ones share.
struct InterfaceCopies {
    /// @param decomposition without overlap.
    explicit InterfaceCopies(const Decomposition& decomposition);

    [[nodiscard]] Index n_vertices() const { return of_vertex.size(); }
    [[nodiscard]] Index n_copies() const { return first.back(); }
    [[nodiscard]] Index n_sub_meshes() const { return static_cast<Index>(first.size()) - 1; }

    /// How many copies sub-mesh s has.
    [[nodiscard]] Index n_in(Index s) const { return first[s + 1] - first[s]; }

    /// Per sub-mesh its first copy, and one more.
    std::vector<Index> first{0};
    /// Per sub-mesh the first of the vertices whose first copy it has, and one more: they are consecutive.
    std::vector<Index> first_vertex{0};
    /// Per copy.
    std::vector<Index> vertex;
    std::vector<Index> sub_mesh;
    /// Per vertex of Γ its copies, in ascending order of the sub-meshes.
    IndexLists of_vertex;
};

/// Exchange of copies between peers: of every vertex that two of them have, both know all copies.
/// @param peers must outlive the result.
SharedRows shared_copies(const InterfaceCopies& copies, InterfacePeers& peers);

}  // namespace seamflow
