#pragma once

#include <functional>

#include "engine/ranks/transport.h"

namespace seamflow {

/// Runs `body` once for each of n ranks, which are threads of this process, and waits for all of them. A body that
/// throws does not end the others: use a RankGroup and serve_flows within it.
/// @param n at least 1.
/// @throws the exception of the lowest rank whose body has thrown.
void run_on_threads(int n, const std::function<void(Transport&)>& body);

}  // namespace seamflow
