#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "partition/io/mesh_builder.h"

namespace seamflow {

/// Gives points with equal coordinates the same vertex, numbered in the order in which they first appear. Positive and
/// negative zero are equal; the vertex keeps the sign that came first.
class VertexWelder {
  public:
    /// @param builder takes the vertices; has to outlive the welder.
    explicit VertexWelder(MeshBuilder& builder)
        : builder_(builder)
        , slots_(1024, -1)
    {
    }

    /// The vertex at that point.
    Index vertex(const std::array<double, 3>& point);

  private:
    [[nodiscard]] std::size_t slot_of(const std::array<double, 3>& point) const;
    void grow();

    MeshBuilder& builder_;
    /// The points of the vertices, zeros positive.
    std::vector<std::array<double, 3>> points_;
    /// A hash table with open addressing: vertices, or -1. Its length is a power of two.
    std::vector<Index> slots_;
};

}  // namespace seamflow
