#include "engine/parallel_loop.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace seamflow {

namespace tbb = oneapi::tbb;

void run_in_parallel(Index n, const LoopBody& body)
{
    tbb::parallel_for(tbb::blocked_range<Index>(0, n),
                      [&](const tbb::blocked_range<Index>& range) { body(range.begin(), range.end()); });
}

}  // namespace seamflow
