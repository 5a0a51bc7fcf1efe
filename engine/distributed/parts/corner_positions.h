#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/index_lists.h"
#include "partition/vector_area.h"

namespace seamflow {

/// The positions of the corners of a range of faces.
class CornerPositions {
  public:
    /// All ranks call this together.
    /// @param slice must outlive this.
    CornerPositions(Communicator& comm, const RankSlice& slice, const SliceBounds& bounds);

    /// @param corner of the range, as numbered in the whole mesh.
    [[nodiscard]] Point operator[](std::int64_t corner) const
    {
        if (is_own(corner))
            return slice_.vertices.row(corner - first_);
        return positions_.row(place_in(others_, corner));
    }

  private:
    [[nodiscard]] bool is_own(std::int64_t corner) const { return corner >= first_ && corner < end_; }

    const RankSlice& slice_;
    std::int64_t first_;
    std::int64_t end_;
    /// Ascending, those of other ranges.
    std::vector<std::int64_t> others_;
    Points positions_;
};

}  // namespace seamflow
