#include "samples/common/label_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "partition/errors.h"
#include "samples/common/command_line.h"

namespace seamflow {

namespace {

std::string_view trimmed(std::string_view line)
{
    constexpr std::string_view space = " \t\r";
    const auto begin = line.find_first_not_of(space);
    return begin == line.npos ? std::string_view() : line.substr(begin, line.find_last_not_of(space) - begin + 1);
}

Index parse_label(std::string_view text, const std::string& place)
{
    try {
        return static_cast<Index>(parse_integer(text, 0, std::numeric_limits<Index>::max()));
    } catch (const OptionError& error) {
        throw InputError(place + ": " + error.what() + "; each line gives the sub-mesh of one face");
    }
}

/// One label a line, up to the empty lines at the end.
std::vector<Index> parse_labels(std::istream& file, const std::string& name)
{
    std::vector<Index> labels;
    std::string line;
    std::size_t number = 0;
    std::size_t first_empty = 0;
    while (std::getline(file, line)) {
        ++number;
        const std::string_view text = trimmed(line);
        if (text.empty()) {
            first_empty = first_empty == 0 ? number : first_empty;
            continue;
        }
        if (first_empty != 0)
            throw InputError(name + ", line " + std::to_string(first_empty) + ": empty, but labels follow");
        labels.push_back(parse_label(text, name + ", line " + std::to_string(number)));
    }
    return labels;
}

}  // namespace

std::vector<Index> read_labels(const std::filesystem::path& path, Index n_faces)
{
    std::ifstream file(path);
    if (!file || std::filesystem::is_directory(path))
        throw InputError(path.string() + ": cannot be read (" + std::strerror(file ? EISDIR : errno) + ")");
    auto labels = parse_labels(file, path.string());
    if (file.bad())
        throw InputError(path.string() + ": reading failed");
    if (labels.size() != static_cast<std::size_t>(n_faces))
        throw InputError(path.string() + ": holds " + std::to_string(labels.size()) + " labels, but the mesh has " +
                         std::to_string(n_faces) + " faces: one label a face is needed");
    return labels;
}

}  // namespace seamflow
