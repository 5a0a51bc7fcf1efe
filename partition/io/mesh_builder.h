#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "partition/io/input_position.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Whether there are at least three corners, all different.
/// @param sorted scratch: receives the sorted corners, if sorting is necessary.
bool are_corners_of_face(std::span<const Index> corners, std::vector<Index>& sorted);

/// Leaves out corners that repeat the previous corner, also across the end: some programs write triangles as a b c c.
/// @param positions receives the positions in `corners` that are left.
void find_distinct_corners(std::span<const Index> corners, std::vector<Index>& positions);

/// Checks that a file has a vertex.
/// @param position at the end of the file. @param n the number of vertices.
void require_vertices(const InputPosition& position, std::int64_t n);

/// The arrays for the elements of one slice of a file, or of the whole file.
struct MeshSlice {
    /// The vertices of the whole file, with all rows allocated.
    Points& vertices;
    /// The number of the first vertex of the slice.
    Index first_vertex;
    /// Receives the faces of the slice.
    PolygonMesh& faces;
};

/// Collects the vertices and faces that a reader finds, and checks each face. If faults are collected and not thrown,
/// faulty faces are left out.
class MeshBuilder {
  public:
    /// @param position of the reader, for messages; must outlive the builder.
    /// @param first_number the number of the first vertex in this format, for messages.
    MeshBuilder(const InputPosition& position, Index first_number, const MeshSlice& slice);

    MeshBuilder(const MeshBuilder&) = delete;
    MeshBuilder& operator=(const MeshBuilder&) = delete;

    void add_vertex(const std::array<double, 3>& position)
    {
        vertices_.row(n_vertices_++) << position[0], position[1], position[2];
    }

    /// Adds a face. Corners that repeat the previous corner count once.
    /// @param corners vertices from 0, which need not have been added yet, or -1 for vertices that `vertex` refused.
    /// @throws InputError for fewer than three corners and for other repeated vertices, unless such faces are left out
    ///         (see InputPosition::harmless_fault), and for more than 2^31 - 1 corners in all.
    void add_face(std::span<const Index> corners);

    /// Checks that 0 <= index < n.
    /// @param n the number of vertices.
    /// @throws InputError
    /// @returns the index; -1 if the check fails and faults are collected.
    [[nodiscard]] Index vertex(std::int64_t index, std::int64_t n) const
    {
        return index >= 0 && index < n ? static_cast<Index>(index) : refuse_vertex(index, n);
    }

  private:
    [[nodiscard]] Index refuse_vertex(std::int64_t index, std::int64_t n) const;
    void refuse_face(std::span<const Index> corners);

    const InputPosition& position_;
    Index first_number_;
    /// The number of vertices so far, including those before the slice.
    Index n_vertices_;
    /// The number of faces read so far, including those that were left out.
    Index n_faces_ = 0;
    Points& vertices_;
    PolygonMesh& mesh_;
    std::vector<Index> sorted_;
    std::vector<Index> distinct_;
};

}  // namespace seamflow
