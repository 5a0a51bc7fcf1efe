#pragma once

#include <filesystem>

#include "samples/benchmark/methods/method.h"

namespace seamflow {

/// The word by which this program is told to run one method and nothing else.
inline constexpr const char* run_method_word = "run-method";

/// Runs a task in a process of its own, a fresh start of this program: its memory is that of the method alone, and
/// nothing of one method warms or disturbs another. Libraries that start threads of their own are held to the threads
/// of the task. A process that fails, or is killed for its memory, gives a result that says so.
/// @param folder holds the mesh (see write_mesh_for_methods).
/// @throws OutputError if temporary files cannot be written.
MethodResult run_in_process(const std::filesystem::path& folder, const MethodTask& task);

/// What such a process does: reads mesh and task from the folder, runs the method, and leaves its result there.
void serve_method(const std::filesystem::path& folder);

}  // namespace seamflow
