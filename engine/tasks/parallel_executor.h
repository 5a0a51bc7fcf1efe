#pragma once

#include <functional>

#include "partition/executor.h"

namespace seamflow {

/// Runs a loop of the lower layers on the threads of the calling arena (see Executor).
void run_in_parallel(Index n, const RangeBody& body);

/// The number of threads of the calling arena.
int n_threads_of_arena();

/// Runs two pieces of work, in parallel if there are threads for both.
void run_both(const std::function<void()>& one, const std::function<void()>& other);

}  // namespace seamflow
