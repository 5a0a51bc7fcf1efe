#include "partition/io/input_position.h"

#include <algorithm>

#include <fmt/format.h>

#include "partition/errors.h"

namespace seamflow {

void InputPosition::fail(const std::string& complaint) const
{
    throw InputError(position() + ": " + complaint);
}

void InputPosition::fault(const std::string& complaint) const
{
    if (!notes_faults())
        fail(complaint);
    log_->add(position() + ": " + complaint);
}

void InputPosition::harmless_fault(const std::string& complaint) const
{
    if (log_ == nullptr)
        fail(complaint);
    log_->add(position() + ": " + complaint);
    ++log_->n_harmless;
}

void InputPosition::leave_out_face(Index f) const
{
    if (log_ != nullptr)
        log_->faces_left_out.push_back(f);
}

std::string printable(std::string_view text)
{
    constexpr std::size_t longest = 40;
    std::string result;
    for (const char c : text.substr(0, longest))
        result += c >= ' ' && c <= '~' ? c : '?';
    return text.size() > longest ? result + "…" : result;
}

std::string in_quotes(std::string_view text)
{
    return fmt::format("'{}'", printable(text));
}

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
