#include "samples/report/run_record.h"

#include <algorithm>

#include "samples/process/peak_memory.h"

namespace seamflow {

std::int64_t peak_memory_of(const RunRecord& run)
{
    if (run.ranks.empty())
        return peak_memory_bytes();
    return std::ranges::max(run.ranks, {}, &RankRecord::peak_memory_bytes).peak_memory_bytes;
}

}  // namespace seamflow
