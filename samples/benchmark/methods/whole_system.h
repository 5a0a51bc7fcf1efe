#pragma once

#include <memory>
#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/direct/columns.h"
#include "solvers/laplacian/laplacian_assembler.h"

namespace seamflow {

/// The equations of one backward Euler step on the whole mesh, (M + dt K) Vᵏ⁺¹ = M Vᵏ, vertices that stay moved to the
/// right-hand side: symmetric positive definite. A fixed pattern, and values that are filled in anew for each step, by
/// the arithmetic that sub-meshes use, in one thread.
class WholeSystem {
  public:
    /// @param mesh, topology must outlive the system.
    /// @param laplacian symmetric.
    /// @throws ComputationError if there are 2³¹ or more entries.
    WholeSystem(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian);

    /// Fills matrix and right-hand side.
    /// @param positions #V by 3: Vᵏ.
    /// @param time_step dt, in length².
    void assemble(const Points& positions, double time_step);

    /// Number of unknowns n.
    [[nodiscard]] Index n() const { return pattern_.n(); }
    /// Vertex of each unknown, ascending.
    [[nodiscard]] const std::vector<Index>& vertices() const { return vertices_; }
    [[nodiscard]] const SparsePattern& pattern() const { return pattern_; }
    /// One per entry of the pattern. By rows the matrix is the same.
    [[nodiscard]] std::span<const double> values() const;
    /// n by 3.
    [[nodiscard]] const Columns& right_hand_side() const { return right_hand_side_; }

    /// The unknowns at given positions, n by 3.
    [[nodiscard]] Columns unknowns_at(const Points& positions) const;
    /// Moves the vertices that may move to the positions in a solution, n by 3.
    void move(const Columns& solution, Points& positions) const;

  private:
    /// A vertex that stays, in the row of an unknown.
    struct Coupling {
        Index row;
        Index fixed_vertex;
    };

    void make_slots(const std::vector<MatrixEntry>& entries, const std::vector<Index>& unknown_of);
    void make_symmetric(const Points& positions);

    const Topology* topology_;
    std::unique_ptr<LaplacianAssembler> assembler_;
    std::vector<Index> vertices_;
    SparsePattern pattern_;
    /// The slots of the Laplacian's contributions: in the pattern, after it in the couplings, or, one past those, in
    /// one that is never read.
    std::vector<Index> slots_;
    std::vector<Index> diagonal_slots_;
    std::vector<Coupling> couplings_;
    std::vector<double> values_;
    /// Per unknown: M_v.
    std::vector<double> row_factor_;
    Columns right_hand_side_;
};

}  // namespace seamflow
