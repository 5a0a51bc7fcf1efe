#pragma once

#include <memory>
#include <span>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "partition/topology.h"
#include "solvers/laplacian/laplacian_assembler.h"

namespace seamflow {

/// The rows of the whole mesh's Laplacian at the vertices of a sub-mesh's Γ, assembled from the faces on both sides of
/// it.
class StarLaplacian {
  public:
    /// @param sub_mesh needed only during construction.
    /// @param laplacian one that reaches no further than the faces of a vertex (see Reach).
    /// @param stiffness_at #local by 3, the halo included: positions whose stiffness matrix K is kept; nullptr: K
    /// follows the mesh.
    StarLaplacian(const SubMesh& sub_mesh, const ScaledLaplacian& laplacian, const Points* stiffness_at = nullptr);

    /// The vertices (local, the halo included) on which each row depends, ascending; one list per vertex of Γ.
    [[nodiscard]] const IndexLists& columns() const { return columns_; }

    /// Assembles all rows anew.
    /// @param positions #local by 3, the halo included.
    void assemble(const Points& positions);

    /// The coefficients of row i, one per entry of columns()[i], in 1/length².
    [[nodiscard]] std::span<const double> row(Index i) const
    {
        return std::span<const double>(values_).subspan(columns_.offsets[i], columns_[i].size());
    }

  private:
    /// Fills columns_ and slots_ from the entries of the assembler.
    void make_slots(const SubMeshInterface& interface);

    /// The faces that touch Γ, with local vertices.
    PolygonMesh faces_;
    Topology topology_;
    std::unique_ptr<LaplacianAssembler> assembler_;
    IndexLists columns_;
    /// Per entry of the assembler: the index in values_ to which its coefficient is added.
    std::vector<Index> slots_;
    /// One value per entry of columns_, and a last one that is never read: it collects the entries of rows off Γ.
    std::vector<double> values_;
};

}  // namespace seamflow
