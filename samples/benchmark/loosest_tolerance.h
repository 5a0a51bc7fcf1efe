#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

namespace seamflow {

/// The candidates for a tolerance of equal accuracy, from loose to tight.
inline constexpr std::array tolerance_ladder{1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5,
                                             1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8};

/// The loosest tolerance of the ladder that suffices, by bisection; empty if not even the tightest one does.
/// @param suffices asked first for the tightest, then for 1e-4, and at most four times more.
std::optional<double> loosest_tolerance(const std::function<bool(double)>& suffices);

}  // namespace seamflow
