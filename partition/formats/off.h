#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "partition/formats/ply_header.h"
#include "partition/io/fault_log.h"
#include "partition/io/output_file.h"
#include "partition/io/slices.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Reads text OFF, a vertex or a face a line: `OFF` and its variants with normals, colours or texture coordinates
/// (NOFF, COFF, STOFF, STCNOFF, …), which are passed over as are the colours of faces; also a file that begins with the
/// three counts instead of `OFF`. A file that begins with `OFF BINARY` is read as binary (see read_binary_off).
/// @param path for messages only. @param faults where to note them instead of throwing, if not null.
/// @throws InputError naming the line or byte; also for coordinates that are not three to a vertex.
PolygonMesh read_off(const std::filesystem::path& path, std::string_view text, const Slicing& slicing,
                     FaultLog* faults = nullptr);

/// Writes text OFF.
/// @throws OutputError
void write_off(OutputFile& file, const PolygonMesh& mesh, const Slicing& slicing);

/// Writes a file again that `read_off` has read, with the positions of `mesh`: in a text, coordinates that are the
/// same, bit for bit, and everything else but normals keep their characters; binary files hold floats.
/// @param path of the content, for messages only. @param mesh with the faces of the file.
/// @returns what a user should know about it, in sentences.
/// @throws OutputError; also for coordinates beyond single precision in a binary file.
std::vector<std::string> rewrite_off(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh, const Slicing& slicing);

/// What such a file holds besides a surface, in a few words each; comments do not count.
/// @param path for messages only.
std::vector<std::string> extras_of_off(const std::filesystem::path& path, std::string_view content);

/// Where the data begin if the first line is `OFF BINARY`, else nothing.
std::optional<std::size_t> start_of_binary_off(std::string_view content);

/// Reads what follows the line `OFF BINARY`: 32-bit integers and floats. Geomview writes them most significant byte
/// first and a number of colour components after each face, others the other way round or without: whichever of the
/// four fits the length of the file is taken.
/// @param path for messages only. @param faults see read_off.
/// @param file the whole file.
/// @param offset where the binary data begin.
/// @throws InputError naming the byte.
PolygonMesh read_binary_off(const std::filesystem::path& path, std::string_view file, std::size_t offset,
                            const Slicing& slicing, FaultLog* faults);

/// How many bytes of counts precede the vertices of such a file.
inline constexpr std::size_t binary_off_counts_bytes = 12;

/// The four layouts in their order, each as the header of a binary PLY file whose elements are the same bytes, from
/// behind the counts on; none for a file that is too short for counts.
std::vector<PlyHeader> layouts_of_binary_off(std::string_view file, std::size_t offset);

/// Says that none of them fits.
/// @throws InputError naming the byte.
[[noreturn]] void refuse_binary_off(const std::filesystem::path& path, std::string_view file, std::size_t offset);

/// Checks that floats can hold some vertices. @param first the number of the first of them.
/// @throws OutputError
void require_fits_binary_off(const std::filesystem::path& path, const Points& vertices, Index first,
                             const Executor& exec);

/// Writes such a file again, with the positions of `mesh`, rounded to floats; every other byte stays.
/// @param mesh with the faces of the file.
/// @returns whether rounding changed any coordinate.
/// @throws OutputError; also for coordinates beyond single precision.
bool rewrite_binary_off(OutputFile& output, std::string_view file, std::size_t offset, const PolygonMesh& mesh,
                        const Slicing& slicing);

}  // namespace seamflow
