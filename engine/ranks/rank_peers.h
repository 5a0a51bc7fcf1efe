#pragma once

#include <span>
#include <vector>

#include "engine/ranks/communicator.h"
#include "solvers/interface/interface_peers.h"

namespace seamflow {

/// Ranks that solve an equation on Γ together.
class RankPeers final : public InterfacePeers {
  public:
    /// @param comm must outlive this; nobody else uses its collective functions while the equation is solved.
    /// @param holders, places see InterfacePeers: sub-meshes of all ranks, and those that this one knows.
    RankPeers(Communicator& comm, std::vector<Index> holders, std::vector<Index> places);

    Numbers gather(const std::vector<double>& own) override;
    Numbers exchange(std::span<const Index> others, const Numbers& to_each) override;

  private:
    Communicator* comm_;
};

}  // namespace seamflow
