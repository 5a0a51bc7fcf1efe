#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "partition/formats/mesh_io.h"
#include "partition/io/byte_writer.h"
#include "partition/io/fault_log.h"
#include "partition/io/output_file.h"
#include "partition/io/slices.h"
#include "partition/point_numbers.h"
#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Reads STL, as binary if the size of the file is the one that the count of facets in a binary file calls for,
/// whatever it begins with; as text, if it begins with the word `solid` and holds no byte 0 early on; else as binary.
/// Corners with equal coordinates become one vertex, numbered in order of appearance; normals, names and attributes are
/// passed over, and several solids become one mesh. After the facets of a binary file only padding (zeros, blanks, line
/// ends) is accepted.
/// @param path for messages only. @param faults where to note them instead of throwing, if not null.
/// @throws InputError naming line, or facet and byte; also for a facet of which two corners coincide.
MeshFile read_stl(const std::filesystem::path& path, std::string_view file, const Slicing& slicing,
                  FaultLog* faults = nullptr);

/// A binary STL file of which a reader takes some of the facets alone.
class StlStretches {
  public:
    /// @param content the whole file, of which only what is asked for is looked at. It has to outlive this.
    /// @throws InputError as read_stl; also for text.
    StlStretches(std::filesystem::path path, std::string_view content);
    StlStretches(const StlStretches&) = delete;
    StlStretches& operator=(const StlStretches&) = delete;
    ~StlStretches() = default;

    [[nodiscard]] Index n_facets() const { return n_facets_; }

    /// The facets from `begin` to `end` - 1 as they stand there.
    [[nodiscard]] std::string_view bytes(Index begin, Index end) const;

    /// Appends the facets from `begin` to `end` - 1.
    /// @param faces without vertices; corners are numbers of the points that are returned.
    /// @throws InputError naming facet and byte.
    PointNumbers facets(Index begin, Index end, PolygonMesh& faces) const;

    /// Checks what follows the last facet, and that there is one.
    /// @throws InputError naming facet and byte.
    void require_end() const;

  private:
    std::filesystem::path path_;
    std::string_view content_;
    Index n_facets_ = 0;
};

/// Whether `read_stl` can make anything of it: the size is that of a binary file, or the text begins with `solid`.
bool is_stl(std::string_view file);

/// Checks that STL can hold the mesh: triangles only, no vertex without faces, no two corners of a face in the same
/// place, and for the binary encoding all coordinates within, and corners distinct in, single precision.
/// Vertices that coincide without having a face in common are one vertex when the file is read again: STL has points
/// only, and no numbers for them.
/// @throws OutputError naming the face or vertex, and the remedy.
void require_fits_stl(const std::filesystem::path& path, const PolygonMesh& mesh, Encoding encoding);

/// The corners of a facet.
using StlFacet = std::array<Point, 3>;

/// What require_fits_stl checks of positions for the binary encoding, of some vertices and of one facet.
/// @param first the number of the first of the vertices.
/// @throws OutputError
void require_floats(const std::filesystem::path& path, const Points& vertices, Index first = 0);
/// @param f, corners the number of the facet, and those of its vertices.
void require_distinct_floats(const std::filesystem::path& path, Index f, std::span<const Index> corners,
                             const StlFacet& facet);

/// What a binary file begins with, and one of its facets, as write_stl makes them.
void write_binary_stl_header(ByteWriter& file, Index n_faces);
void write_binary_stl_facet(ByteWriter& file, const StlFacet& facet);
inline constexpr std::size_t binary_stl_header_bytes = 84;
inline constexpr std::size_t binary_stl_facet_bytes = 50;

/// Writes STL with unit normals (0 0 0 where a face has no area).
/// @pre require_fits_stl
/// @throws OutputError
void write_stl(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, const Slicing& slicing);

}  // namespace seamflow
