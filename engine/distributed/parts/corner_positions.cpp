#include "engine/distributed/parts/corner_positions.h"

#include "partition/index_lists.h"

namespace seamflow {

CornerPositions::CornerPositions(Communicator& comm, const RankSlice& slice, const SliceBounds& bounds)
    : slice_(slice)
    , first_(bounds.vertices[comm.rank()])
    , end_(bounds.vertices[comm.rank() + 1])
{
    for (const std::int64_t corner : slice.corners)
        if (!is_own(corner))
            others_.push_back(corner);
    sort_unique(others_);
    positions_ = fetch_positions(comm, slice, others_, bounds.vertices);
}

}  // namespace seamflow
