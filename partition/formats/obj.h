#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partition/index_lists.h"
#include "partition/io/fault_log.h"
#include "partition/io/output_file.h"
#include "partition/io/slices.h"
#include "partition/io/text_scanner.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

inline constexpr TextSyntax obj_syntax = {.comment = '#', .continuation = true};

/// Whether a line that begins with this word describes a face.
inline bool is_obj_face(std::string_view keyword)
{
    return keyword.starts_with('f') && (keyword.size() == 1 || keyword == "fo");
}

/// What stands before a slice of a file.
struct ObjCounts {
    Index n_vertices = 0;
    /// Lines `vn`.
    Index n_normals = 0;

    friend bool operator==(const ObjCounts&, const ObjCounts&) = default;
};

/// The counts before each slice of a file and, at the end, those of all of it.
/// @throws InputError if there are more than 2^31 - 1 of a kind.
std::vector<ObjCounts> count_obj(const TextScanner& whole, std::span<const std::string_view> slices, const Loop& loop);

/// Reads some slices of a file.
/// @param counts what stands before each of them, in the whole file, and behind the last.
/// @param n_vertices of the whole file.
/// @returns the vertices of these slices, and their faces with corners numbered in the whole file.
/// @throws InputError if there is any fault, not necessarily naming the line (see faults_of_obj_slice).
PolygonMesh read_obj_slices(const TextScanner& whole, std::span<const std::string_view> slices,
                            std::span<const ObjCounts> counts, Index n_vertices, const Loop& loop);

/// The first faults of a slice, as read_obj says them; empty: there are none.
struct ObjFaults {
    std::string of_line;
    /// That a vertex which a face names does not come. read_obj says so only where all lines are without fault.
    std::string of_reference;
};

/// @param scanner of the slice, which knows the number of its first line. @param counts, end what stands before the
/// slice and behind it. @param n_vertices of the whole file.
ObjFaults faults_of_obj_slice(const TextScanner& scanner, const ObjCounts& counts, const ObjCounts& end,
                              Index n_vertices);

/// Reads Wavefront OBJ: the lines `v` (further numbers, a weight or a colour, are passed over) and `f` (texture
/// coordinates and normals of the corners are passed over). All other lines, among them points and polylines, are
/// passed over: they describe no polygon.
/// @param path for messages only. @param faults where to note them instead of throwing, if not null.
/// @throws InputError naming the line.
PolygonMesh read_obj(const std::filesystem::path& path, std::string_view text, const Slicing& slicing,
                     FaultLog* faults = nullptr);

/// Writes Wavefront OBJ.
/// @throws OutputError
void write_obj(OutputFile& file, const PolygonMesh& mesh, const Slicing& slicing);

/// Writes a file again that `read_obj` has read, with the positions of `mesh` in the lines `v`: coordinates that are
/// the same, bit for bit, and everything else keep their characters. Normals (`vn`) that one vertex or one face has for
/// itself become those of its faces that name them; others stay.
/// @param path of the text, for messages only. @param mesh with the faces of the file.
/// @returns what a user should know about it, in sentences.
/// @throws OutputError
std::vector<std::string> rewrite_obj(OutputFile& file, const std::filesystem::path& path, std::string_view text,
                                     const PolygonMesh& mesh, const Slicing& slicing);

/// Writes some slices of a file again as rewrite_obj does, but with all normals as they were.
/// @param counts as of read_obj_slices. @param positions of the vertices of these slices.
/// @returns one text for each slice.
std::vector<OutputBuffer> rewrite_obj_slices(const TextScanner& whole, std::span<const std::string_view> slices,
                                             std::span<const ObjCounts> counts, const Points& positions,
                                             const Loop& loop);

/// The corners of faces, numbered as in PolygonMesh::face_vertices, that name each normal (`vn`) of a file that
/// `read_obj` has read, in ascending order. Numbers of normals that there are not do not count.
/// @param path for messages only.
IndexLists corners_of_obj_normals(const std::filesystem::path& path, std::string_view text,
                                  const Slicing& slicing = {});

/// What such a file holds besides a surface, in a few words each; comments do not count.
/// @param path for messages only.
std::vector<std::string> extras_of_obj(const std::filesystem::path& path, std::string_view text,
                                       const Slicing& slicing = {});

}  // namespace seamflow
