#pragma once

#include <cstddef>
#include <optional>

namespace seamflow {

/// The limit of the address space of this process (ulimit -v), in bytes; empty if unlimited.
std::optional<std::size_t> limit_of_address_space();

/// How much of it is left, in bytes; 0 if unknown.
std::size_t room_within(std::size_t limit);

}  // namespace seamflow
