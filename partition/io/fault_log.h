#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace seamflow {

/// What was wrong in a file that was read as far as possible.
struct FaultLog {
    static constexpr std::size_t most_messages = 1000;
    /// The first ones, in the order of the file, as InputError would have said them.
    std::vector<std::string> messages;
    /// All of them.
    std::uint64_t count = 0;

    void add(std::string message)
    {
        ++count;
        if (messages.size() < most_messages)
            messages.push_back(std::move(message));
    }
};

}  // namespace seamflow
