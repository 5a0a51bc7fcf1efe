#include "partition/metrics/length_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace seamflow {

LengthStatistics length_statistics(std::span<const double> lengths)
{
    LengthStatistics statistics;
    std::size_t count = 0;
    for (const double signed_length : lengths) {
        if (std::isnan(signed_length))
            continue;
        const double length = std::abs(signed_length);
        ++count;
        statistics.mean += length;
        statistics.rms += length * length;
        statistics.max = std::max(statistics.max, length);
    }
    if (count == 0)
        return statistics;
    statistics.mean /= static_cast<double>(count);
    statistics.rms = std::sqrt(statistics.rms / static_cast<double>(count));
    return statistics;
}

}  // namespace seamflow
