#pragma once

#include <functional>

#include "partition/executor.h"

namespace seamflow {

/// A loop of the lower layers on the threads of the arena that it is called in (see Executor).
void run_in_parallel(Index n, const RangeBody& body);

/// Two pieces of work, at the same time where there are threads for both.
void run_both(const std::function<void()>& one, const std::function<void()>& other);

}  // namespace seamflow
