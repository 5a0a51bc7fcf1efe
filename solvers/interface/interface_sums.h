#pragma once

#include <initializer_list>
#include <vector>

#include "solvers/interface/interface_copies.h"
#include "solvers/interface/interface_peers.h"
#include "solvers/krylov/conjugate_gradients.h"

namespace seamflow {

/// Adds up one row per sub-mesh along a binary tree of their places: 0 and 1, 2 and 3 and so on, then the sums of two
/// such pairs, and so on. So the order of additions depends only on the number of sub-meshes, whoever has them. Peers
/// compute the sums all of whose terms they have, most of them if their sub-meshes are consecutive, and exchange the
/// rest.
class SumTree {
  public:
    /// @param peers must outlive the tree.
    explicit SumTree(InterfacePeers& peers);

    /// All peers call this together.
    /// @param rows #places times `width` numbers, one row after the other, those of this peer's sub-meshes filled in.
    ///        Overwritten.
    /// @returns the sums: `width` numbers.
    std::vector<double> add_up(std::vector<double>& rows, std::size_t width);

  private:
    struct Addition {
        Index to;
        Index from;
    };
    static void add(const std::vector<Addition>& additions, std::vector<double>& rows, std::size_t width);

    InterfacePeers* peers_;
    /// Those whose terms this peer has; those that come after.
    std::vector<Addition> own_;
    std::vector<Addition> last_;
    /// Per peer, the rows whose sums it sends to others.
    std::vector<std::vector<Index>> sent_rows_;
};

/// The inner products of vectors with one row per vertex of Γ: each sub-mesh adds up the vertices of which it has the
/// first copy, in their order; the rest is done by a SumTree.
class InterfaceSums {
  public:
    /// @param copies, peers must outlive this.
    InterfaceSums(const InterfaceCopies& copies, InterfacePeers& peers);

    /// See InnerProducts; all peers call this together.
    std::vector<Point> products(std::initializer_list<VectorPair> pairs, const Executor& exec);

  private:
    const InterfaceCopies* copies_;
    const InterfacePeers* peers_;
    SumTree tree_;
    std::vector<double> rows_;
};

}  // namespace seamflow
