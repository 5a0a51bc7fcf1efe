#pragma once

#include <initializer_list>
#include <vector>

#include "solvers/interface/interface_copies.h"
#include "solvers/krylov/sums.h"

namespace seamflow {

/// Adds up one row per sub-mesh along a binary tree of their numbers: 0 and 1, 2 and 3 and so on, then the sums of two
/// such pairs, and so on. So the order of additions depends on the number of sub-meshes alone, and whoever has some
/// sub-meshes that follow each other can add up most of theirs.
/// @param rows #sub-meshes times `width` numbers, one row after the other; those of the first row become the sums.
void add_along_tree(std::vector<double>& rows, std::size_t width);

/// The inner products of vectors with one row per vertex of Γ: each sub-mesh adds up the vertices of which it has the
/// first copy, in their order; the rest is done by add_along_tree.
class InterfaceSums {
  public:
    /// @param copies must outlive this.
    explicit InterfaceSums(const InterfaceCopies& copies);

    /// See InnerProducts.
    std::vector<Point> products(std::initializer_list<VectorPair> pairs, const Loop& loop);

  private:
    const InterfaceCopies* copies_;
    std::vector<double> rows_;
};

}  // namespace seamflow
