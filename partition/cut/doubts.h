#pragma once

#include <vector>

#include "partition/index.h"

namespace seamflow {

/// Where a cut may have defects (see first_defect); elsewhere it is known to have none.
struct Doubts {
    /// One entry per label: whether the part may be in pieces.
    std::vector<bool> parts;
    /// A vertex at which a part may be pinched is a corner of one of these faces. In any order, repetitions are
    /// welcome.
    std::vector<Index> faces;
};

}  // namespace seamflow
