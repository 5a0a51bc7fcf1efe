#include "solvers/platform/address_space.h"

#include <algorithm>
#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

namespace seamflow {

std::optional<std::size_t> limit_of_address_space()
{
    rlimit limit = {};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return {};
    return limit.rlim_cur;
}

std::size_t room_within(std::size_t limit)
{
    std::ifstream file("/proc/self/statm");
    std::size_t pages = 0;
    if (!(file >> pages))
        return 0;
    return limit - std::min(limit, pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)));
}

}  // namespace seamflow
