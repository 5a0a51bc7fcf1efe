#pragma once

#include <filesystem>

#include "samples/benchmark/methods/method.h"

namespace seamflow {

/// The argument that makes this program run one method and nothing else.
inline constexpr const char* run_method_word = "run-method";

/// Runs a task from file to file in a process of its own, a fresh start of this program: its memory is that of the
/// method alone, and no method warms up or disturbs another. Libraries that start threads of their own are limited to
/// the threads of the task. A process that fails, or is killed for its memory, gives a result with the error.
/// @param folder for the files by which the processes talk.
/// @throws OutputError if temporary files cannot be written.
MethodResult run_in_process(const std::filesystem::path& folder, const MethodTask& task);

/// The work of such a process: reads the task from the folder, runs the method, and writes its result there.
void serve_method(const std::filesystem::path& folder);

}  // namespace seamflow
