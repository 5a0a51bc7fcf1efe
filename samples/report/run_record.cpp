#include "samples/report/run_record.h"

#include <algorithm>

#include "engine/ranks/peak_memory.h"

namespace seamflow {

std::int64_t peak_memory_of(const RunRecord& run)
{
    std::int64_t most = peak_memory_bytes();
    for (const RankRecord& rank : run.ranks)
        most = std::max(most, rank.peak_memory_bytes);
    return most;
}

}  // namespace seamflow
