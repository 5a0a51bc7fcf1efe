#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/state/checksum.h"
#include "engine/state/flow_state.h"
#include "partition/io/output_file.h"

/// Files that hold structs, bit for bit. A file is: a line that names its kind; the format, which reads differently on
/// machines of another byte order; the fields of the struct in the order of `fields`, arrays after their sizes; the
/// checksum of all that.
namespace seamflow {

/// @throws InputError naming the file, the reason and what to do.
[[noreturn]] void refuse_archive(const std::filesystem::path& file, const std::string& reason);

/// Writes parts to a file.
class ArchiveWriter {
  public:
    /// @param line what the file is.
    ArchiveWriter(const std::filesystem::path& path, std::string_view line);

    template <class Number>
    void numbers(std::span<const Number> numbers)
    {
        const auto bytes = std::as_bytes(numbers);
        checksum_.add(bytes);
        file_.text({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }

    template <class Number>
    void number(const Number& number)
    {
        numbers(std::span<const Number>(&number, 1));
    }

    template <class Array>
    void size(const Array& array)
    {
        number(static_cast<std::uint64_t>(array.size()));
    }
    void size(const Points& points) { number(static_cast<std::uint64_t>(points.rows())); }
    template <class Value>
    void size(const std::optional<Value>& value)
    {
        number(static_cast<std::uint64_t>(value ? 1 : 0));
    }

    /// @returns the checksum of all.
    std::uint64_t commit()
    {
        const std::uint64_t value = checksum_.value();
        number(value);
        file_.commit();
        return value;
    }

  private:
    OutputFile file_;
    Checksum checksum_;
};

/// Reads parts from a file. An array takes no more memory than the length of the file allows, whatever size the file
/// gives.
class ArchiveReader {
  public:
    /// Checks the whole file first. @param expected its checksum, where that is known.
    ArchiveReader(const std::filesystem::path& path, std::string_view line, std::optional<std::uint64_t> expected);

    template <class Number>
    void numbers(std::span<Number> numbers)
    {
        const auto bytes = std::as_writable_bytes(numbers);
        if (bytes.size() > n_left_)
            refuse_archive(path_, "ends too early");
        n_left_ -= bytes.size();
        if (!file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
            refuse_archive(path_, "cannot be read");
    }

    template <class Number>
    void number(Number& number)
    {
        numbers(std::span(&number, 1));
    }

    template <class Array>
    void size(Array& array)
    {
        using Value = typename Array::value_type;
        array.resize(read_size(std::is_arithmetic_v<Value> ? sizeof(Value) : least_bytes_of_struct));
    }
    void size(Points& points) { points.resize(static_cast<Eigen::Index>(read_size(3 * sizeof(double))), 3); }
    template <class Value>
    void size(std::optional<Value>& value)
    {
        if (read_size(1) > 0)
            value.emplace();
    }

    void require_end() const
    {
        if (n_left_ != 0)
            refuse_archive(path_, "is longer than it should be");
    }

  private:
    static constexpr std::size_t least_bytes_of_struct = 16;

    std::size_t read_size(std::size_t bytes_each)
    {
        std::uint64_t n = 0;
        number(n);
        if (n > n_left_ / bytes_each)
            refuse_archive(path_, "has an array that is longer than the file");
        return static_cast<std::size_t>(n);
    }

    std::filesystem::path path_;
    std::ifstream file_;
    /// Except for the checksum.
    std::uint64_t n_left_ = 0;
};

template <class Value, class Struct>
concept Is = std::is_same_v<std::remove_const_t<Value>, Struct>;

/// The fields of the structs of a state: all of them, or the compiler complains. Other structs have a function of their
/// own in their namespace.
auto fields(Is<FlowIdentity::Entry> auto& of)
{
    auto& [name, value] = of;
    return std::tie(name, value);
}

auto fields(Is<FlowIdentity> auto& of)
{
    auto& [entries] = of;
    return std::tie(entries);
}

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

template <class Value>
concept HasNumbers =
    Is<Value, Points> || Is<Value, std::string> || Is<Value, std::vector<double>> || Is<Value, std::vector<Index>>;

/// Writes the parts of a value to a file or reads them: values are const when they are written.
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

/// Writes a struct to a file and to the disk. The file holds all of it, or stays as it was.
/// @returns the checksum of the file.
/// @throws OutputError naming the file.
template <class Struct>
std::uint64_t write_archive(const std::filesystem::path& path, std::string_view line, const Struct& of)
{
    ArchiveWriter archive(path, line);
    transfer(archive, of);
    return archive.commit();
}

/// Reads it back.
/// @param expected its checksum, where that is known.
/// @throws InputError naming the file if it cannot be opened, is not such a file, comes from a version or a machine
///         with another format, is cut off, or has changed since it was written.
template <class Struct>
Struct read_archive(const std::filesystem::path& path, std::string_view line,
                    std::optional<std::uint64_t> expected = {})
{
    ArchiveReader archive(path, line, expected);
    Struct of;
    transfer(archive, of);
    archive.require_end();
    return of;
}

}  // namespace seamflow
