#include "partition/io/index_lines.h"

#include <charconv>
#include <fstream>
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

[[noreturn]] void refuse(const std::filesystem::path& path, std::size_t line, std::string_view text,
                         const std::string& why)
{
    std::string message = place_of_line(path, line);
    message.append("'").append(text.substr(0, 40)).append("' ").append(why);
    throw InputError(message);
}

Index parse(std::string_view text, const std::filesystem::path& path, std::size_t line, const IndexLineWords& words)
{
    Index value = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range)
        refuse(path, line, text, "is too large or too small: use numbers from 0 to 2147483647");
    if (error != std::errc() || end != text.data() + text.size())
        refuse(path, line, text, std::string("is not ") + words.name + ": " + words.remedy);
    if (value < 0)
        refuse(path, line, text, std::string("is negative: ") + words.negative);
    return value;
}

}  // namespace

std::string place_of_line(const std::filesystem::path& path, std::size_t line)
{
    return path.string() + ":" + std::to_string(line) + ": ";
}

std::size_t read_index_lines(const std::filesystem::path& path, const IndexLineWords& words,
                             const std::function<void(Index value, std::size_t line)>& take)
{
    std::ifstream file(path);
    if (!file || std::filesystem::is_directory(path))
        throw InputError(path.string() + ": cannot open the file for reading: check its name and permissions");
    std::string text;
    std::size_t line = 0;
    while (std::getline(file, text)) {
        ++line;
        if (const std::string_view number = content(text); !number.empty())
            take(parse(number, path, line, words), line);
    }
    if (file.bad())
        throw InputError(place_of_line(path, line) + "the file could not be read to its end: copy it to a sound disk");
    return line;
}

}  // namespace seamflow
