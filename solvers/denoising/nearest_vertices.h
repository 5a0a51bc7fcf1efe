#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "partition/index_lists.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Finds the vertices nearest to a vertex, among those around it on the surface. Keeps its memory between searches.
class NearestVertices {
  public:
    /// @param neighbours per vertex, along edges. @param positions #V by 3. @param count the number of vertices besides
    /// the centre.
    /// @returns squared distances and vertices, nearest first, beginning with the centre; fewer than count + 1 where
    /// the surface has no more. Valid until the next search.
    std::span<const std::pair<double, Index>> find(const IndexLists& neighbours, const Points& positions, Index centre,
                                                   std::size_t count);

  private:
    /// Empties the table, and makes room for n vertices.
    void clear(std::size_t n);
    /// Adds a vertex that was not found before, unless most_ vertices are found.
    void insert(Index v);

    /// The vertices found, ring by ring.
    std::vector<Index> found_;
    /// A hash table of the vertices found; -1 in empty slots.
    std::vector<Index> slots_;
    /// The slots in use: one per vertex of found_.
    std::vector<std::size_t> used_;
    /// The most vertices that the present search finds: four times the number asked for, whatever the size of the
    /// table.
    std::size_t most_ = 0;
    std::vector<std::pair<double, Index>> nearest_;
};

}  // namespace seamflow
