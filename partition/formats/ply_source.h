#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "partition/formats/ply_header.h"
#include "partition/index.h"
#include "partition/io/byte_scanner.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

/// The order of the bytes in a binary file.
inline std::endian order_of(Encoding encoding)
{
    return encoding == Encoding::BinaryBigEndian ? std::endian::big : std::endian::little;
}

/// A property of an element that is read, and the properties before it that are skipped.
struct PlySlot {
    /// The skipped properties, which are numbers, not lists.
    std::span<const PlyProperty> passed_over;
    /// The number of bytes of the skipped properties in a binary file.
    std::size_t n_bytes = 0;
    /// The property; null at the end of the element.
    const PlyProperty* property = nullptr;
    /// The column of its numbers; -1: a list that is skipped.
    Index column = -1;
};

/// The slots of an element, in order.
/// @param columns one per property: its column; -1 if it is skipped (see columns_of).
std::vector<PlySlot> slots_of(const PlyElement& element, const std::vector<Index>& columns);

/// The numbers of a PLY file, one after another. In text an element is a line, unless line ends count as blanks, and
/// types do not matter. All functions throw InputError, naming the line, or element and byte, if the file has something
/// else.
class PlySource {
  public:
    /// The numbers of a text file.
    /// @param scanner at the last line of the header.
    /// @param what the thing to export again if the length of a list is negative.
    PlySource(const TextScanner& scanner, const char* what)
        : scanner_(scanner)
        , what_(what)
    {
    }

    /// The numbers of a binary file.
    /// @param scanner at the first number.
    PlySource(const ByteScanner& scanner, const char* what)
        : scanner_(scanner)
        , what_(what)
    {
    }

    [[nodiscard]] const InputPosition& position() const;
    void note_faults_in(FaultLog* log);

    /// Reads the elements begin to end - 1 of a kind, numbered from 0.
    /// @param columns one per property: its column; -1 if it is skipped (see columns_of). @param read called with the
    ///        number of the element, the column of a property and its declaration, to read it.
    /// @param act called with the number of the element after its last property; it calls end_element.
    void scan(const PlyElement& element, std::uint64_t begin, std::uint64_t end, const std::vector<Index>& columns,
              const auto& read, const auto& act)
    {
        const std::vector<PlySlot> slots = slots_of(element, columns);
        for (std::uint64_t i = begin; i < end; ++i) {
            begin_element(element, i);
            for (const PlySlot& slot : slots) {
                pass_over(slot);
                if (slot.column >= 0)
                    read(static_cast<Index>(i), slot.column, *slot.property);
                else if (slot.property != nullptr)
                    pass_over(*slot.property);
            }
            act(static_cast<Index>(i));
        }
    }

    /// Passes over the elements begin to end - 1 of a kind.
    void pass_over(const PlyElement& element, std::uint64_t begin, std::uint64_t end);

    /// Checks that the element has no further numbers.
    void end_element()
    {
        if (is_text())
            end_line();
    }

    /// Checks that nothing but padding follows. To be called after the last element.
    void finish();

    /// The next number, which must be finite, unless faults are collected.
    double real(PlyType type)
    {
        if (is_text())
            return text().real("a coordinate");
        const double value = number(type);
        if (!std::isfinite(value))
            bytes().fault("a coordinate is not a finite number; remove the vertex or mend it");
        return value;
    }

    /// The next number, finite or not; NaN if the text is no number.
    double number(PlyType type)
    {
        if (is_text())
            return text().number_or_nan();
        return with_type(type, [&](auto zero) { return static_cast<double>(bytes().template read<decltype(zero)>()); });
    }

    /// The next number of a field (see FileFields), which must not be infinite.
    /// @param name of the field, in messages.
    double field(PlyType type, const char* name);

    /// The next number, which must be whole.
    [[gnu::always_inline]] std::int64_t integer(PlyType type)
    {
        if (is_text())
            return text().integer("a whole number");
        if (!is_integer(type))
            bytes().fail("a number that should be whole has a type with decimals; correct the header");
        return with_type(type,
                         [&](auto zero) { return static_cast<std::int64_t>(bytes().template read<decltype(zero)>()); });
    }

    /// Reads the length of a list.
    std::int64_t length(const PlyProperty& list)
    {
        const std::int64_t n = integer(*list.length_type);
        if (n < 0)
            refuse_length(list, n);
        if (!is_text())
            require_room(list.type, n);
        return n;
    }

    /// Calls `act` with each of the whole numbers in a list.
    void integers(const PlyProperty& list, const auto& act)
    {
        std::int64_t n = length(list);
        if (is_text() || !is_integer(list.type)) {
            for (; n > 0; --n)
                act(integer(list.type));
            return;
        }
        with_type(list.type, [&](auto zero) {
            for (; n > 0; --n)
                act(static_cast<std::int64_t>(bytes().template read<decltype(zero)>()));
        });
    }

    /// Passes over a number or a list.
    [[gnu::always_inline]] void pass_over(const PlyProperty& property)
    {
        const std::int64_t n = property.length_type ? length(property) : 1;
        if (is_text())
            return pass_over_tokens(n);
        require_room(property.type, n);
        bytes().take(static_cast<std::size_t>(n) * size_in_bytes(property.type));
    }

    /// The characters or bytes of the next number.
    std::string_view peek(PlyType type) { return is_text() ? text().peek() : bytes().peek(size_in_bytes(type)); }

    /// An empty piece of text after the last number.
    [[nodiscard]] std::string_view behind();

  private:
    [[nodiscard]] bool is_text() const { return scanner_.index() == 0; }
    [[nodiscard]] TextScanner& text() { return *std::get_if<TextScanner>(&scanner_); }
    [[nodiscard]] ByteScanner& bytes() { return *std::get_if<ByteScanner>(&scanner_); }

    void begin_element(const PlyElement& element, std::uint64_t i)
    {
        if (is_text())
            begin_line(element, i);
        else
            bytes().enter(element.name, i);
    }

    /// Skips the properties before that of a slot.
    void pass_over(const PlySlot& slot)
    {
        if (slot.passed_over.empty())
            return;
        if (!is_text() && slot.n_bytes <= bytes().remaining())
            return bytes().skip(slot.n_bytes, size_in_bytes(slot.passed_over.back().type));
        for (const PlyProperty& property : slot.passed_over)
            pass_over(property);
    }

    /// Checks that n numbers can follow in a binary file.
    void require_room(PlyType type, std::int64_t n)
    {
        const auto wanted = static_cast<std::uint64_t>(n);
        const std::uint64_t room = bytes().remaining();
        if (wanted > room || wanted * size_in_bytes(type) > room)
            refuse_room(n);
    }

    void begin_line(const PlyElement& element, std::uint64_t i);
    void end_line();
    void pass_over_tokens(std::int64_t n);
    [[noreturn]] void refuse_length(const PlyProperty& list, std::int64_t n) const;
    [[noreturn]] void refuse_room(std::int64_t n) const;

    std::variant<TextScanner, ByteScanner> scanner_;
    const char* what_;
};

}  // namespace seamflow
