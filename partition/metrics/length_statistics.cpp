#include "partition/metrics/length_statistics.h"

#include <algorithm>
#include <cmath>

namespace seamflow {

void LengthSums::add(double length)
{
    if (std::isnan(length))
        return;
    length = std::abs(length);
    ++count_;
    sum_ += length;
    sum_of_squares_ += length * length;
    largest_ = std::max(largest_, length);
}

void LengthSums::add(const LengthSums& others)
{
    count_ += others.count_;
    sum_ += others.sum_;
    sum_of_squares_ += others.sum_of_squares_;
    largest_ = std::max(largest_, others.largest_);
}

LengthStatistics LengthSums::statistics() const
{
    if (count_ == 0)
        return {};
    const auto count = static_cast<double>(count_);
    return {.mean = sum_ / count, .rms = std::sqrt(sum_of_squares_ / count), .max = largest_};
}

LengthStatistics length_statistics(std::span<const double> lengths)
{
    LengthSums sums;
    for (const double length : lengths)
        sums.add(length);
    return sums.statistics();
}

}  // namespace seamflow
