#pragma once

#include <array>
#include <cstdint>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Red, green and blue, 0 to 255.
using Colour = std::array<std::uint8_t, 3>;

/// The colour of a label. From one label to the next the hue advances by the golden section of the circle, so that
/// labels of near numbers differ clearly and no hue repeats; brightness alternates between three values. Negative
/// labels are grey.
Colour colour_of(Index label);

/// The colour of a value from 0 to 1: blue, cyan, green, yellow, red at 0, 1/4, 1/2, 3/4, 1, linear in between. Values
/// beyond the limits get the colour of the limit; NaN is grey.
Colour rainbow_colour(double value);

/// The colour of a value from -1 to 1: blue, white, red at -1, 0, 1, linear in between. Values beyond the limits get
/// the colour of the limit; NaN is grey.
Colour signed_colour(double value);

}  // namespace seamflow
