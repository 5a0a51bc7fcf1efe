#pragma once

#include <memory>

#include "engine/distributed/rank_report.h"
#include "engine/distributed/rank_setup.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/index_lists.h"
#include "solvers/interface/interface_sums.h"

namespace seamflow {

/// Measures a mesh that ranks share. Each sub-mesh adds up its faces, and the vertices at which it is the lowest; the
/// rest is added along a tree (see SumTree): the bits are the same for any number of ranks.
class RankMeter {
  public:
    /// All ranks construct it together. @param comm, mesh must outlive the meter.
    RankMeter(Communicator& comm, const RankMesh& mesh);

    /// All ranks call this together. @returns the same on all ranks.
    /// @param before, after #V by 3 of the part: two states.
    [[nodiscard]] RankMeasures measure(const Points& before, const Points& after);

  private:
    const RankMesh* mesh_;
    std::unique_ptr<InterfacePeers> peers_;
    SumTree tree_;
    bool encloses_volume_;
    /// Per known sub-mesh, those that it measures; none for foreign ones.
    IndexLists faces_;
    IndexLists vertices_;
};

}  // namespace seamflow
