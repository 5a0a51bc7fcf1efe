#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "engine/distributed/distributed_flow.h"
#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"
#include "engine/state/flow_identity.h"

namespace seamflow {

/// A checksum of a mesh in the ranges of all ranks, which does not depend on how it is divided among them. All ranks
/// call this together. @returns the same on all ranks.
std::uint64_t checksum_of_mesh(Communicator& comm, const RankSlice& slice);

/// The same of the labels of faces.
std::uint64_t checksum_of_labels(Communicator& comm, const RankSlice& slice);

/// The state of a flow of ranks in a folder that all of them see: for each rank a file with its range, and one that
/// lists these files, with their checksums. Rank 0 replaces the list when all other files are on the disk: it is always
/// that of a complete step. All ranks call its functions together, any number of them.
class RankCheckpoint {
  public:
    /// @param identity what determines the result. Of rank 0; what others give is ignored.
    RankCheckpoint(std::filesystem::path folder, FlowIdentity identity);

    /// The list.
    [[nodiscard]] std::filesystem::path file() const;

    /// Creates the folder if necessary, and finds where the flow was.
    /// @param bounds of the ranges of vertices: #ranks + 1. @param steps of the flow.
    /// @returns this rank's share; empty if there is no list.
    /// @throws OutputError if it cannot be created; InputError and OptionError naming the file, if it is damaged or
    ///         belongs to another mesh or other options.
    std::optional<RankFlowState> find(Communicator& comm, std::span<const std::int64_t> bounds, int steps) const;

    /// Saves the state after a step, replacing the previous one.
    /// @throws OutputError
    void keep(Communicator& comm, const RankFlowState& state) const;

  private:
    [[nodiscard]] std::filesystem::path file_of(int step, std::size_t rank) const;

    std::filesystem::path folder_;
    FlowIdentity identity_;
};

}  // namespace seamflow
