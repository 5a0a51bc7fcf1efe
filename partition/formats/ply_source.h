#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "partition/formats/ply_header.h"
#include "partition/io/byte_scanner.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

/// The numbers of a text PLY file, one after another; an element is a line. All functions throw InputError, naming the
/// line, if the file holds something else.
class PlyTextSource {
  public:
    /// @param after_header stands at the last line of the header.
    explicit PlyTextSource(const TextScanner& after_header)
        : scanner_(after_header)
    {
    }

    [[nodiscard]] const InputPosition& position() const { return scanner_; }
    void note_faults_in(FaultLog* log) { scanner_.note_faults_in(log); }

    /// To be called before the properties of element i, numbered from 0, are read.
    void begin_element(const PlyElement& element, std::uint64_t i);
    void end_element();

    /// The next number, which is finite, unless faults are noted. In text its type does not matter.
    double real(PlyType) { return scanner_.real("a coordinate"); }

    /// The next number, be it finite or not; what is none is NaN.
    double number(PlyType) { return scanner_.number_or_nan(); }

    /// The characters of the next number.
    std::string_view peek(PlyType) { return scanner_.peek(); }

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
    /// @param file the whole file; has to outlive the source.
    /// @param begin of the data in the file.
    PlyBinarySource(const std::filesystem::path& path, std::string_view file, std::size_t begin, Encoding encoding);

    [[nodiscard]] const InputPosition& position() const { return scanner_; }
    void note_faults_in(FaultLog* log) { scanner_.note_faults_in(log); }

    void begin_element(const PlyElement& element, std::uint64_t i) { scanner_.enter(element.name, i); }
    void end_element() {}
    double real(PlyType type);
    double number(PlyType type);
    std::string_view peek(PlyType type) const { return scanner_.peek(size_in_bytes(type)); }
    std::int64_t integer(PlyType type);
    void pass_over(PlyType type, std::int64_t n);

    /// Checks that n numbers can follow.
    void require_room(PlyType type, std::int64_t n) const;

    void finish() { scanner_.require_end(); }

  private:
    ByteScanner scanner_;
};

}  // namespace seamflow
