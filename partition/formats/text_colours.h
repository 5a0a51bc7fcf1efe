#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partition/formats/file_fields.h"
#include "partition/formats/splicing.h"
#include "partition/io/slices.h"
#include "partition/io/text_scanner.h"

/// Colours of the vertices in text files: three numbers of their lines, or four with alpha.
namespace seamflow {

inline constexpr std::array<std::string_view, 4> colour_names = {"red", "green", "blue", "alpha"};

/// #V by 4: red, green, blue, alpha. The alpha of a colour without alpha is 0.
using TextColours = Eigen::Matrix<double, Eigen::Dynamic, colour_names.size()>;

/// A visitor for scan_vertex that reads the colours of vertices. Several threads may use one reader.
struct ColourReader {
    /// One row per vertex.
    TextColours& colours;
    /// 3; or 4 if all colours must have alpha.
    Index n_components;

    /// @throws InputError for a vertex with fewer than n_components numbers of a colour, or more than four, or one that
    /// is not finite.
    void colour(Index v, TextScanner& scanner, std::size_t n_behind) const;
};

/// Reads the slices of a text, several at a time. If they have a fault, reads them again in one, for a message with the
/// line.
/// @param read called with slices and an executor.
TextColours read_text_colours(const TextScanner& after_header, const Slicing& slicing, const auto& read)
{
    return read_in_slices_if_faultless([&] { return read(after_header.slices(slicing.bytes), slicing.exec); },
                                       [&] { return read({after_header.rest()}, Executor(run_serially)); });
}

/// The colours of a file as fields.
/// @param read gives the colours of a file, for a number of components (see ColourReader).
/// @throws InputError also for other names than colour_names and their groups; see names_of_fields.
FileFields fields_of_colours(const std::filesystem::path& path, std::span<const std::string> names,
                             const std::function<TextColours(Index n_components)>& read);

/// The new colours of a text file.
class NewColours {
  public:
    /// @param target the file to write. @param fields with colours; must outlive this object.
    /// @param read gives the colours of the file that was read (see fields_of_colours).
    /// @throws OutputError for fields that are no colours, and for NaN.
    NewColours(const std::filesystem::path& target, const FileFields& fields,
               const std::function<TextColours(Index n_components)>& read);

    [[nodiscard]] bool has_any() const { return columns_ != no_columns; }

    /// Replaces the colour of vertex v.
    /// @param scanner at the colour. @param n_behind the number of numbers of the line that follow the colour.
    void exchange(TextScanner& scanner, Splicer& splicer, Index v, std::size_t n_behind) const;

    /// Sentences for the user on colours that were clamped to their range.
    [[nodiscard]] std::vector<std::string> remarks() const;

  private:
    static constexpr std::array<Index, colour_names.size()> no_columns = {-1, -1, -1, -1};
    const FileFields& fields_;
    std::array<Index, colour_names.size()> columns_ = no_columns;
    /// The largest value of a colour if colours are whole numbers: all colours of the file are whole and some exceed 1.
    /// It is 255, or the largest value in the file if that is larger. Nothing if colours are not whole.
    std::optional<double> largest_;
};

/// A visitor for scan_vertex that writes the vertices of a file, or a slice of it, with new data.
struct VertexRewriter {
    Splicer splicer;
    const Points& positions;
    const NewColours& colours;
    /// Returns the new value of the n-th normal, which is `given` in the file; nothing: the normal does not change.
    std::function<std::optional<Point>(Index n, const Point& given)> new_normal;

    void plain_vertex(Index v, const WrittenNumbers& given) { exchange_position(splicer, given, positions.row(v)); }
    void position(Index v, TextScanner& scanner) { plain_vertex(v, read_position(scanner)); }
    void normal(Index n, TextScanner& scanner)
    {
        const WrittenNumbers given = read_normal(scanner);
        if (const std::optional<Point> now = new_normal(n, given.values))
            exchange_normal(splicer, given, *now);
    }
    void colour(Index v, TextScanner& scanner, std::size_t n_behind)
    {
        colours.exchange(scanner, splicer, v, n_behind);
    }
};

}  // namespace seamflow
