#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "partition/index.h"

namespace seamflow {

/// What the whole numbers in a text file are called in messages.
struct IndexLineWords {
    /// "a label".
    const char* name;
    /// What to do where something else stands there.
    const char* remedy;
    /// What to do about a negative one.
    const char* negative;
};

/// "path:line: ", with which messages about a line begin.
std::string place_of_line(const std::filesystem::path& path, std::size_t line);

/// Reads a text file with one whole number of at least 0 a line. Blank lines and whatever follows a # are skipped.
/// @param take called with each number and its line, counted from 1, in order.
/// @returns the number of lines.
/// @throws InputError "path:line: …" if the file cannot be read or a line holds something else.
std::size_t read_index_lines(const std::filesystem::path& path, const IndexLineWords& words,
                             const std::function<void(Index value, std::size_t line)>& take);

}  // namespace seamflow
