#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/state/transfer.h"
#include "partition/io/output_file.h"

/// Files that hold structs, bit for bit. A file is: a line that names its kind; the format, which reads differently on
/// machines of another byte order; the version of this library; the fields of the struct in the order of `fields`,
/// arrays after their sizes; the checksum of all these.
namespace seamflow {

/// @throws InputError naming the file, the reason and a remedy.
[[noreturn]] void refuse_archive(const std::filesystem::path& file, const std::string& reason);

/// Writes values to a file (see transfer).
class ArchiveWriter {
  public:
    /// @param line the first line, which names the kind of the file.
    ArchiveWriter(const std::filesystem::path& path, std::string_view line);

    /// Writes numbers byte for byte.
    template <class Number>
    void numbers(std::span<const Number> numbers)
    {
        checksum_.numbers(numbers);
        const auto bytes = std::as_bytes(numbers);
        file_.text({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }

    template <class Number>
    void number(const Number& number)
    {
        numbers(std::span<const Number>(&number, 1));
    }

    /// Writes the size of an array.
    template <class Array>
    void size(const Array& array)
    {
        number(size_of_array(array));
    }

    /// Writes the checksum and completes the file.
    void commit()
    {
        number(checksum_.checksum());
        file_.commit();
    }

  private:
    OutputFile file_;
    ChecksumArchive checksum_;
};

/// Reads values from a file. An array takes no more memory than the length of the file allows, whatever size the file
/// gives.
class ArchiveReader {
  public:
    /// Opens the file, and checks its first line, its format and version, and its checksum.
    /// @param line as for ArchiveWriter. @throws as read_archive.
    ArchiveReader(const std::filesystem::path& path, std::string_view line);

    /// Reads numbers byte for byte.
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

    /// Reads the size of an array, and gives the array this size.
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
    /// A lower bound of the bytes that an element takes that is no number.
    static constexpr std::size_t least_bytes_of_struct = 16;

    /// Reads the number of elements of an array.
    /// @param bytes_each the least number of bytes that an element takes.
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
