#pragma once

#include <initializer_list>
#include <vector>

#include "solvers/interface/interface_copies.h"
#include "solvers/interface/interface_ranks.h"
#include "solvers/krylov/conjugate_gradients.h"

namespace seamflow {

/// Adds up one row per sub-mesh along a binary tree of their global numbers: rows 0 and 1, 2 and 3 and so on, then the
/// sums of two such pairs, and so on. The order of additions depends only on the number of sub-meshes, and not on the
/// ranks that own them. A rank computes each sum all of whose terms it has, which are most if its sub-meshes are
/// consecutive; sums of other terms are exchanged.
class SumTree {
  public:
    /// @param ranks must outlive the tree.
    explicit SumTree(InterfaceRanks& ranks);

    /// Adds up; all ranks call this together.
    /// @param rows n_sub_meshes() times `width` numbers, row by row, with the rows of this rank's sub-meshes filled in.
    ///        Overwritten.
    /// @returns the sums: `width` numbers.
    std::vector<double> add_up(std::vector<double>& rows, std::size_t width);

  private:
    /// Row `from` is added to row `to`.
    struct Addition {
        Index to;
        Index from;
    };
    static void add(const std::vector<Addition>& additions, std::vector<double>& rows, std::size_t width);

    InterfaceRanks* ranks_;
    /// The additions all of whose terms this rank has; then the additions that follow the exchange.
    std::vector<Addition> own_;
    std::vector<Addition> last_;
    /// Per rank, the rows whose sums it sends to the others.
    std::vector<std::vector<Index>> sent_rows_;
};

/// The inner products of vectors with one row per vertex of Γ: each sub-mesh adds up the vertices whose first copy it
/// has, in their order; a SumTree adds up the sums of the sub-meshes.
class InterfaceSums {
  public:
    /// @param copies, ranks must outlive this.
    InterfaceSums(const InterfaceCopies& copies, InterfaceRanks& ranks);

    /// The inner products of pairs of vectors (see InnerProducts); all ranks call this together.
    std::vector<Point> products(std::initializer_list<VectorPair> pairs, const Executor& exec);

  private:
    const InterfaceCopies* copies_;
    const InterfaceRanks* ranks_;
    SumTree tree_;
    /// Per sub-mesh of all ranks: its sums.
    std::vector<double> rows_;
};

}  // namespace seamflow
