#pragma once

#include <functional>

#include "partition/executor.h"

namespace seamflow {

/// The Executor that the engine hands to functions of partition/ and solvers/: runs the body over ranges of 0 to n - 1
/// on the threads of the task arena of oneTBB in which it is called.
void run_in_parallel(Index n, const RangeBody& body);

/// The number of threads of the calling arena.
int n_threads_of_arena();

/// Runs two pieces of work, in parallel if there are threads for both.
void run_both(const std::function<void()>& one, const std::function<void()>& other);

}  // namespace seamflow
