#include "samples/files/step_pattern.h"

#include <algorithm>

#include "partition/errors.h"

namespace seamflow {

StepPattern::StepPattern(std::string_view pattern)
{
    const auto refuse = [&] {
        throw OptionError("\"" + std::string(pattern) +
                          "\" must contain the number of the step exactly once, as %d or with a width, as %03d");
    };
    std::string* part = &before_;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        if (pattern[i] != '%') {
            *part += pattern[i];
            continue;
        }
        if (pattern.substr(i, 2) == "%%") {
            *part += pattern[++i];
            continue;
        }
        const std::size_t digits = i + 1;
        const std::size_t end = std::min(pattern.find_first_not_of("0123456789", digits), pattern.size());
        const auto width = pattern.substr(digits, end - digits);
        if (part == &after_ || end == pattern.size() || pattern[end] != 'd' || width.size() > 2)
            refuse();
        fill_ = width.starts_with('0') ? '0' : ' ';
        for (const char digit : width)
            width_ = 10 * width_ + static_cast<std::size_t>(digit - '0');
        part = &after_;
        i = end;
    }
    if (part == &before_)
        refuse();
}

std::filesystem::path StepPattern::path(int step) const
{
    std::string number = std::to_string(step);
    if (number.size() < width_)
        number.insert(0, width_ - number.size(), fill_);
    return before_ + number + after_;
}

}  // namespace seamflow
