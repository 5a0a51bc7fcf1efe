#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/distributed/distributed_flow.h"
#include "engine/distributed/parts/deal.h"
#include "engine/distributed/parts/slice_measures.h"
#include "engine/distributed/rank_checkpoint.h"
#include "engine/tasks/stopwatch.h"
#include "samples/command/smooth_command.h"

namespace seamflow {

/// The inputs of a run of ranks that decide the result, besides the options.
struct RankRunInputs {
    SharedMeshSize size;
    /// Checksum of the mesh (see checksum_of_mesh).
    std::uint64_t mesh = 0;
    /// Of the whole mesh, ascending; on all ranks.
    std::vector<std::int64_t> fixed;
    /// See read_weights; at rank 0.
    std::vector<double> weights;
    /// See read_strengths; at rank 0.
    std::vector<double> strengths;
};

/// The checkpoints of a run of `smooth-distributed`. All ranks call its functions together.
class RankCheckpoints {
  public:
    /// @param slice with the labels of the cut.
    RankCheckpoints(Communicator& comm, const SmoothCommand& command, const RankRunInputs& inputs,
                    const RankSlice& slice);

    /// Finds an earlier run, if there was one.
    /// @param bounds of the ranges of vertices.
    /// @throws what RankCheckpoint::find throws.
    std::optional<RankFlowState> find(Communicator& comm, std::span<const std::int64_t> bounds) const;

    [[nodiscard]] std::filesystem::path file() const { return checkpoint_.file(); }

    /// Keeps the state after a step where the period or the end of the run asks for it.
    /// @param vertices of this rank's range, as in RankStepState::capture.
    void keep(const RankStepState& state, const Points& vertices);

  private:
    CheckpointPeriod period_;
    int steps_;
    RankCheckpoint checkpoint_;
    Stopwatch since_kept_;
};

}  // namespace seamflow
