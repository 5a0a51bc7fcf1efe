#pragma once

#include <cstdint>

namespace seamflow {

/// How often this process has touched a page of memory, small or large, that the system had to provide first.
std::int64_t page_faults();

}  // namespace seamflow
