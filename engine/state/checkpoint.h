#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace seamflow {

struct FlowState;

/// Writes the state of a flow to a file and to the disk. The file holds the whole state, or stays as it was.
/// @throws OutputError naming the file.
void write_checkpoint(const std::filesystem::path& file, const FlowState& state);

/// Reads a state that write_checkpoint has written, bit for bit.
/// @throws InputError naming the file if it cannot be opened, is not such a file, comes from a version or a machine
///         with another format, is cut off, or has changed since it was written.
std::shared_ptr<const FlowState> read_checkpoint(const std::filesystem::path& file);

/// Creates a checkpoint's folder if it does not exist.
/// @throws OutputError if it cannot be created.
void make_checkpoint_folder(const std::filesystem::path& folder);

/// Checks that a checkpoint belongs to a flow, and is not beyond its end.
/// @param step after which the checkpoint was written. @param steps of the flow.
/// @param of_state, of_flow the identities of the state in the checkpoint and of the flow (see identify).
/// @throws InputError if the input or the options differ, OptionError if the checkpoint is beyond the end, naming the
///         file and a remedy.
void require_belongs(const std::filesystem::path& file, std::uint64_t of_state, std::uint64_t of_flow,
                     std::int64_t step, int steps);

}  // namespace seamflow
