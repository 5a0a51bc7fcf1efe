#include "partition/formats/palette.h"

#include <algorithm>
#include <cmath>
#include <span>

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

constexpr Colour grey{128, 128, 128};
constexpr Colour white{255, 255, 255};
constexpr Colour blue{0, 0, 255};
constexpr Colour cyan{0, 255, 255};
constexpr Colour green{0, 255, 0};
constexpr Colour yellow{255, 255, 0};
constexpr Colour red{255, 0, 0};

/// The colour of a value from 0 to 1, linear between the stops; grey for NaN.
/// @param stops at least two colours, for 0, …, 1, equally spaced.
Colour interpolate(std::span<const Colour> stops, double value)
{
    if (std::isnan(value))
        return grey;
    const double position = std::clamp(value, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(position), stops.size() - 2);
    const double fraction = position - static_cast<double>(k);
    Colour colour{};
    for (std::size_t c = 0; c < colour.size(); ++c)
        colour[c] = static_cast<std::uint8_t>(std::lround((1.0 - fraction) * stops[k][c] + fraction * stops[k + 1][c]));
    return colour;
}

}  // namespace

Colour colour_of(Index label)
{
    if (label < 0)
        return grey;
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

Colour rainbow_colour(double value)
{
    constexpr std::array stops{blue, cyan, green, yellow, red};
    return interpolate(stops, value);
}

Colour signed_colour(double value)
{
    constexpr std::array stops{blue, white, red};
    return interpolate(stops, 0.5 * (value + 1.0));
}

}  // namespace seamflow
