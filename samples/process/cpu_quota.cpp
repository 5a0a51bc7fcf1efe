#include "samples/process/cpu_quota.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <thread>

#include <fmt/format.h>

namespace seamflow {

namespace {

namespace fs = std::filesystem;

/// For one group: microseconds of each period. Not positive, or not a number: no limit.
std::optional<double> quota_of(const fs::path& group)
{
    double quota = 0.0;
    double period = 0.0;
    // Version 2 has both in a line, and the word max if there is no limit.
    std::ifstream both(group / "cpu.max");
    if (!(both >> quota >> period)) {
        std::ifstream first(group / "cpu.cfs_quota_us");
        std::ifstream second(group / "cpu.cfs_period_us");
        if (!(first >> quota) || !(second >> period))
            return std::nullopt;
    }
    return quota > 0.0 && period > 0.0 ? std::optional(quota / period) : std::nullopt;
}

}  // namespace

std::optional<int> cpu_quota(const fs::path& root)
{
    std::optional<double> least;
    std::ifstream groups(root / "proc/self/cgroup");
    // Numbers, controllers and path, between colons. Those of version 2 have no controllers.
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (second == std::string::npos)
            continue;
        const std::string controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1));
        const bool is_unified = controllers == ",,";
        if (!is_unified && controllers.find(",cpu,") == std::string::npos)
            continue;
        const fs::path mounted = root / "sys/fs/cgroup" / (is_unified ? "" : "cpu");
        // The limits of all enclosing groups apply. In a container, the path may be that outside.
        for (fs::path group = fs::path(line.substr(second + 1)).relative_path();; group = group.parent_path()) {
            if (const std::optional<double> quota = quota_of(mounted / group))
                least = std::min(least.value_or(*quota), *quota);
            if (group.empty())
                break;
        }
    }
    return least ? std::optional(static_cast<int>(std::ceil(std::min(*least, 1e6)))) : std::nullopt;
}

int threads_within_quota()
{
    const std::optional<int> quota = cpu_quota();
    return quota && *quota < static_cast<int>(std::thread::hardware_concurrency()) ? *quota : 0;
}

}  // namespace seamflow
