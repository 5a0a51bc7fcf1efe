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
    /// Whether only faults of a face or a row that leave no doubt about the rest are noted, and others thrown.
    bool of_faces_alone = false;
    static constexpr std::size_t most_messages = 1000;
    /// The first ones, in the order of the file, as InputError would report them.
    std::vector<std::string> messages = {};
    /// All of them.
    std::uint64_t count = 0;
    /// Those of them that are noted even where only faults of faces and rows are.
    std::uint64_t n_harmless = 0;
    /// Ascending: the numbers, from 0 in the file, of faces that were left out because they had fewer than three
    /// corners or one of them twice.
    std::vector<Index> faces_left_out = {};

    void add(std::string message)
    {
        ++count;
        if (messages.size() < most_messages)
            messages.push_back(std::move(message));
    }
};

}  // namespace seamflow
