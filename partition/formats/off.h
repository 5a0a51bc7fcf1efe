#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partition/formats/file_fields.h"
#include "partition/formats/off_header.h"
#include "partition/io/fault_log.h"
#include "partition/io/output_file.h"
#include "partition/io/slices.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Reads text OFF, one vertex or face per line, or with line ends that count as blanks: `OFF` and its variants with
/// normals, colours or texture coordinates (NOFF, COFF, STOFF, STCNOFF, …), which are skipped, as are the colours of
/// faces; also a file that begins with the three counts instead of `OFF`. A file that begins with `OFF BINARY` is read
/// as binary (see read_binary_off).
/// @param path for messages only. @param faults if not null, collects faults instead of throwing.
/// @throws InputError naming the line or byte; also for vertices without three coordinates.
PolygonMesh read_off(const std::filesystem::path& path, std::string_view text, const Slicing& slicing,
                     FaultLog* faults = nullptr);

/// Writes text OFF.
/// @throws OutputError
void write_off(OutputFile& file, const PolygonMesh& mesh, const Slicing& slicing);

/// Rewrites a file read by `read_off`, with the positions of `mesh`: in text, coordinates that are bitwise equal and
/// everything else except normals keep their characters; binary files hold floats.
/// @param path of the content, for messages only. @param mesh with the faces of the file.
/// @param fields the new colours of the vertices, by the names red, green, blue and alpha; none for a binary file.
/// @param seam_distance across seams of this width (see weld), in length, shading that was continuous stays so.
/// @returns remarks for the user, in sentences.
/// @throws OutputError; also for coordinates beyond single precision in a binary file.
std::vector<std::string> rewrite_off(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh, const Slicing& slicing, const FileFields& fields = {},
                                     double seam_distance = 0.0);

/// Reads the colours of the vertices of a file in text, whose keyword has a C, as fields; see fields_of_colours.
/// @param path for messages only.
/// @throws InputError naming the line of a vertex without colour; also for other files.
FileFields read_off_fields(const std::filesystem::path& path, std::string_view text, std::span<const std::string> names,
                           const Slicing& slicing);

/// Content besides the surface, in a few words each; comments do not count.
/// @param path for messages only.
std::vector<std::string> extras_of_off(const std::filesystem::path& path, std::string_view content);

/// Reads the binary data after the line `OFF BINARY`: 32-bit integers and floats. Geomview writes the most significant
/// byte first and a number of colour components after each face; other programs write the least significant byte first,
/// or no colours. Of the four layouts, the one that fits the length of the file is used.
/// @param path for messages only. @param faults if not null, collects faults instead of throwing.
/// @param file the whole file.
/// @param offset of the first binary data.
/// @throws InputError naming the byte.
PolygonMesh read_binary_off(const std::filesystem::path& path, std::string_view file, std::size_t offset,
                            const Slicing& slicing, FaultLog* faults);

/// Rewrites a binary OFF file, read by read_binary_off, with the positions of `mesh`, rounded to floats; every other
/// byte stays.
/// @param mesh with the faces of the file.
/// @returns whether rounding changed any coordinate.
/// @throws OutputError; also for coordinates beyond single precision.
bool rewrite_binary_off(OutputFile& output, std::string_view file, std::size_t offset, const PolygonMesh& mesh,
                        const Slicing& slicing);

}  // namespace seamflow
