#pragma once

#include <span>
#include <vector>

#include "engine/ranks/communicator.h"
#include "solvers/interface/interface_ranks.h"

namespace seamflow {

/// The ranks of a Communicator, solving an equation on Γ together.
class CommunicatorRanks final : public InterfaceRanks {
  public:
    /// @param comm must outlive this; nothing else may use its collective functions while the equation is solved.
    /// @param holders the rank of each sub-mesh of all ranks. @param global_numbers the numbers of the sub-meshes that
    /// this rank knows, ascending.
    CommunicatorRanks(Communicator& comm, std::vector<Index> holders, std::vector<Index> global_numbers);

    Numbers gather(const std::vector<double>& own) override;
    Numbers exchange(std::span<const Index> others, const Numbers& to_each) override;

  private:
    Communicator* comm_;
};

}  // namespace seamflow
