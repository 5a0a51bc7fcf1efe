#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partition/formats/file_fields.h"
#include "partition/index_lists.h"
#include "partition/io/fault_log.h"
#include "partition/io/output_file.h"
#include "partition/io/slices.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Reads Wavefront OBJ: the lines `v` (further numbers, a weight or a colour, are passed over) and `f` (texture
/// coordinates and normals of the corners are passed over). All other lines, among them points and polylines, are
/// passed over: they describe no polygon.
/// @param path for messages only. @param faults if not null, collects faults instead of throwing.
/// @throws InputError naming the line.
PolygonMesh read_obj(const std::filesystem::path& path, std::string_view text, const Slicing& slicing,
                     FaultLog* faults = nullptr);

/// Writes Wavefront OBJ.
/// @throws OutputError
void write_obj(OutputFile& file, const PolygonMesh& mesh, const Slicing& slicing);

/// Rewrites a file read by `read_obj`, with the positions of `mesh` in the lines `v`: coordinates that are bitwise
/// equal and everything else keep their characters. Normals (`vn`) that only one vertex or one face uses become those
/// of its faces that name them; others stay.
/// @param path of the text, for messages only. @param mesh with the faces of the file.
/// @param fields the new colours of the vertices, by the names red, green, blue and alpha.
/// @param seam_distance across seams of this width (see weld), in length, shading that was continuous stays so.
/// @returns remarks for the user, in sentences.
/// @throws OutputError
std::vector<std::string> rewrite_obj(OutputFile& file, const std::filesystem::path& path, std::string_view text,
                                     const PolygonMesh& mesh, const Slicing& slicing, const FileFields& fields = {},
                                     double seam_distance = 0.0);

/// Reads the colours of the vertices, the numbers behind their coordinates, as fields; see fields_of_colours.
/// @param path for messages only.
/// @throws InputError naming the line of a vertex without colour.
FileFields read_obj_fields(const std::filesystem::path& path, std::string_view text, std::span<const std::string> names,
                           const Slicing& slicing);

/// For each normal (`vn`) of a file read by `read_obj`: the corners that name it, numbered as in
/// PolygonMesh::face_vertices, in ascending order. Corners that name missing normals are not listed.
/// @param path for messages only.
IndexLists corners_of_obj_normals(const std::filesystem::path& path, std::string_view text,
                                  const Slicing& slicing = {});

/// Content besides the surface, in a few words each; comments do not count.
/// @param path for messages only.
std::vector<std::string> extras_of_obj(const std::filesystem::path& path, std::string_view text,
                                       const Slicing& slicing = {});

}  // namespace seamflow
