#pragma once

#include <filesystem>
#include <string_view>

#include "partition/formats/mesh_io.h"
#include "partition/io/fault_log.h"
#include "partition/io/output_file.h"
#include "partition/io/slices.h"
#include "partition/polygon_mesh.h"

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

/// Whether `read_stl` can make anything of it: the size is that of a binary file, or the text begins with `solid`.
bool is_stl(std::string_view file);

/// Checks that STL can hold the mesh: triangles only, no vertex without faces, no two corners of a face in the same
/// place, and for the binary encoding all coordinates within, and corners distinct in, single precision.
/// Vertices that coincide without having a face in common are one vertex when the file is read again: STL has points
/// only, and no numbers for them.
/// @throws OutputError naming the face or vertex, and the remedy.
void require_fits_stl(const std::filesystem::path& path, const PolygonMesh& mesh, Encoding encoding);

/// Writes STL with unit normals (0 0 0 where a face has no area).
/// @pre require_fits_stl
/// @throws OutputError
void write_stl(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, const Slicing& slicing);

}  // namespace seamflow
