#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "partition/formats/ply_header.h"
#include "partition/io/byte_scanner.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

/// The order of the bytes in a binary file.
inline std::endian order_of(Encoding encoding)
{
    return encoding == Encoding::BinaryBigEndian ? std::endian::big : std::endian::little;
}

/// The numbers of a text PLY file, one after another; an element is a line. All functions throw InputError, naming the
/// line, if the file holds something else.
class PlyTextSource {
  public:
    /// @param scanner stands before the first line, that is, at the last line of the header.
    explicit PlyTextSource(const TextScanner& scanner)
        : scanner_(scanner)
    {
    }

    [[nodiscard]] const InputPosition& position() const { return scanner_; }
    void note_faults_in(FaultLog* log) { scanner_.note_faults_in(log); }

    /// To be called before the properties of element i, numbered from 0, are read.
    void begin_element(const PlyElement& element, std::uint64_t i);
    void end_element();

    /// The next number, which is finite, unless faults are noted. In text its type does not matter.
    double real(PlyType) { return scanner_.real("a coordinate"); }

    /// The next number, finite or not; NaN if it is none.
    double number(PlyType) { return scanner_.number_or_nan(); }

    /// The next number of a field (see FileFields), which is not infinite.
    /// @param name of the field, in messages.
    double field(PlyType, const char* name) { return scanner_.real_or_nan(name); }

    /// The characters of the next number.
    std::string_view peek(PlyType) { return scanner_.peek(); }

    /// The place behind the number before: no characters.
    [[nodiscard]] std::string_view behind() const { return scanner_.rest_of_token().substr(0, 0); }

    std::int64_t integer(PlyType) { return scanner_.integer("a whole number"); }

    /// Passes over n numbers.
    void pass_over(PlyType, std::int64_t n);

    /// Nothing to check: even the longest list ends with its line.
    void require_room(PlyType, std::int64_t) const {}

    /// To be called after the last element.
    void finish();

  private:
    TextScanner scanner_;
};

/// The numbers of a binary PLY file, one after another. Has the functions of PlyTextSource; InputError names element
/// and byte.
class PlyBinarySource {
  public:
    /// @param path for messages only.
    /// @param file the whole file; must outlive the source.
    /// @param begin of the data in the file.
    PlyBinarySource(const std::filesystem::path& path, std::string_view file, std::size_t begin, Encoding encoding);

    [[nodiscard]] const InputPosition& position() const { return scanner_; }
    void note_faults_in(FaultLog* log) { scanner_.note_faults_in(log); }

    void begin_element(const PlyElement& element, std::uint64_t i) { scanner_.enter(element.name, i); }
    void end_element() {}
    double real(PlyType type);
    double number(PlyType type);
    double field(PlyType type, const char* name);
    std::string_view peek(PlyType type) const { return scanner_.peek(size_in_bytes(type)); }
    [[nodiscard]] std::string_view behind() const { return scanner_.peek(0); }
    std::int64_t integer(PlyType type);
    void pass_over(PlyType type, std::int64_t n);

    /// Checks that n numbers can follow.
    void require_room(PlyType type, std::int64_t n) const;

    void finish() { scanner_.require_end(); }

  private:
    ByteScanner scanner_;
};

/// Reads the length of a list.
/// @param what is to be exported again if it is negative.
template <class Source>
std::int64_t read_length(Source& source, const PlyProperty& property, const char* what = "mesh")
{
    const std::int64_t n = source.integer(*property.length_type);
    if (n < 0)
        source.position().fail("the length of the list " + in_quotes(property.name) + " is " + std::to_string(n) +
                               "; export the " + what + " again");
    source.require_room(property.type, n);
    return n;
}

/// Passes over a property of one element. @param what see read_length.
template <class Source>
void pass_over(Source& source, const PlyProperty& property, const char* what = "mesh")
{
    source.pass_over(property.type, property.length_type ? read_length(source, property, what) : 1);
}

/// Passes over element i. @param what see read_length.
template <class Source>
void pass_over(Source& source, const PlyElement& element, std::uint64_t i, const char* what = "mesh")
{
    source.begin_element(element, i);
    for (const PlyProperty& property : element.properties)
        pass_over(source, property, what);
    source.end_element();
}

/// Whether a text file does not have one line per element, so that line ends only count as blanks.
/// @param after_header stands at the last line of the header.
bool breaks_lines_freely(const TextScanner& after_header, const PlyHeader& header);

/// Calls `read` with the source of what follows the header.
/// @param after_header stands at the last line of the header. @param file the whole file.
auto with_source(const TextScanner& after_header, const std::filesystem::path& path, std::string_view file,
                 const PlyHeader& header, const auto& read)
{
    if (header.encoding != Encoding::Ascii)
        return read(PlyBinarySource(path, file, file.size() - after_header.rest().size(), header.encoding));
    TextScanner scanner = after_header;
    if (breaks_lines_freely(after_header, header))
        scanner.cross_lines();
    return read(PlyTextSource(scanner));
}

}  // namespace seamflow
