#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "partition/io/plain_numbers.h"

namespace seamflow {

/// A line in its commonest form: tokens with spaces between them, without a comment and not continued. A reading
/// function returns false if its kind of token does not come next; then nothing more can be read.
class PlainLine {
  public:
    /// @param begin of the line. @param end of the text. @param line_break the last character of each line.
    PlainLine(const char* begin, const char* end, char line_break)
        : next_(begin)
        , end_(end)
        , line_break_(line_break)
    {
    }

    /// Reads a word of one letter at the beginning of the line, with a space after it.
    bool keyword(char letter)
    {
        const bool is_here = end_ - next_ > 1 && next_[0] == letter && next_[1] == ' ';
        next_ += is_here ? 1 : 0;
        return is_here;
    }

    /// Reads a number without an exponent.
    /// @param written receives its text.
    bool real(double& value, std::string_view& written)
    {
        skip_spaces();
        const char* const first = next_;
        next_ = read_plain_real(first, end_, value);
        if (next_ == nullptr || !ends_token())
            return false;
        written = {first, static_cast<std::size_t>(next_ - first)};
        return true;
    }

    /// Reads a whole number without a sign and skips up to two others, after slashes: as in 7, 7/1, 7//2, 7/1/2.
    bool corner(std::uint64_t& number)
    {
        skip_spaces();
        const char* const first = next_;
        number = 0;
        next_ = read_plain_digits(first, end_, number);
        if (next_ == nullptr || next_ == first)
            return false;
        for (int slashes = 0; *next_ == '/' && slashes < 2; ++slashes) {
            std::uint64_t passed_over = 0;
            next_ = read_plain_digits(next_ + 1, end_, passed_over);
            if (next_ == nullptr)
                return false;
        }
        return ends_token();
    }

    /// Whether the line ends here with a line break, which is skipped then; false at the end of the text.
    bool ends()
    {
        skip_spaces();
        const char* last = next_;
        if (line_break_ == '\n' && last < end_ && *last == '\r')
            ++last;
        if (last == end_ || *last != line_break_)
            return false;
        next_ = last + 1;
        return true;
    }

    /// The rest of the text.
    [[nodiscard]] const char* rest() const { return next_; }

  private:
    void skip_spaces()
    {
        while (next_ < end_ && *next_ == ' ')
            ++next_;
    }

    /// Whether a token ends here; any other character makes the next reading fail.
    [[nodiscard]] bool ends_token() const { return static_cast<unsigned char>(*next_) <= ' '; }

    const char* next_;
    const char* end_;
    char line_break_;
};

}  // namespace seamflow
