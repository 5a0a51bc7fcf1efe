#pragma once

#include <functional>

#include "engine/distributed/ranks/transport.h"

namespace seamflow {

/// Runs `body` once for each of n ranks, which are threads of this process, and waits for all of them. A body that
/// throws leaves the others to themselves: use run_together within it.
/// @param n at least 1.
/// @throws what the body of the lowest rank has thrown, of those that have.
void run_on_threads(int n, const std::function<void(Transport&)>& body);

}  // namespace seamflow
