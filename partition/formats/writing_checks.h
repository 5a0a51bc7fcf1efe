#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"

/// Checks for the writers of several formats that a format can hold a mesh.
namespace seamflow {

/// The remedy "write .obj, .off or .ply, which can hold this mesh".
std::string write_polygons_instead();

/// Checks that single precision can hold all coordinates.
/// @param path of the file to write. @param format "glTF" and so on. @param remedy what to do.
/// @throws OutputError naming the vertex.
void require_floats(const std::filesystem::path& path, const Points& vertices, const Executor& exec,
                    std::string_view format, const std::string& remedy = write_polygons_instead());

/// Checks that all faces are triangles.
/// @throws OutputError naming the face.
void require_triangles(const std::filesystem::path& path, const PolygonMesh& mesh, std::string_view format);

}  // namespace seamflow
