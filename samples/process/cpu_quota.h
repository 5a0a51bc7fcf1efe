#pragma once

#include <filesystem>
#include <optional>

namespace seamflow {

/// The number of processors that the control groups of this process (cgroups of Linux, in both versions) allow it on
/// average, rounded up: a container that may use two of 64 processors is slower with 64 threads than with two. Empty:
/// there is no such limit.
/// @param root where the file system of the processes and that of the groups are mounted.
std::optional<int> cpu_quota(const std::filesystem::path& root = "/");

/// The number of threads to request if the user gives none: the quota if it is below the number of processors, else 0.
int threads_within_quota();

}  // namespace seamflow
