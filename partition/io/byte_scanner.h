#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "partition/io/byte_order.h"
#include "partition/io/input_position.h"

namespace seamflow {

/// Bytes allowed after the last element of a binary file.
inline constexpr std::string_view padding("\0 \t\r\n", 5);

/// Walks through binary data in memory number by number.
class ByteScanner final : public InputPosition {
  public:
    /// @param path for messages only.
    /// @param file the whole file; must outlive the scanner, as must the text given to `enter`.
    /// @param offset of the first number. @param order of the bytes.
    ByteScanner(const std::filesystem::path& path, std::string_view file, std::size_t offset, std::endian order);

    /// Sets the element to which the following bytes belong, for messages.
    /// @param i its number, from 0.
    void enter(std::string_view element, std::uint64_t i)
    {
        element_ = element;
        i_ = i;
    }

    /// Reads the next number.
    /// @throws InputError if the file ends first.
    template <class Number>
    Number read()
    {
        return from_bytes<Number>(take(sizeof(Number)), order_);
    }

    /// Skips n bytes and returns a pointer to them.
    /// @throws InputError if the file ends first.
    const char* take(std::size_t n)
    {
        last_ = next_;
        if (n > remaining())
            fail_at_end();
        next_ += n;
        return file_.data() + last_;
    }

    /// Skips n bytes, which the caller knows to exist.
    /// @param size of the last number among them, to which messages refer.
    void skip(std::size_t n, std::size_t size)
    {
        next_ += n;
        last_ = next_ - size;
    }

    /// The next n bytes, which the caller knows to exist.
    [[nodiscard]] std::string_view peek(std::size_t n) const { return file_.substr(next_, n); }

    [[nodiscard]] std::size_t remaining() const { return file_.size() - next_; }

    /// @throws InputError if anything but padding (zeros, blanks, line ends) is left.
    void require_end();

  private:
    [[nodiscard]] std::string position() const override;
    [[noreturn]] void fail_at_end() const;

    std::string path_;
    std::string_view file_;
    std::endian order_;
    std::size_t last_;
    std::size_t next_;
    std::string_view element_;
    std::uint64_t i_ = 0;
};

}  // namespace seamflow
