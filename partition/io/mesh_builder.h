#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "partition/io/input_position.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Collects the vertices and faces that a reader finds, and checks each face on its way in. Where faults are noted
/// instead of thrown, faces that have any are left out.
class MeshBuilder {
  public:
    /// @param position of the reader, for messages; has to outlive the builder.
    /// @param first_number the number of the first vertex in this format, for messages.
    explicit MeshBuilder(const InputPosition& position, Index first_number = 0);

    /// Makes room; the caller has checked that the file is long enough for so many.
    void reserve(std::uint64_t n_vertices, std::uint64_t n_faces);

    /// @throws InputError if there are 2^31 - 1 vertices already.
    void add_vertex(const std::array<double, 3>& position);

    /// @param corners vertices from 0, that need not have been added yet, or -1 for those that `vertex` found fault
    /// with.
    /// @throws InputError for less than three corners, for a vertex named twice, and for more than 2^31 - 1 corners in
    ///         all.
    void add_face(std::span<const Index> corners);

    [[nodiscard]] Index n_vertices() const { return static_cast<Index>(coordinates_.size() / 3); }

    /// Checks that 0 <= index < n.
    /// @param n number of vertices that there are to choose from.
    /// @throws InputError
    /// @returns the index; -1 if that is not so and faults are noted.
    [[nodiscard]] Index vertex(std::int64_t index, std::int64_t n) const;

    /// The mesh; the builder is empty afterwards.
    /// @throws InputError if there is no vertex.
    PolygonMesh finish();

  private:
    [[nodiscard]] bool are_distinct(std::span<const Index> corners);
    void leave_out_faces_without_vertices();

    const InputPosition& position_;
    Index first_number_;
    std::vector<double> coordinates_;
    PolygonMesh mesh_;
    std::vector<Index> sorted_;
};

}  // namespace seamflow
