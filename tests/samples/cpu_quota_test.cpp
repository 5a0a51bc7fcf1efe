#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "samples/process/cpu_quota.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

/// The quota where there are these files.
std::optional<int> quota_with(const std::vector<std::pair<std::string, std::string>>& files)
{
    const test::TemporaryDirectory root;
    for (const auto& [name, content] : files) {
        std::filesystem::create_directories((root / name).parent_path());
        static_cast<void>(root.with(name, content));
    }
    return cpu_quota(root.path());
}

}  // namespace

TEST_CASE("the quota of a control group, or of one around it, in processors, rounded up")
{
    const std::string self = "proc/self/cgroup";
    CHECK_FALSE(quota_with({}));
    CHECK_FALSE(quota_with({{self, "0::/\n"}, {"sys/fs/cgroup/cpu.max", "max 100000\n"}}));
    CHECK(quota_with({{self, "0::/\n"}, {"sys/fs/cgroup/cpu.max", "150000 100000\n"}}) == 2);
    CHECK(quota_with({{self, "0::/a/b\n"},
                      {"sys/fs/cgroup/a/cpu.max", "300000 100000\n"},
                      {"sys/fs/cgroup/a/b/cpu.max", "max 100000\n"}}) == 3);
    CHECK(quota_with({{self, "0::/a/b\n"},
                      {"sys/fs/cgroup/a/cpu.max", "300000 100000\n"},
                      {"sys/fs/cgroup/a/b/cpu.max", "50000 100000\n"}}) == 1);
    // The path outside, while the own group is mounted.
    CHECK(quota_with({{self, "0::/docker/1234\n"}, {"sys/fs/cgroup/cpu.max", "200000 100000\n"}}) == 2);
}

TEST_CASE("the quota of control groups of the first version")
{
    const std::string self = "proc/self/cgroup";
    const std::string groups = "5:memory:/x\n4:cpu,cpuacct:/x\n";
    CHECK_FALSE(quota_with({{self, groups},
                            {"sys/fs/cgroup/cpu/x/cpu.cfs_quota_us", "-1\n"},
                            {"sys/fs/cgroup/cpu/x/cpu.cfs_period_us", "100000\n"}}));
    CHECK(quota_with({{self, groups},
                      {"sys/fs/cgroup/cpu/x/cpu.cfs_quota_us", "400000\n"},
                      {"sys/fs/cgroup/cpu/x/cpu.cfs_period_us", "100000\n"}}) == 4);
    CHECK_FALSE(quota_with({{self, "5:memory:/x\n3:cpuset:/x\n"},
                            {"sys/fs/cgroup/cpu/x/cpu.cfs_quota_us", "400000\n"},
                            {"sys/fs/cgroup/cpu/x/cpu.cfs_period_us", "100000\n"}}));
}
