#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace seamflow {

/// How a process went.
struct ProcessEnd {
    /// Why it did not succeed; empty: it did.
    std::string failure;
    /// Wall-clock time from its start to its end.
    double seconds = 0.0;
    /// The most memory that it had.
    std::size_t peak_memory_bytes = 0;
};

/// Runs a program, whatever it prints unread, and waits for it. Libraries that start threads of their own are held to
/// this number of them.
/// @param words its arguments, its name first.
ProcessEnd run_process(const std::string& program, std::vector<std::string> words, int threads);

}  // namespace seamflow
