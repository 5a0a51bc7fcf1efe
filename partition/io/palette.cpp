#include "partition/io/palette.h"

#include <algorithm>
#include <cmath>

namespace seamflow {

namespace {

/// One channel of a colour of full saturation and brightness: a trapezium around the hue at which it is strongest.
/// @param hue, strongest 0 to 1, once round the circle.
double channel(double hue, double strongest)
{
    const double turn = std::abs(hue - strongest);
    const double distance = std::min(turn, 1.0 - turn);
    return std::min(std::max(2.0 - 6.0 * distance, 0.0), 1.0);
}

}  // namespace

Colour colour_of(Index label)
{
    if (label < 0)
        return {128, 128, 128};
    constexpr double golden_section = 0.6180339887498949;
    constexpr std::array<double, 3> brightnesses = {0.95, 0.75, 0.85};
    constexpr double saturation = 0.65;
    const double hue = std::fmod(label * golden_section, 1.0);
    const double brightness = brightnesses[static_cast<std::size_t>(label) % 3];
    Colour colour{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double full = channel(hue, static_cast<double>(k) / 3.0);
        colour[k] = static_cast<std::uint8_t>(std::lround(255.0 * brightness * (1.0 - saturation * (1.0 - full))));
    }
    return colour;
}

}  // namespace seamflow
