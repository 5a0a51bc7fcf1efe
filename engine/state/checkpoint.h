#pragma once

#include <filesystem>

#include "engine/state/flow_state.h"

namespace seamflow {

/// Writes the state of a flow to a file and to the disk. The file holds the whole state, or stays as it was.
/// @throws OutputError naming the file.
void write_checkpoint(const std::filesystem::path& file, const FlowState& state);

/// Reads it back, bit for bit.
/// @throws InputError naming the file if it cannot be opened, is none of these files, comes from a version or a machine
///         that writes others, is cut off, or has changed since it was written.
FlowState read_checkpoint(const std::filesystem::path& file);

}  // namespace seamflow
