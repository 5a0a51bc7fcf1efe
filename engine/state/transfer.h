#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "engine/state/checksum.h"
#include "partition/polygon_mesh.h"

/// Structs, field by field: for checksums and files (see archive.h).
namespace seamflow {

/// Whether Value is Struct, const or not.
template <class Value, class Struct>
concept Is = std::is_same_v<std::remove_const_t<Value>, Struct>;

/// Structs that have a function `fields` in their namespace, which lists all fields: the compiler refuses a list that
/// is not complete.
template <class Value>
concept HasFields = requires(Value& value)
{
    fields(value);
};

template <class Value>
concept IsOptional = requires(Value& value)
{
    value.has_value();
};

/// Arrays of numbers, which are written and read in one piece.
template <class Value>
concept HasNumbers =
    Is<Value, Points> || Is<Value, std::string> || Is<Value, std::vector<double>> || Is<Value, std::vector<Index>>;

/// Writes a value, field by field, to a file, or reads it. Values are const when they are written.
template <class Archive, class Value>
void transfer(Archive& archive, Value& value)
{
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
        archive.number(value);
    } else if constexpr (HasFields<Value>) {
        std::apply([&](auto&... field) { (transfer(archive, field), ...); }, fields(value));
    } else {
        archive.size(value);
        if constexpr (HasNumbers<Value>)
            archive.numbers(std::span(value.data(), static_cast<std::size_t>(value.size())));
        else if constexpr (IsOptional<Value>) {
            if (value)
                transfer(archive, *value);
        } else
            for (auto& element : value)
                transfer(archive, element);
    }
}

/// The size of an array as it stands in an archive: the rows of Points, 0 or 1 for an optional value, otherwise the
/// number of elements.
template <class Array>
std::uint64_t size_of_array(const Array& array)
{
    if constexpr (Is<Array, Points>)
        return static_cast<std::uint64_t>(array.rows());
    else if constexpr (IsOptional<const Array>)
        return array.has_value() ? 1 : 0;
    else
        return static_cast<std::uint64_t>(array.size());
}

/// Computes the checksum of values.
class ChecksumArchive {
  public:
    template <class Number>
    void numbers(std::span<const Number> numbers)
    {
        checksum_.add(std::as_bytes(numbers));
    }

    template <class Number>
    void number(const Number& number)
    {
        numbers(std::span<const Number>(&number, 1));
    }

    template <class Array>
    void size(const Array& array)
    {
        number(size_of_array(array));
    }

    /// The checksum of all values so far.
    [[nodiscard]] std::uint64_t checksum() const { return checksum_.value(); }

  private:
    Checksum checksum_;
};

/// The checksum of values, as in a file.
template <class... Value>
std::uint64_t checksum_of(const Value&... values)
{
    ChecksumArchive archive;
    (transfer(archive, values), ...);
    return archive.checksum();
}

}  // namespace seamflow
