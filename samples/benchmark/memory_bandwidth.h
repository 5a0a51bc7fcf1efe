#pragma once

namespace seamflow {

/// The bandwidth of memory as STREAM's triad measures it (McCalpin 1995): a = b + s c for long vectors, 24 bytes for
/// each entry, the best of several runs. In bytes per second.
/// @param threads their number, at least 1. Each has a range of the vectors of its own.
/// @throws ComputationError if they cannot be started.
double triad_bandwidth(int threads);

}  // namespace seamflow
