#include "samples/report/run_record.h"

#include <algorithm>

#include "engine/options/option_names.h"
#include "engine/ranks/peak_memory.h"

namespace seamflow {

void complete_record(RunRecord& run, const FlowReport& report)
{
    run.ranks = report.ranks;
    run.names.approach = option_name(report.convergence.approach);
    run.choices_in_words = in_words_of_program(report.choices);
    run.remarks_in_words = in_words_of_program(report.remarks);
}

std::int64_t peak_memory_of(const RunRecord& run)
{
    std::int64_t most = peak_memory_bytes();
    for (const RankRecord& rank : run.ranks)
        most = std::max(most, rank.peak_memory_bytes);
    return most;
}

}  // namespace seamflow
