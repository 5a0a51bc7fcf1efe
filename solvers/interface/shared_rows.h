#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "solvers/interface/interface_peers.h"

namespace seamflow {

/// Rows of an array that several peers know, each owned by one peer.
class SharedRows {
  public:
    /// The rows that a peer gives to another one and takes from it. Both sides have the same order.
    struct Lists {
        std::vector<Index> given;
        std::vector<Index> taken;
    };

    /// @param peers must outlive this. @param with by the number of the other peer, which has lists for this one, too.
    SharedRows(InterfacePeers& peers, std::map<Index, Lists> with);

    /// Fills in the rows of others; all peers call this together.
    /// @param values `width` numbers for each row, one row after the other, the own ones filled in.
    void exchange(double* values, std::size_t width);

  private:
    InterfacePeers* peers_;
    std::vector<Index> others_;
    /// Per other peer.
    std::vector<Lists> lists_;
};

}  // namespace seamflow
