#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "partition/io/byte_order.h"

namespace seamflow {

/// Writes text, numbers and binary data in sequence.
class ByteWriter {
  public:
    ByteWriter(const ByteWriter&) = delete;
    ByteWriter& operator=(const ByteWriter&) = delete;

    void text(std::string_view text)
    {
        if (room_ - used_ < text.size())
            return overflow(text);
        std::copy(text.begin(), text.end(), bytes_.get() + used_);
        used_ += text.size();
    }

    /// Writes a whole number in decimal.
    void number(std::integral auto value) { append_chars(value); }

    /// Writes a number with the fewest digits (at most 17) that read back to the same value, whatever the locale. NaN
    /// is written without a sign.
    void number(std::floating_point auto value)
    {
        if (std::abs(value) < 1e17)
            append_chars(value);
        else if (std::isnan(value))
            text("nan");
        else
            append_chars(value, std::chars_format::scientific);
    }

    /// Writes a line: the word, which may be empty, and the numbers, separated by blanks.
    void line(std::string_view word, const auto& numbers)
    {
        text(word);
        for (bool follows = !word.empty(); const auto value : numbers) {
            if (follows)
                text(" ");
            follows = true;
            number(value);
        }
        text("\n");
    }

    /// Writes the bytes of a number.
    template <class Number>
    void binary(Number value, std::endian order)
    {
        const auto bytes = to_bytes(value, order);
        text({bytes.data(), bytes.size()});
    }

    /// Writes the bytes of several numbers.
    template <class Number>
    void binary(std::span<const Number> values, std::endian order)
    {
        if (order == std::endian::native)
            return text({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
        for (const Number value : values)
            binary(value, order);
    }

  protected:
    explicit ByteWriter(std::size_t room)
        : bytes_(std::make_unique_for_overwrite<char[]>(room))
        , room_(room)
    {
    }
    ByteWriter(ByteWriter&&) = default;
    ByteWriter& operator=(ByteWriter&&) = default;
    ~ByteWriter() = default;

    /// The bytes that have been written, as far as they are still in memory.
    [[nodiscard]] std::string_view kept() const { return {bytes_.get(), used_}; }
    /// Forgets the bytes that are in memory.
    void give_up() { used_ = 0; }

    /// Reserves memory for n more bytes.
    void grow(std::size_t n);

    static constexpr std::size_t longest_number = 32;

  private:
    /// Writes a text that does not fit into the memory, and makes room for a number.
    virtual void overflow(std::string_view text) = 0;

    void append_chars(auto... value_and_format)
    {
        if (room_ - used_ < longest_number)
            overflow({});
        char* const first = bytes_.get() + used_;
        used_ +=
            static_cast<std::size_t>(std::to_chars(first, first + longest_number, value_and_format...).ptr - first);
    }

    std::unique_ptr<char[]> bytes_;
    std::size_t room_;
    std::size_t used_ = 0;
};

/// Bytes that are written to memory.
class OutputBuffer final : public ByteWriter {
  public:
    OutputBuffer()
        : ByteWriter(0)
    {
    }
    OutputBuffer(OutputBuffer&&) = default;
    OutputBuffer& operator=(OutputBuffer&&) = default;
    ~OutputBuffer() = default;

    [[nodiscard]] std::string_view content() const { return kept(); }

    /// Removes all bytes, but keeps the memory.
    void clear() { give_up(); }

  private:
    void overflow(std::string_view text) override;
};

}  // namespace seamflow
