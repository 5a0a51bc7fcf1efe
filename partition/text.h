#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Small texts: of messages and names.
namespace seamflow {

/// A count and the word for the counted things: "1 vertex", "3 vertices".
std::string counted(std::uint64_t count, const std::string& singular, const std::string& plural);

/// The text with a to z in place of A to Z.
std::string lower_case(std::string_view text);

/// Appends `what` unless the list contains it.
void add_once(std::vector<std::string>& list, std::string_view what);

}  // namespace seamflow
