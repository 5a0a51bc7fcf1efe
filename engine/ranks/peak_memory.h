#pragma once

#include <cstdint>

namespace seamflow {

/// The most memory that this process has held until now (its peak resident set), in bytes.
std::int64_t peak_memory_bytes();

}  // namespace seamflow
