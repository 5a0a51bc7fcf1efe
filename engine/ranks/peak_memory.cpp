#include "engine/ranks/peak_memory.h"

#include <sys/resource.h>

namespace seamflow {

std::int64_t peak_memory_bytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::int64_t{usage.ru_maxrss} * 1024;  // Linux counts KiB
}

}  // namespace seamflow
