#pragma once

#include "partition/executor.h"

namespace seamflow::test {

/// Ranges of one index, the last one first.
inline void run_backwards(Index n, const RangeBody& body)
{
    for (Index i = n; i-- > 0;)
        body(i, i + 1);
}

}  // namespace seamflow::test
