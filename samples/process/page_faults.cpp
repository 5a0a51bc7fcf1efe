#include "samples/process/page_faults.h"

#include <sys/resource.h>

namespace seamflow {

std::int64_t page_faults()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::int64_t{usage.ru_minflt} + usage.ru_majflt;
}

}  // namespace seamflow
