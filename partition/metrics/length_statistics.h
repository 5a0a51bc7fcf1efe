#pragma once

#include <span>

namespace seamflow {

/// Mean, root mean square and largest of some lengths.
struct LengthStatistics {
    double mean = 0.0;
    double rms = 0.0;
    double max = 0.0;
};

/// Of the absolute values of `lengths`, those that are not a number left out; all 0 if none is left. Summed in order,
/// so that the bits are always the same.
LengthStatistics length_statistics(std::span<const double> lengths);

}  // namespace seamflow
