#pragma once

#include <cstddef>
#include <span>

namespace seamflow {

/// Mean, root mean square and largest of some lengths.
struct LengthStatistics {
    double mean = 0.0;
    double rms = 0.0;
    double max = 0.0;
};

/// Statistics of the tangential and the normal components of displacements (see displacement_statistics).
struct DisplacementStatistics {
    LengthStatistics tangential;
    LengthStatistics normal;
};

/// Accumulates the sums for statistics of some lengths.
class LengthSums {
  public:
    /// Adds the absolute value of a length; NaN is ignored.
    void add(double length);
    /// Adds all lengths that were added to `others`.
    void add(const LengthSums& others);
    /// The statistics; all 0 if no length was added.
    [[nodiscard]] LengthStatistics statistics() const;

  private:
    std::size_t count_ = 0;
    double sum_ = 0.0;
    double sum_of_squares_ = 0.0;
    double largest_ = 0.0;
};

/// Statistics of the absolute values of `lengths` without NaNs; all 0 if there are none. Summed in order, so that the
/// bits are always the same.
LengthStatistics length_statistics(std::span<const double> lengths);

}  // namespace seamflow
