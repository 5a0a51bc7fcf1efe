#include "samples/benchmark/loosest_tolerance.h"

namespace seamflow {

std::optional<double> loosest_tolerance(const std::function<bool(double)>& suffices)
{
    if (!suffices(tolerance_ladder.back()))
        return std::nullopt;
    std::size_t first = 0;
    std::size_t sufficient = tolerance_ladder.size() - 1;
    while (first < sufficient) {
        const std::size_t middle = (first + sufficient - 1) / 2;
        if (suffices(tolerance_ladder[middle]))
            sufficient = middle;
        else
            first = middle + 1;
    }
    return tolerance_ladder[sufficient];
}

}  // namespace seamflow
