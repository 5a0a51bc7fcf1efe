#pragma once

#include <cstdint>

namespace seamflow {

/// The largest amount of memory that this process has used so far (its peak resident set), in bytes.
std::int64_t peak_memory_bytes();

}  // namespace seamflow
