#include "engine/distributed/parts/corner_positions.h"

#include "partition/index_lists.h"

namespace seamflow {

CornerPositions::CornerPositions(Conversation& talk, const RankSlice& slice, const SliceBounds& bounds)
    : slice_(slice)
    , first_(bounds.vertices[talk.rank()])
    , end_(bounds.vertices[talk.rank() + 1])
{
    for (const std::int64_t corner : slice.corners)
        if (!is_own(corner))
            others_.push_back(corner);
    sort_unique(others_);
    positions_ = fetch_positions(talk, slice, others_, bounds.vertices);
}

}  // namespace seamflow
