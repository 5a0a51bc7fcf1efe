#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partition/formats/file_fields.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/ply_slices.h"
#include "partition/io/byte_writer.h"
#include "partition/io/fault_log.h"
#include "partition/io/text_scanner.h"
#include "partition/polygon_mesh.h"

/// PLY files of which only some of the vertices and faces are read, or written.
namespace seamflow {

/// A binary file and where its elements begin.
class PlyRanges {
  public:
    /// @param content the whole file, which is not text (see slice_ply_text) and of which only the parts asked for are
    /// read. Must outlive this object.
    /// @throws InputError as read_ply; also for files whose vertices have no fixed place: with lists in vertices, or
    ///         with faces before them.
    PlyRanges(std::filesystem::path path, std::string_view content);

    /// A file of another format with such elements.
    /// @param begin of the elements in the file.
    /// @throws InputError, with no useful message, if some vertices are missing.
    PlyRanges(std::filesystem::path path, std::string_view content, PlyHeader header, std::size_t begin);
    PlyRanges(const PlyRanges&) = delete;
    PlyRanges& operator=(const PlyRanges&) = delete;
    ~PlyRanges() = default;

    [[nodiscard]] const PlyHeader& header() const { return header_; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::string_view content() const { return content_; }
    [[nodiscard]] const PlyElement& vertex_element() const { return *header_.element("vertex"); }
    [[nodiscard]] Index n_vertices() const { return static_cast<Index>(vertex_element().count); }
    [[nodiscard]] Index n_faces() const { return faces_ != nullptr ? static_cast<Index>(faces_->count) : 0; }

    /// The bytes before the first element, and those from there to the vertices.
    [[nodiscard]] std::string_view header_bytes() const { return content_.substr(0, elements_begin_); }
    [[nodiscard]] std::string_view bytes_before_vertices() const
    {
        return content_.substr(elements_begin_, vertices_begin_ - elements_begin_);
    }
    /// The bytes of the vertices from `begin` to `end` - 1.
    [[nodiscard]] std::string_view bytes_of_vertices(Index begin, Index end) const
    {
        return content_.substr(vertices_begin_ + at(begin) * vertex_bytes_, at(end - begin) * vertex_bytes_);
    }

    /// The positions of the vertices from `begin` to `end` - 1.
    /// @throws InputError naming element and byte.
    [[nodiscard]] Points vertices(Index begin, Index end) const;

    /// The byte at which a face begins if all those before it are triangles.
    [[nodiscard]] std::size_t likely_begin(Index face) const { return faces_begin_ + at(face) * triangle_bytes_; }

    /// Where the faces from `begin` to `end` - 1 end, if the first of them begins at that byte.
    /// @throws InputError, with no useful message, if some are missing.
    [[nodiscard]] std::size_t end_of_faces(std::size_t byte, Index begin, Index end) const;

    /// The faces themselves, with corners numbered in the whole file.
    /// @param faults collects the faces left out, numbered from 0 for `begin`.
    /// @throws InputError naming element and byte.
    [[nodiscard]] PolygonMesh faces(std::size_t byte, Index begin, Index end, FaultLog& faults) const;

    /// Checks what follows the last face.
    /// @param byte where that ends.
    /// @throws InputError naming element and byte.
    void require_end(std::size_t byte) const;

  private:
    void find_elements();

    std::filesystem::path path_;
    std::string_view content_;
    PlyHeader header_;
    const PlyElement* faces_ = nullptr;
    std::size_t elements_begin_ = 0;
    std::size_t vertices_begin_ = 0;
    std::size_t vertex_bytes_ = 0;
    std::size_t faces_begin_ = 0;
    std::size_t triangle_bytes_ = 0;
};

/// Reads fields of some of the vertices.
/// @param names see read_fields. @returns rows for those from `begin` to `end` - 1.
/// @throws InputError as read_fields.
FileFields read_ply_fields(const PlyRanges& ply, std::span<const std::string> names, Index begin, Index end);

/// How one property of the vertices changes when a file is rewritten. Changes beyond the last property are properties
/// that are added.
struct PlyChange {
    /// 0 to 2: it is a coordinate; 3 to 5: one of the normal; from 6 on: a column of FileFields; -1: it stays.
    Index column = -1;
    /// The type of the number in the file that is written.
    PlyType type = PlyType::Float64;
};

/// Whether the properties x, y and z can hold the coordinates, floats after rounding.
std::array<bool, 3> coordinates_fit(const PlyElement& vertices, const Points& positions);

/// One change for each property: positions are replaced, normals are not.
/// @param fits of all positions: where false, the property becomes double.
std::vector<PlyChange> changes_of_positions(const PlyElement& vertices, const std::array<bool, 3>& fits);

/// One change for each property: fields replace those of their names, and positions stay.
/// @param fields with values that have the extremes, and NaN if there are any, of those to write; the file has
///        properties of all names.
/// @param target the file to write. @param remarks gets sentences for the user.
/// @throws OutputError for NaN in a property of whole numbers.
std::vector<PlyChange> changes_of_fields(const PlyElement& vertices, const FileFields& fields,
                                         const std::filesystem::path& target, std::vector<std::string>& remarks);

/// Writes the header with the types that have changed.
/// @returns remarks for the user, in sentences.
std::vector<std::string> rewrite_ply_header(ByteWriter& file, const std::filesystem::path& path,
                                            std::string_view header, const PlyElement& vertices,
                                            const std::vector<PlyChange>& changes);

/// Writes some vertices of a binary file with other positions.
/// @param positions those of the vertices from `begin` on.
/// @returns whether positions were rounded.
bool rewrite_ply_vertices(ByteWriter& file, const PlyRanges& ply, Index begin, const Points& positions,
                          const std::vector<PlyChange>& changes);

/// The same with other fields.
/// @param fields #V by n: those of the vertices from `begin` on. @param changes see changes_of_fields.
void rewrite_ply_fields(ByteWriter& file, const PlyRanges& ply, Index begin, const Eigen::MatrixXd& fields,
                        const std::vector<PlyChange>& changes);

/// Writes a slice of a text file with other positions.
/// @param after_header of the file. @param positions from vertex `first` of the file on.
void rewrite_ply_text(ByteWriter& file, const TextScanner& after_header, const PlyHeader& header, const PlySlice& slice,
                      const Points& positions, Index first);

/// Whether a face has more than 255 sides: then all corner lists store their lengths in four bytes, else in one.
bool has_long_face(const PolygonMesh& mesh);

/// Element counts of a file.
struct PlyCounts {
    Index vertices = 0;
    Index faces = 0;
    bool has_long_face = false;
};

/// The header of a file as write_labelled_ply makes it.
std::string labelled_ply_header(const PlyCounts& counts);

/// Writes some of the vertices of such a file, 24 bytes each.
void write_ply_vertices(ByteWriter& file, const PolygonMesh& mesh, Index begin, Index end);

/// Writes some of the faces of such a file.
/// @param labels #F.
void write_labelled_ply_faces(ByteWriter& file, const PolygonMesh& mesh, std::span<const Index> labels,
                              bool has_long_face, Index begin, Index end);

}  // namespace seamflow
