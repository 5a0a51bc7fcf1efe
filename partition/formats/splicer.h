#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "partition/io/output_file.h"
#include "partition/io/text_scanner.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Copies the content of one file into another, with parts of it exchanged.
class Splicer {
  public:
    /// @param file, content have to outlive the splicer.
    Splicer(OutputFile& file, std::string_view content)
        : file_(file)
        , rest_(content)
    {
    }

    /// Copies what precedes `part`, a piece of the content behind all those exchanged so far, and leaves it out.
    /// @returns the file, for what is to stand in its place.
    OutputFile& exchange(std::string_view part);

    /// Copies what is left. To be called once, at the end.
    void finish() { file_.text(rest_); }

  private:
    OutputFile& file_;
    std::string_view rest_;
};

/// Whether two numbers differ in any bit: 0 and -0 do, something that is not a number and itself do not.
bool differ(double a, double b);

/// Goes past the next three numbers of the line and exchanges those that differ from the coordinates of `position`.
void exchange_position(TextScanner& scanner, Splicer& splicer, const Point& position);

/// Three numbers of a line as they stand there, whatever they are.
struct WrittenNormal {
    std::array<std::string_view, 3> parts;
    Point value;
};

/// Goes past the next three tokens of the line.
WrittenNormal read_normal(TextScanner& scanner);

/// Writes a normal, in single precision, in place of another.
void exchange_normal(Splicer& splicer, const WrittenNormal& before, const Point& after);

/// A sentence for the user of a file whose numbers hold less than the results.
/// @param source the file that decides about their type.
std::string rounding_remark(const std::filesystem::path& source);

}  // namespace seamflow
