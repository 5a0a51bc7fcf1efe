#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "partition/formats/mesh_file.h"
#include "partition/io/fault_log.h"
#include "partition/io/output_file.h"
#include "partition/io/slices.h"
#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Reads STL: as binary if the size of the file matches the count of facets in a binary file, whatever it begins with;
/// as text if it begins with the word `solid` and has no byte 0 near its beginning; else as binary. Corners with equal
/// coordinates become one vertex, numbered in order of appearance; normals, names and attributes are skipped (see
/// rewrite_stl), and several solids become one mesh. After the facets of a binary file only padding (zeros, blanks,
/// line ends) is accepted.
/// @param path for messages only. @param faults if not null, collects faults instead of throwing.
/// @throws InputError naming line, or facet and byte; also for a facet of which two corners coincide.
MeshFile read_stl(const std::filesystem::path& path, std::string_view file, const Slicing& slicing,
                  FaultLog* faults = nullptr);

/// Reads text STL (see read_stl).
/// @param text begins with `solid`.
PolygonMesh read_text_stl(const std::filesystem::path& path, std::string_view text, const Slicing& slicing,
                          FaultLog* faults);

/// The bytes of a binary file's header, a title and the number of facets, and of a facet: a normal, three corners and
/// an attribute.
constexpr std::size_t stl_header_bytes = 84;
constexpr std::size_t stl_facet_bytes = 50;

/// The bytes of the facets of a binary file, which has all of them.
std::string_view stl_facets(std::string_view file);

/// Whether the file is text and not binary (see read_stl).
bool is_text_stl(std::string_view file);

/// Whether `read_stl` can read the file: the size is that of a binary file, or the text begins with `solid`.
bool is_stl(std::string_view file);

/// Checks that STL can hold the mesh: triangles only, no vertex without faces, and for the binary encoding all
/// coordinates within single precision. Facets with coinciding corners are also written: they are lines, which read_stl
/// refuses or, if `faults` collects them, leaves out. Vertices that coincide without having a face in common become one
/// vertex when the file is read again, because STL has points without numbers.
/// @returns a remark on facets that become lines; none if there are no such facets.
/// @throws OutputError naming the face or vertex, and the remedy.
std::vector<std::string> require_fits_stl(const std::filesystem::path& path, const PolygonMesh& mesh,
                                          Encoding encoding);

/// The corners of a facet.
using StlFacet = std::array<Point, 3>;

/// The corners of face f, a triangle.
StlFacet facet_of(const PolygonMesh& mesh, Index f);

/// Whether two corners coincide.
bool is_line(const StlFacet& facet);

/// The facet rounded to single precision.
StlFacet rounded(const StlFacet& facet);

/// The normal of a facet: of unit length, in single precision; zero for a triangle without area.
Point normal_of_facet(const StlFacet& triangle);

/// Writes STL with unit normals (0 0 0 where a face has no area).
/// @pre require_fits_stl
/// @throws OutputError
void write_stl(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, const Slicing& slicing);

/// Rewrites a file read by read_stl with the positions of `mesh`: coordinates, and normals of facets that have moved.
/// All else stays byte for byte: names of solids, title, attributes, facets that are lines.
/// @param path for messages only. @param mesh with the faces of the file.
/// @returns a remark on facets that have become lines; none if there are no such facets.
/// @throws OutputError also for coordinates beyond single precision in a binary file.
std::vector<std::string> rewrite_stl(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh, const Slicing& slicing);

/// A sentence for the user on n triangles that have become lines; none if n is 0.
std::vector<std::string> remarks_on_lines(const std::filesystem::path& path, std::int64_t n);

/// Content besides the surface, in a few words each: names of solids, colours of the header, attributes of facets.
std::vector<std::string> extras_of_stl(const std::filesystem::path& path, std::string_view content,
                                       const Slicing& slicing);

}  // namespace seamflow
