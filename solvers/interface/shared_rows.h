#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "solvers/interface/interface_ranks.h"

namespace seamflow {

/// Rows of an array that several ranks know, each owned by one rank.
class SharedRows {
  public:
    /// The rows that a rank sends to another rank and receives from it. Both ranks list them in the same order.
    struct Lists {
        std::vector<Index> given;
        std::vector<Index> taken;
    };

    /// @param ranks must outlive this.
    /// @param with per other rank, by its number, the rows to send and to receive. The other rank has lists for this
    /// one.
    SharedRows(InterfaceRanks& ranks, std::map<Index, Lists> with);

    /// Fills in the rows that other ranks own; all ranks call this together.
    /// @param values `width` numbers for each row, row by row, with the own rows filled in.
    void exchange(double* values, std::size_t width);

  private:
    InterfaceRanks* ranks_;
    /// The numbers of the other ranks, ascending.
    std::vector<Index> others_;
    /// The rows to send and to receive, per other rank.
    std::vector<Lists> lists_;
};

}  // namespace seamflow
