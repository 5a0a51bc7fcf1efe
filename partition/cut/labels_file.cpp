#include "partition/cut/labels_file.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string>
#include <string_view>

#include "partition/errors.h"

namespace seamflow {

namespace {

/// The line without its comment and without blanks at either end.
std::string_view content(std::string_view line)
{
    line = line.substr(0, line.find('#'));
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos)
        return {};
    return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

std::string place(const std::filesystem::path& path, std::size_t line)
{
    return path.string() + ":" + std::to_string(line) + ": ";
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::size_t line, std::string_view text,
                         const std::string& why)
{
    std::string message = place(path, line);
    message.append("'").append(text.substr(0, 40)).append("' ").append(why);
    throw InputError(message);
}

Index parse_label(std::string_view text, const std::filesystem::path& path, std::size_t line)
{
    Index label = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), label);
    if (error == std::errc::result_out_of_range)
        refuse(path, line, text, "is too large or too small: use labels from 0 to 2147483647");
    if (error != std::errc() || end != text.data() + text.size())
        refuse(path, line, text, "is not a label: write one whole number for each face, each on a line of its own");
    if (label < 0)
        refuse(path, line, text, "is negative: number the parts from 0");
    return label;
}

}  // namespace

std::vector<Index> read_labels(const std::filesystem::path& path, Index n_faces)
{
    std::ifstream file(path);
    if (!file || std::filesystem::is_directory(path))
        throw InputError(path.string() + ": cannot open the file for reading: check its name and permissions");
    std::vector<Index> labels;
    std::string text;
    std::size_t line = 0;
    while (std::getline(file, text)) {
        ++line;
        const std::string_view label = content(text);
        if (label.empty())
            continue;
        if (labels.size() == static_cast<std::size_t>(n_faces))
            throw InputError(place(path, line) + "more labels than the mesh has faces (" + std::to_string(n_faces) +
                             "): remove the surplus, or use the labels with the mesh they belong to");
        labels.push_back(parse_label(label, path, line));
    }
    if (file.bad())
        throw InputError(place(path, line) + "the file could not be read to its end: copy it to a sound disk");
    if (labels.size() != static_cast<std::size_t>(n_faces))
        throw InputError(place(path, std::max<std::size_t>(line, 1)) + "the file ends after " +
                         std::to_string(labels.size()) + " of " + std::to_string(n_faces) +
                         " labels: give one for each face, or use the labels with the mesh they belong to");
    return labels;
}

}  // namespace seamflow
