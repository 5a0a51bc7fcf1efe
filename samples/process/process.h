#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace seamflow {

/// The outcome of a process.
struct ProcessEnd {
    /// Why it did not succeed; empty: it did.
    std::string failure;
    /// Wall-clock time from its start to its end.
    double seconds = 0.0;
    /// Its peak memory.
    std::size_t peak_memory_bytes = 0;
};

/// Runs a program, discards its output, and waits for it. Libraries that start threads of their own are limited to this
/// number of them.
/// @param words its arguments, its name first.
ProcessEnd run_process(const std::string& program, std::vector<std::string> words, int threads);

}  // namespace seamflow
