#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "partition/formats/mesh_file.h"
#include "partition/io/fault_log.h"
#include "partition/io/input_file.h"
#include "partition/io/output_file.h"
#include "partition/io/slices.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Joins a glTF 2.0 file and the buffers that it names, in other files and in `data:` URIs.
/// @param content of `file`: .glb or .gltf.
/// @returns nothing if all buffers are in the file's binary chunk; then the functions below take its own content.
/// @throws InputError naming the file and the buffer.
std::optional<OpenFile> with_gltf_buffers(const OpenFile& file, std::string_view content);

/// Reads the triangles, strips and fans of all primitives of all meshes, each mesh in its own coordinates: the
/// transforms of nodes are not applied. A set of positions that several primitives share is one set of vertices, and
/// identical primitives are one; all other content is skipped.
/// @param path for messages only. @param content of the file, or of the result of with_gltf_buffers if there is one.
/// @param faults if not null, collects faults instead of throwing.
/// @throws InputError naming the element of the file, as in `meshes[0].primitives[1].indices`; also for positions that
///         are compressed (Draco, meshopt) or quantised.
PolygonMesh read_gltf(const std::filesystem::path& path, std::string_view content, const Slicing& slicing,
                      FaultLog* faults = nullptr);

/// Checks that glTF can hold the mesh: triangles only, at least one, all coordinates within single precision, and no
/// more than 4 GiB.
/// @throws OutputError naming the face or vertex, and the remedy.
void require_fits_gltf(const std::filesystem::path& path, const PolygonMesh& mesh);

/// Writes a file of one primitive: positions (float) and triangles.
/// @param format Glb, or Gltf with the buffer in the file itself.
/// @throws OutputError
void write_gltf(OutputFile& file, const PolygonMesh& mesh, FileFormat format, const Slicing& slicing);

/// Rewrites a file read by `read_gltf` with other positions. Normals become those of the new surface, and the bounds
/// (min and max) of changed data are updated; all other bytes stay. A changed sparse accessor becomes dense: its
/// vectors are added at the end of the buffer. Buffers in other files are written to new files beside the result, never
/// over those of the input.
/// @param path of the file that was read. @param content as for read_gltf. @param mesh with the faces of the file.
/// @param seam_distance across seams of this width (see weld), in length, shading that was continuous stays so.
/// @returns remarks for the user, in sentences.
/// @throws OutputError
std::vector<std::string> rewrite_gltf(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                      const PolygonMesh& mesh, const Slicing& slicing, double seam_distance = 0.0);

/// Content besides the surface, in a few words each.
std::vector<std::string> extras_of_gltf(const std::filesystem::path& path, std::string_view content);

}  // namespace seamflow
