#include "partition/remark.h"

#include <algorithm>

namespace seamflow {

std::string option_of_library(std::string_view option, std::string_view value)
{
    std::string text(option);
    if (!value.empty())
        text.append(" ").append(value);
    return text;
}

std::string sentence(const Wording& wording, const OptionWriter& write)
{
    std::string text;
    std::string_view rest = wording.text;
    for (auto at = rest.find('<'); at != std::string_view::npos; at = rest.find('<')) {
        text += rest.substr(0, at);
        rest.remove_prefix(at + 1);
        if (rest.starts_with('<')) {
            text += '<';
            rest.remove_prefix(1);
            continue;
        }
        const std::string_view mark = rest.substr(0, rest.find('>'));
        const std::string_view option = mark.substr(0, mark.find(' '));
        text += write(option, mark.substr(std::min(option.size() + 1, mark.size())));
        rest.remove_prefix(std::min(mark.size() + 1, rest.size()));
    }
    return text.append(rest);
}

Wording unmarked(std::string_view text)
{
    std::string doubled;
    for (const char c : text)
        doubled.append(c == '<' ? 2 : 1, c);
    return {doubled};
}

Remark::Remark(std::string kind_of_remark, Numbers numbers_of_it, Wording wording_of_it)
    : kind(std::move(kind_of_remark))
    , numbers(std::move(numbers_of_it))
    , wording(std::move(wording_of_it))
{
}

Remark::Remark(const std::string& text)
    : Remark("other", {}, unmarked(text))
{
}

std::optional<double> Remark::number(std::string_view name) const
{
    const auto found = std::ranges::find(numbers, name, &std::pair<std::string, double>::first);
    return found == numbers.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace seamflow
