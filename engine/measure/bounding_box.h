#pragma once

#include "partition/vector_area.h"

namespace seamflow {

/// A box around positions, in units of length.
struct BoundingBox {
    Point low = Point::Zero();
    Point high = Point::Zero();
};

}  // namespace seamflow
