#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// The faults of a file that was read as far as possible.
struct FaultLog {
    /// Whether only faults of single faces or rows are collected after which the rest of the file is still certain to
    /// be read correctly; all other faults are then thrown. Otherwise all faults are collected.
    bool of_faces_alone = false;
    static constexpr std::size_t most_messages = 1000;
    /// The messages of the first faults, in the order of the file, as those of InputError.
    std::vector<std::string> messages = {};
    /// The number of all faults.
    std::uint64_t count = 0;
    /// The number of those faults that are collected even with of_faces_alone.
    std::uint64_t n_harmless = 0;
    /// The faces that were left out because they had fewer than three corners or one of them twice: their numbers in
    /// the file, from 0, ascending; triangles without area that join strips are not counted.
    std::vector<Index> faces_left_out = {};

    void add(std::string message)
    {
        ++count;
        if (messages.size() < most_messages)
            messages.push_back(std::move(message));
    }
};

}  // namespace seamflow
