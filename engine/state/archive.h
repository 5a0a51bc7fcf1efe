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
/// machines of another byte order; the version of this library; the fields of the struct in the order of `fields`,
/// arrays after their sizes; the checksum of all these.
namespace seamflow {

/// @throws InputError naming the file, the reason and a remedy.
[[noreturn]] void refuse_archive(const std::filesystem::path& file, const std::string& reason);

/// Writes values to a file.
class ArchiveWriter {
  public:
    /// A writer without a file, which only computes the checksum.
    ArchiveWriter() = default;

    /// @param line the kind of the file.
    ArchiveWriter(const std::filesystem::path& path, std::string_view line);

    template <class Number>
    void numbers(std::span<const Number> numbers)
    {
        const auto bytes = std::as_bytes(numbers);
        checksum_.add(bytes);
        if (file_)
            file_->text({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
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

    /// The checksum of all values written so far.
    [[nodiscard]] std::uint64_t checksum() const { return checksum_.value(); }

    /// Completes the file.
    void commit()
    {
        number(checksum());
        file_->commit();
    }

  private:
    std::optional<OutputFile> file_;
    Checksum checksum_;
};

/// Reads values from a file. An array takes no more memory than the length of the file allows, whatever size the file
/// gives.
class ArchiveReader {
  public:
    /// Opens the file and checks all of it.
    ArchiveReader(const std::filesystem::path& path, std::string_view line);

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
    /// The number of bytes left, without the checksum.
    std::uint64_t n_left_ = 0;
};

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

/// The checksum of values, as in a file.
template <class... Value>
std::uint64_t checksum_of(const Value&... values)
{
    ArchiveWriter archive;
    (transfer(archive, values), ...);
    return archive.checksum();
}

/// Writes a struct to a file and to the disk. The file holds all of it, or stays as it was.
/// @throws OutputError naming the file.
template <class Struct>
void write_archive(const std::filesystem::path& path, std::string_view line, const Struct& of)
{
    ArchiveWriter archive(path, line);
    transfer(archive, of);
    archive.commit();
}

/// Reads a struct from a file that write_archive has written.
/// @throws InputError naming the file if it cannot be opened, is not such a file, comes from a version or a machine
///         with another format, is cut off, or has changed since it was written.
template <class Struct>
Struct read_archive(const std::filesystem::path& path, std::string_view line)
{
    ArchiveReader archive(path, line);
    Struct of;
    transfer(archive, of);
    archive.require_end();
    return of;
}

}  // namespace seamflow
