#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "partition/formats/mesh_file.h"
#include "partition/io/byte_writer.h"
#include "partition/io/fault_log.h"
#include "partition/io/output_file.h"
#include "partition/io/slices.h"
#include "partition/io/text_scanner.h"
#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Reads STL: as binary if the size of the file matches the count of facets in a binary file, whatever it begins with;
/// as text if it begins with the word `solid` and has no byte 0 near its beginning; else as binary. Corners with equal
/// coordinates become one vertex, numbered in order of appearance; normals, names and attributes are skipped (see
/// StlForm), and several solids become one mesh. After the facets of a binary file only padding (zeros, blanks, line
/// ends) is accepted.
/// @param path for messages only. @param faults if not null, collects faults instead of throwing.
/// @throws InputError naming line, or facet and byte; also for a facet of which two corners coincide.
MeshFile read_stl(const std::filesystem::path& path, std::string_view file, const Slicing& slicing,
                  FaultLog* faults = nullptr);

/// Reads text, as above.
/// @param text begins with `solid`.
PolygonMesh read_text_stl(const std::filesystem::path& path, std::string_view text, const Slicing& slicing,
                          FaultLog* faults);

/// A binary file begins with a title and the number of facets, each with a normal, three corners and an attribute.
constexpr std::size_t stl_header_bytes = 84;
constexpr std::size_t stl_facet_bytes = 50;

/// The bytes of the facets of a binary file, which has all of them.
std::string_view stl_facets(std::string_view file);

/// Slices of a text that begin at facets, except for the first.
std::vector<std::string_view> stl_slices_at_facets(const TextScanner& whole, std::size_t bytes);

/// Whether it is text rather than binary (see read_stl).
bool is_text_stl(std::string_view file);

/// Whether `read_stl` can read it: the size is that of a binary file, or the text begins with `solid`.
bool is_stl(std::string_view file);

/// Checks that STL can hold the mesh: triangles only, no vertex without faces, and for the binary encoding all
/// coordinates within single precision. Facets with coinciding corners are written, too: they are lines, which readers
/// skip. Vertices that coincide without having a face in common become one vertex when the file is read again: STL has
/// points only, and no numbers for them.
/// @returns a remark on these.
/// @throws OutputError naming the face or vertex, and the remedy.
std::vector<std::string> require_fits_stl(const std::filesystem::path& path, const PolygonMesh& mesh,
                                          Encoding encoding);

/// The corners of a facet.
using StlFacet = std::array<Point, 3>;

/// Checks the positions of some vertices as require_fits_stl does for binary files.
/// @param first the number of the first of the vertices.
/// @throws OutputError
void require_floats(const std::filesystem::path& path, const Points& vertices, Index first = 0);

/// The corners of face f, a triangle.
StlFacet facet_of(const PolygonMesh& mesh, Index f);

/// Whether two corners are in the same place.
bool is_line(const StlFacet& facet);

/// In single precision.
StlFacet rounded(const StlFacet& facet);

/// Of unit length, in single precision; zero for a triangle without area.
Point normal_of_facet(const StlFacet& triangle);

/// Writes STL with unit normals (0 0 0 where a face has no area).
/// @pre require_fits_stl
/// @throws OutputError
void write_stl(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, const Slicing& slicing);

/// A file as the template for one with other positions. All except coordinates and normals of facets that have moved
/// stays byte for byte: names of solids, title, attributes, facets that are lines.
class StlForm {
  public:
    /// @param path for messages only. @param content of a file read by read_stl; must outlive this.
    StlForm(const std::filesystem::path& path, std::string_view content);

    [[nodiscard]] bool is_text() const { return is_text_; }

    /// The bytes before, of and after the facets; in text, all except a byte order mark counts as facets.
    [[nodiscard]] std::string_view begin() const;
    [[nodiscard]] std::string_view facets() const;
    [[nodiscard]] std::string_view end() const;

    /// Pieces of whole facets, each of about so many bytes.
    [[nodiscard]] std::vector<std::string_view> pieces(std::string_view facets, std::size_t bytes) const;

    /// How many facets of a piece are triangles, and so faces of the mesh that is read.
    [[nodiscard]] Index count(std::string_view piece) const;

    /// Writes a piece.
    /// @param facet_of the new corners of the piece's triangles, in order.
    /// @returns how many of them have become lines.
    Index rewrite(ByteWriter& file, std::string_view piece, const std::function<StlFacet(Index facet)>& facet_of) const;

  private:
    template <class Visit>
    void walk(std::string_view piece, Visit&& visit) const;

    TextScanner whole_;
    std::string_view content_;
    bool is_text_;
};

/// See write_mesh_like.
std::vector<std::string> rewrite_stl(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh, const Slicing& slicing);

/// A sentence, if there are any, on triangles that have become lines.
std::vector<std::string> remarks_on_lines(const std::filesystem::path& path, std::int64_t n);

/// See extras_of.
std::vector<std::string> extras_of_stl(const std::filesystem::path& path, std::string_view content,
                                       const Slicing& slicing);

}  // namespace seamflow
