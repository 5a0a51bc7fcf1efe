#include "partition/text.h"

#include <algorithm>

#include <fmt/format.h>

namespace seamflow {

std::string counted(std::uint64_t count, const std::string& singular, const std::string& plural)
{
    return fmt::format("{} {}", count, count == 1 ? singular : plural);
}

std::string lower_case(std::string_view text)
{
    std::string result(text);
    std::ranges::transform(text, result.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return result;
}

void add_once(std::vector<std::string>& list, std::string_view what)
{
    if (std::ranges::find(list, what) == list.end())
        list.emplace_back(what);
}

}  // namespace seamflow
