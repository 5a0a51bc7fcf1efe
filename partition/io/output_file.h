#pragma once

#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

#include "partition/io/byte_order.h"

namespace seamflow {

/// The file that a path leads to: symbolic links are followed, to files that do not exist as well.
/// @returns the path of a link only where links lead round in a circle.
std::filesystem::path file_behind(const std::filesystem::path& path);

/// A file that appears whole or not at all: written without a name, or under a temporary one where the file system
/// cannot do that, in the folder of its target, and given its name by `commit`. Without `commit` nothing remains of it,
/// and a file that was there before remains as it was. A file that is replaced hands on its permissions; a symbolic
/// link stays, and the file it points to is replaced.
class OutputFile {
  public:
    /// @throws OutputError naming the file and the system's reason; also if `path` is there but no regular file.
    explicit OutputFile(const std::filesystem::path& path);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile();

    /// As it was named, for messages.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// @throws OutputError, as all functions of this class, if the file cannot be written.
    void text(std::string_view text);

    /// A whole number in decimal.
    void number(std::integral auto value) { append_chars(value); }

    /// A number with the fewest digits (at most 17) that read back to the same value, independently of the locale.
    void number(std::floating_point auto value)
    {
        if (std::abs(value) < 1e17)
            append_chars(value);
        else
            append_chars(value, std::chars_format::scientific);
    }

    /// A line of the word, which may be empty, and the numbers, with blanks between.
    void line(std::string_view word, const auto& numbers)
    {
        text(word);
        for (bool follows = !word.empty(); const auto value : numbers) {
            if (follows)
                put(' ');
            follows = true;
            number(value);
        }
        put('\n');
    }

    /// The bytes of a number.
    template <class Number>
    void binary(Number value, std::endian order)
    {
        const auto bytes = to_bytes(value, order);
        text({bytes.data(), bytes.size()});
    }

    /// Writes what is left to the disk and gives the file its name. To be called once, at the end.
    void commit();

  private:
    [[noreturn]] void fail(int error) const;
    void open();
    void give_name();
    void flush();
    void make_room(std::size_t n)
    {
        if (buffer_.size() - used_ < n)
            flush();
    }

    void put(char c)
    {
        make_room(1);
        buffer_[used_++] = c;
    }

    void append_chars(auto... value_and_format)
    {
        make_room(longest_number);
        char* const first = buffer_.data() + used_;
        used_ +=
            static_cast<std::size_t>(std::to_chars(first, first + longest_number, value_and_format...).ptr - first);
    }

    static constexpr std::size_t longest_number = 32;

    std::filesystem::path path_;
    std::filesystem::path target_;
    /// Empty as long as the file has no name.
    std::filesystem::path temporary_;
    int descriptor_ = -1;
    std::vector<char> buffer_;
    std::size_t used_ = 0;
};

}  // namespace seamflow
