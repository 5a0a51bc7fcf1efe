#include "partition/io/text_scanner.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <system_error>

#include <fmt/format.h>

#include "partition/io/plain_numbers.h"
#include "partition/text.h"

namespace seamflow {

namespace {

bool is_blank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/// The character that ends each line: CR (carriage return) if the first line ends with CR, but not with CR LF, and
/// either the text has no LF (line feed) or the first line decides; otherwise LF.
char line_break_of(std::string_view text, bool first_line_end_decides)
{
    const auto first = text.find_first_of("\r\n");
    if (first == std::string_view::npos || text[first] == '\n')
        return '\n';
    const auto feed = text.find('\n', first);
    return feed == std::string_view::npos || (first_line_end_decides && feed > first + 1) ? '\r' : '\n';
}

/// The beginning of a number in [first, last): a plus sign is skipped, because from_chars does not accept it.
const char* after_plus(const char* first, const char* last)
{
    return last - first > 1 && *first == '+' && first[1] != '-' ? first + 1 : first;
}

/// from_chars, but a number that is too small for a double, and not for a long double, becomes zero; from_chars only
/// reports "out of range" for it.
std::from_chars_result parse(const char* first, const char* last, double& value)
{
    auto result = std::from_chars(first, last, value);
    if (result.ec != std::errc::result_out_of_range)
        return result;
    long double wide = 0;
    result = std::from_chars(first, last, wide);
    if (std::abs(wide) <= std::numeric_limits<double>::max())
        value = static_cast<double>(wide);
    else
        result.ec = std::errc::result_out_of_range;
    return result;
}

}  // namespace

TextScanner::TextScanner(const std::filesystem::path& path, std::string_view text, TextSyntax syntax)
    : path_(path.string())
    , syntax_(syntax)
    , line_break_(line_break_of(text, syntax.first_line_end_decides))
    , cursor_(text.data())
    , line_end_(text.data())
    , next_(text.data())
    , end_(text.data() + text.size())
{
    if (text.starts_with("\xEF\xBB\xBF"))
        next_ += 3;
}

TextScanner::TextScanner(const TextScanner& whole, std::string_view slice, std::size_t lines_before)
    : TextScanner(whole)
{
    // Slices are read at the same time, for which a FaultLog is not made: faults in this one are thrown, not collected.
    note_faults_in(nullptr);
    cursor_ = line_end_ = next_ = slice.data();
    end_ = slice.data() + slice.size();
    continued_ = false;
    line_ = lines_before;
}

/// The end of the line that contains `from`, after its line break.
const char* TextScanner::end_of_line(const char* from) const
{
    const auto* const line_break =
        static_cast<const char*>(std::memchr(from, line_break_, static_cast<std::size_t>(end_ - from)));
    return line_break != nullptr ? line_break + 1 : end_;
}

std::vector<std::string_view> TextScanner::slices(std::size_t bytes) const
{
    const auto may_be_continued = [&](const char* end) {
        while (end > next_ && is_blank(end[-1]))
            --end;
        return syntax_.continuation && end > next_ && end[-1] == '\\';
    };
    std::vector<std::string_view> result;
    for (const char* begin = next_; begin < end_;) {
        const char* end = static_cast<std::size_t>(end_ - begin) > bytes ? end_of_line(begin + bytes) : end_;
        while (end < end_ && may_be_continued(end))
            end = end_of_line(end);
        result.emplace_back(begin, static_cast<std::size_t>(end - begin));
        begin = end;
    }
    return result;
}

/// Makes the next line the present one, without blanks at its ends, its comment, and a backslash that continues it.
void TextScanner::load_line()
{
    ++line_;
    cursor_ = next_;
    next_ = end_of_line(cursor_);
    line_end_ = next_ > cursor_ && next_[-1] == line_break_ ? next_ - 1 : next_;
    const void* comment = nullptr;
    if (syntax_.comment != '\0')
        comment = std::memchr(cursor_, syntax_.comment, static_cast<std::size_t>(line_end_ - cursor_));
    if (comment != nullptr)
        line_end_ = static_cast<const char*>(comment);
    while (cursor_ < line_end_ && is_blank(*cursor_))
        ++cursor_;
    while (cursor_ < line_end_ && is_blank(line_end_[-1]))
        --line_end_;
    // The backslash at the end of a comment belongs to the comment.
    continued_ = syntax_.continuation && comment == nullptr && cursor_ < line_end_ && line_end_[-1] == '\\';
    if (continued_)
        --line_end_;
}

/// Goes to the next token, also in further lines if the line is continued or line ends count as blanks.
void TextScanner::skip_blanks()
{
    while (true) {
        while (cursor_ < line_end_ && is_blank(*cursor_))
            ++cursor_;
        if (cursor_ < line_end_ || !(continued_ || crosses_lines_) || next_ == end_)
            break;
        load_line();
    }
}

bool TextScanner::next_line()
{
    if (crosses_lines_)
        return has_token();
    while (continued_ && next_ < end_)
        load_line();
    cursor_ = line_end_;
    continued_ = false;
    while (next_ < end_) {
        load_line();
        skip_blanks();
        if (cursor_ < line_end_)
            return true;
    }
    return false;
}

/// Whether no character of a token is at c: a blank, or the end of the line.
bool TextScanner::ends_token(const char* c) const
{
    return c == line_end_ || is_blank(*c);
}

bool TextScanner::has_token()
{
    skip_blanks();
    return cursor_ < line_end_;
}

std::string_view TextScanner::peek()
{
    skip_blanks();
    return rest_of_token();
}

std::string_view TextScanner::rest_of_token() const
{
    const char* last = cursor_;
    while (!ends_token(last))
        ++last;
    return {cursor_, static_cast<std::size_t>(last - cursor_)};
}

std::string_view TextScanner::next_keyword()
{
    const auto find_keyword = [this] { return next_line() ? token() : std::string_view(); };
    // The short way is for a keyword at the very beginning of a line that neither continues another nor is continued.
    if (!next_line_stands_alone() || is_blank(*next_))
        return find_keyword();
    const char* const first = next_;
    const char* const next = end_of_line(first);
    const char* end = next;
    while (end > first && is_blank(end[-1]))
        --end;
    const char* last = first;
    while (last < end && !is_blank(*last) && *last != syntax_.comment)
        ++last;
    const bool touches_comment = last < end && !is_blank(*last);
    if (last == first || touches_comment || end[-1] == '\\')
        return find_keyword();
    pass_over_line(next);
    return {first, static_cast<std::size_t>(last - first)};
}

std::string_view TextScanner::token()
{
    const auto result = peek();
    skip(result.size());
    return result;
}

std::size_t TextScanner::pass_over_rest()
{
    std::size_t n = 0;
    while (!token().empty())
        ++n;
    return n;
}

double TextScanner::real(const char* what)
{
    skip_blanks();
    double value = 0;
    if (const char* const end = read_plain_real(cursor_, end_, value); end != nullptr && ends_token(end)) {
        cursor_ = end;
        return value;
    }
    const auto [last, error] = parse(after_plus(cursor_, line_end_), line_end_, value);
    if (error == std::errc() && ends_token(last) && std::isfinite(value)) {
        cursor_ = last;
        return value;
    }
    const std::string complaint = complaint_at_number(what, "a finite number such as 1.5 or -2e-3");
    if (rest_of_token().empty())
        fail(complaint);
    fault(complaint);
    skip(rest_of_token().size());
    return std::numeric_limits<double>::quiet_NaN();
}

double TextScanner::real_or_nan(const char* what)
{
    const std::string_view text = peek();
    const bool has_sign = text.starts_with('-') || text.starts_with('+');
    const std::string_view word = text.substr(has_sign ? 1 : 0);
    if (!word.starts_with('n') && !word.starts_with('N'))
        return real(what);
    if (lower_case(word) != "nan")
        fail(complaint_at_number(what, "a finite number, or nan where there is none"));
    skip(text.size());
    return std::numeric_limits<double>::quiet_NaN();
}

std::array<double, 3> TextScanner::coordinates()
{
    const double x = real("coordinate x");
    const double y = real("coordinate y");
    const double z = real("coordinate z");
    return {x, y, z};
}

double TextScanner::number_or_nan()
{
    const std::string_view text = token();
    const char* const last = text.data() + text.size();
    double value = 0;
    const auto [end, error] = parse(after_plus(text.data(), last), last, value);
    const bool is_number = error == std::errc() && end == last && std::isfinite(value);
    return is_number ? value : std::numeric_limits<double>::quiet_NaN();
}

std::int64_t TextScanner::integer_before_slash(const char* what)
{
    skip_blanks();
    std::uint64_t digits = 0;
    if (const char* const end = read_plain_digits(cursor_, end_, digits);
        end != nullptr && end != cursor_ && (ends_token(end) || *end == '/')) {
        cursor_ = end;
        return static_cast<std::int64_t>(digits);
    }
    std::int64_t value = 0;
    const auto [last, error] = std::from_chars(after_plus(cursor_, line_end_), line_end_, value);
    if (error != std::errc() || (!ends_token(last) && *last != '/'))
        fail(complaint_at_number(what, "a whole number"));
    cursor_ = last;
    return value;
}

std::int64_t TextScanner::integer(const char* what)
{
    skip_blanks();
    const char* const first = cursor_;
    const auto value = integer_before_slash(what);
    if (!ends_token(cursor_)) {
        cursor_ = first;
        fail(complaint_at_number(what, "a whole number"));
    }
    return value;
}

/// The complaint that the next token is not the expected number.
/// @param what the expected thing. @param form the form in which it can be written.
std::string TextScanner::complaint_at_number(const char* what, const char* form)
{
    const auto found = peek();
    if (found.empty())
        return fmt::format("expected {}, but the line ends; add what is missing or export the mesh again", what);
    return fmt::format("expected {}, but found {}; write {}", what, in_quotes(found), form);
}

}  // namespace seamflow
