#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "tests/support/messages.h"

namespace seamflow::test {

/// Reads a mesh from a file of this name and content.
MeshFile read_text(const std::string& name, std::string_view content);

/// The message with which reading a file of this name and content fails, without the folder; empty if it succeeds.
std::string complaint_about(const std::string& name, std::string_view content);

/// The message with which writing fails, without the folder; empty if it succeeds.
std::string complaint_of_writing(const PolygonMesh& mesh, const std::string& name, const FileKind& kind);

/// Writes and reads again.
MeshFile round_trip(const PolygonMesh& mesh, const std::string& name, const FileKind& kind);

/// A file that was written in the form of another.
struct Rewritten {
    std::string content;
    std::vector<std::string> remarks;
};

/// Reads a file of this name and content, changes the positions and writes it again in its own form.
Rewritten rewritten(const std::string& name, std::string_view content, const std::function<void(Points&)>& change);

/// Whether all bits of the coordinates, and all faces, are the same.
bool identical(const PolygonMesh& a, const PolygonMesh& b);

/// Vertices whose coordinates are hard to write down: denormal, huge, signed zeros, not representable in decimal.
/// @param single_precision whether all of them are floats.
Points tricky_points(bool single_precision);

PolygonMesh make_mesh(const Points& vertices, std::initializer_list<std::initializer_list<Index>> faces);

/// Leaves all vertices where they are.
inline void stay_put(Points&) {}

/// Moves the second vertex.
inline void move_second(Points& points)
{
    points.row(1) << 2, 0.1, 0;
}

/// One triangle.
PolygonMesh make_triangle();

/// The text with the first `old` in it exchanged.
inline std::string with(const std::string& text, std::string_view old, std::string_view now)
{
    const auto begin = text.find(old);
    return text.substr(0, begin).append(now).append(text.substr(begin + old.size()));
}

}  // namespace seamflow::test
