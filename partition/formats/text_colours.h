#pragma once

#include <array>
#include <filesystem>
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

/// #V by 4. The alpha of a colour that has none is 0.
using TextColours = Eigen::Matrix<double, Eigen::Dynamic, colour_names.size()>;

/// Reads the colours in an OBJ file: the numbers behind the coordinates in the lines `v`.
/// @param path for messages only. @param n_components 3, or 4: all colours must have alpha.
/// @throws InputError naming the line of a vertex without colour.
TextColours read_obj_colours(const std::filesystem::path& path, std::string_view text, Index n_components,
                             const Slicing& slicing);

/// The same for an OFF file, in text, whose keyword has a C.
/// @throws InputError naming the line; also for other keywords.
TextColours read_off_colours(const std::filesystem::path& path, std::string_view text, Index n_components,
                             const Slicing& slicing);

/// Those of some names, as fields.
/// @throws InputError also for other names than colour_names and their groups; see names_of_fields.
FileFields read_obj_fields(const std::filesystem::path& path, std::string_view text, std::span<const std::string> names,
                           const Slicing& slicing);
FileFields read_off_fields(const std::filesystem::path& path, std::string_view text, std::span<const std::string> names,
                           const Slicing& slicing);

/// The colours of `fields` for a text file.
class NewColours {
  public:
    /// None.
    NewColours() = default;

    /// @param target the file to write. @param fields must outlive this object.
    /// @param read gives the colours that the file has, for a number of components as above.
    /// @throws OutputError for fields that are no colours, and for NaN.
    NewColours(const std::filesystem::path& target, const FileFields& fields, const auto& read)
        : fields_(&fields)
    {
        require_colours(target, fields);
        for (Index k = 0; k < static_cast<Index>(colour_names.size()); ++k)
            columns_[k] = fields.column(colour_names[k]);
        if (has_any())
            find_scale(read(columns_.back() >= 0 ? 4 : 3));
    }

    [[nodiscard]] bool has_any() const { return columns_ != no_columns; }

    /// Replaces the colour of vertex v.
    /// @param scanner stands before it. @param n_behind how many numbers of the line follow the colour.
    void exchange(TextScanner& scanner, Splicer& splicer, Index v, std::size_t n_behind = 0) const;

    /// Sentences for the user: colours that are kept within their range.
    [[nodiscard]] std::vector<std::string> remarks() const;

  private:
    static void require_colours(const std::filesystem::path& target, const FileFields& fields);
    /// Colours are whole numbers if all those of the file are and some exceed 1. They reach from 0 to 255, or to the
    /// largest of the file.
    void find_scale(const TextColours& written);

    static constexpr std::array<Index, colour_names.size()> no_columns = {-1, -1, -1, -1};
    const FileFields* fields_ = nullptr;
    std::array<Index, colour_names.size()> columns_ = no_columns;
    /// Nothing if colours are not whole.
    std::optional<double> largest_;
};

}  // namespace seamflow
