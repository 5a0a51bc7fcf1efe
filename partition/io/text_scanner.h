#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "partition/errors.h"
#include "partition/io/input_position.h"
#include "partition/io/plain_line.h"

namespace seamflow {

/// The special characters of a text format, besides blanks and line ends.
struct TextSyntax {
    /// A comment extends from this character to the end of the line; 0: there are no comments.
    char comment = '#';
    /// Whether a backslash at the end of a line joins it to the next line.
    bool continuation = false;
    /// Whether the first line end determines all others, because binary data may follow the text.
    bool first_line_end_decides = false;
};

/// Walks through a text in memory line by line, and through a line token by token, counting lines. Lines end with LF,
/// CR LF, or (on very old systems) CR; the last one need not end. Tokens are separated by blanks and tabs. A byte order
/// mark at the beginning is passed over. Independent of the locale; allocates nothing.
class TextScanner final : public InputPosition {
  public:
    /// @param path for messages only.
    /// @param text must outlive the scanner.
    TextScanner(const std::filesystem::path& path, std::string_view text, TextSyntax syntax = {});

    /// A scanner for a slice of the text of another scanner, with the same line breaks.
    /// @param lines_before the number of lines before the slice; 0: lines are numbered within the slice.
    TextScanner(const TextScanner& whole, std::string_view slice, std::size_t lines_before = 0);

    /// The rest of the text in slices that begin and end at line boundaries, none within a continued line.
    /// @param bytes their size, up to the end of a line.
    [[nodiscard]] std::vector<std::string_view> slices(std::size_t bytes) const;

    /// Treats line ends as blanks from now on: tokens continue in the next line, and next_line does nothing while there
    /// are any.
    void cross_lines() { crosses_lines_ = true; }
    [[nodiscard]] bool crosses_lines() const { return crosses_lines_; }

    /// Goes to the next line with a token, skipping the rest of this one. False at the end of the text.
    bool next_line();

    /// Goes to the next line with a token and returns this token; empty at the end of the text. Faster than `next_line`
    /// and `token`, but the rest of the line may be passed over, as by a caller that counts lines.
    std::string_view next_keyword();

    /// Reads the next line if it is plain, which means in its commonest form (see PlainLine). Otherwise nothing
    /// changes, and next_line finds the line.
    /// @param read called with a PlainLine; returns whether it could read the line to its end.
    template <class Read>
    bool next_plain_line(Read&& read)
    {
        if (!next_line_stands_alone())
            return false;
        PlainLine line(next_, end_, line_break_);
        if (!read(line))
            return false;
        pass_over_line(line.rest());
        return true;
    }

    /// The next token of the line; empty if there is none left.
    std::string_view token();

    /// The token that `token` would return; the scanner does not move.
    [[nodiscard]] std::string_view peek();

    /// Whether a token of the line is left.
    [[nodiscard]] bool has_token();

    /// Skips the remaining tokens of the line. @returns their number.
    std::size_t pass_over_rest();

    /// The rest of the token from which a number has just been read; empty if nothing is left.
    [[nodiscard]] std::string_view rest_of_token() const;

    /// Skips n characters of the token that `peek` or `rest_of_token` returns.
    void skip(std::size_t n) { cursor_ += n; }

    /// Reads the next token as a finite number, correctly rounded. A number too small for a double is zero, unless it
    /// is too small for a long double, too: that counts as not finite.
    /// @param what the expected thing ("a coordinate"), for the message.
    /// @returns NaN for a token that is not a finite number if faults are collected (see InputPosition::fault).
    /// @throws InputError if no token is left; also for a token that is not a finite number if faults are not
    /// collected.
    double real(const char* what);

    /// The next three tokens as the coordinates x, y and z.
    /// @throws InputError as for `real`.
    std::array<double, 3> coordinates();

    /// Reads the next token as a finite number or NaN: "nan" in upper or lower case, perhaps with a sign.
    /// @throws InputError as for `real`.
    double real_or_nan(const char* what);

    /// The next token as a number; NaN if it is missing or not a finite number.
    double number_or_nan();

    /// The next token, or its beginning up to a slash, as a whole number.
    /// @throws InputError as for `real`.
    std::int64_t integer_before_slash(const char* what);

    /// The next token as a whole number.
    /// @throws InputError as for `real`.
    std::int64_t integer(const char* what);

    /// The text after the present line.
    [[nodiscard]] std::string_view rest() const { return {next_, static_cast<std::size_t>(end_ - next_)}; }

    /// The number of the present line, from 1.
    [[nodiscard]] std::size_t line() const { return line_; }

    /// As `fail`, about any line; 0: the whole file.
    template <class... Parts>
    [[noreturn]] void fail_at(std::size_t line, fmt::format_string<const Parts&...> complaint,
                              const Parts&... parts) const
    {
        throw InputError(position_of(line) + ": " + fmt::format(complaint, parts...));
    }

  private:
    [[nodiscard]] std::string position() const override { return position_of(line_); }
    /// "path:line"; "path" for 0.
    [[nodiscard]] std::string position_of(std::size_t line) const
    {
        return line > 0 ? fmt::format("{}:{}", path_, line) : path_;
    }
    [[nodiscard]] const char* end_of_line(const char* from) const;
    [[nodiscard]] bool ends_token(const char* c) const;
    void load_line();
    /// Whether a next line is left whose tokens are separate from those of the present line: the present line is not
    /// continued, and line ends do not count as blanks.
    [[nodiscard]] bool next_line_stands_alone() const { return next_ < end_ && !continued_ && !crosses_lines_; }
    /// Counts a line. @param next the beginning of the following line.
    void pass_over_line(const char* next)
    {
        ++line_;
        cursor_ = line_end_ = next_ = next;
    }
    void skip_blanks();
    [[nodiscard]] std::string complaint_at_number(const char* what, const char* form);

    std::string path_;
    TextSyntax syntax_;
    char line_break_ = '\n';
    /// The part of the line that has not been read, without the line's end and comment.
    const char* cursor_;
    const char* line_end_;
    /// The beginning of the next line, and the end of the text.
    const char* next_;
    const char* end_;
    /// Whether the present line ends with a backslash, so that the next line continues it.
    bool continued_ = false;
    /// Whether line ends count as blanks (see cross_lines).
    bool crosses_lines_ = false;
    /// The number of the present line, from 1; 0 before the first.
    std::size_t line_ = 0;
};

}  // namespace seamflow
