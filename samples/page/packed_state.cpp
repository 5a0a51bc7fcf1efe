#include "samples/page/packed_state.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "samples/page/packed_array.h"

namespace seamflow {

namespace {

constexpr std::uint16_t undefined = 65535;

/// @param part from 0 to 1. @param most represents 1.
std::uint16_t sixteen_bits(double part, double most)
{
    return static_cast<std::uint16_t>(std::lround(std::clamp(part, 0.0, 1.0) * most));
}

}  // namespace

PackedPoints pack_points(const Points& positions)
{
    PackedPoints result;
    std::vector<std::uint16_t> numbers(static_cast<std::size_t>(positions.size()));
    if (positions.rows() > 0) {
        result.lower = positions.colwise().minCoeff();
        result.upper = positions.colwise().maxCoeff();
    }
    // Halves, since the difference of two large numbers may overflow.
    const Eigen::RowVector3d extent = 0.5 * result.upper - 0.5 * result.lower;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
        for (Eigen::Index v = 0; extent[axis] > 0.0 && v < positions.rows(); ++v)
            numbers[static_cast<std::size_t>(3 * v + axis)] =
                sixteen_bits((0.5 * positions(v, axis) - 0.5 * result.lower[axis]) / extent[axis], 65535.0);
    result.data = packed(std::span<const std::uint16_t>(numbers), 3);
    return result;
}

PackedValues pack_values(std::span<const double> values)
{
    PackedValues result;
    std::vector<double> finite;
    std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](double x) { return std::isfinite(x); });
    if (!finite.empty()) {
        const auto place = finite.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(finite.size() - 1));
        std::nth_element(finite.begin(), place, finite.end());
        result.percentile_99 = *place;
        result.largest = *std::max_element(place, finite.end());
    }
    std::vector<std::uint16_t> numbers;
    numbers.reserve(values.size());
    for (const double value : values) {
        if (!std::isfinite(value))
            numbers.push_back(undefined);
        else
            numbers.push_back(result.largest > 0.0 ? sixteen_bits(std::sqrt(value / result.largest), 65534.0) : 0);
    }
    result.data = packed(std::span<const std::uint16_t>(numbers), 1);
    return result;
}

}  // namespace seamflow
