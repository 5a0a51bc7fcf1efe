#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// Which corners of the faces of an OBJ file name each of its normals.
struct ObjNormals {
    /// #normals + 1; the corners that name normal i are corners[offsets[i]] and so on, in ascending order.
    std::vector<Index> offsets{0};
    /// Numbered as in PolygonMesh::face_vertices.
    std::vector<Index> corners;

    [[nodiscard]] Index size() const { return static_cast<Index>(offsets.size()) - 1; }

    [[nodiscard]] std::span<const Index> corners_of(Index normal) const
    {
        const std::size_t begin = at(offsets[normal]);
        return std::span<const Index>(corners).subspan(begin, at(offsets[normal + 1]) - begin);
    }
};

/// Reads the lines `vn` and `f` of a file that `read_obj` has read. Numbers of normals that there are not do not count.
/// @param path for messages only.
ObjNormals read_obj_normals(const std::filesystem::path& path, std::string_view text);

}  // namespace seamflow
