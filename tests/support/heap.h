#pragma once

#include "solvers/direct/factor_memory.h"

namespace seamflow::test {

/// Memory for factors from the heap.
inline FactorMemory& heap()
{
    return *std::pmr::new_delete_resource();
}

}  // namespace seamflow::test
