#pragma once

#include <array>
#include <cstdint>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Red, green and blue, 0 to 255.
using Colour = std::array<std::uint8_t, 3>;

/// The colour of a label, always the same. From one label to the next the hue goes on by the golden section of the
/// circle, so that labels close in number differ clearly and no hue comes twice; brightness takes turns between three
/// values. Negative labels are grey.
Colour colour_of(Index label);

}  // namespace seamflow
