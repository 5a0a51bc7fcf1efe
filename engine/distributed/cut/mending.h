#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/cut/band.h"
#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"

namespace seamflow {

/// Where a cut may have defects (see repair); elsewhere it is known to have none.
struct SlicedDefects {
    /// Parts that may not be connected, ascending, the same at all ranks.
    std::vector<Index> parts;
    /// At rank 0, ascending: vertices at which a part may be pinched.
    std::vector<std::int64_t> vertices;
};

/// Makes every part a manifold with boundary, as repair does: doubtful places go to rank 0 with the faces around them.
/// All ranks call this together; the result does not depend on their number.
/// @param n_parts all labels are below it. Labels of parts that are used up no longer occur, and parts that had to be
///        divided get new ones after the largest.
void mend_together(Communicator& comm, SlicedCut cut, SlicedDefects defects, Index n_parts);

/// Renumbers the labels of all ranks to 0, 1, 2 … without gaps, keeping their order. All ranks call this together.
/// @returns the number of different labels.
Index compact_labels_together(Communicator& comm, std::vector<Index>& labels);

}  // namespace seamflow
