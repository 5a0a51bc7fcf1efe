#pragma once

#include "partition/loop.h"

namespace seamflow {

/// A loop of the lower layers on the threads of the arena that it is called in (see Loop).
void run_in_parallel(Index n, const LoopBody& body);

}  // namespace seamflow
