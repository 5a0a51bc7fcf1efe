#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "partition/remark.h"

namespace seamflow::test {

/// What is said by the exception of this type that an action throws; empty: it throws none.
template <class Error = std::exception, class Action>
std::string message_of(Action&& action)
{
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

inline bool contains(std::string_view text, std::string_view part)
{
    return text.find(part) != std::string_view::npos;
}

/// Remarks in the words of the library.
inline std::vector<std::string> sentences(const std::vector<Remark>& remarks)
{
    std::vector<std::string> list;
    for (const Remark& remark : remarks)
        list.push_back(sentence(remark));
    return list;
}

/// How many of these remarks have that text.
inline std::ptrdiff_t count_with(const std::vector<std::string>& remarks, std::string_view text)
{
    return std::ranges::count_if(remarks, [&](const std::string& remark) { return contains(remark, text); });
}

inline std::ptrdiff_t count_with(const std::vector<Remark>& remarks, std::string_view text)
{
    return count_with(sentences(remarks), text);
}

}  // namespace seamflow::test
