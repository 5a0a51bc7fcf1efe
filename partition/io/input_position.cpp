#include "partition/io/input_position.h"

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

}  // namespace seamflow
