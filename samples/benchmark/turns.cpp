#include "samples/benchmark/turns.h"

#include <algorithm>
#include <cstddef>

namespace seamflow {

double Turns::least() const
{
    return *std::min_element(seconds.begin(), seconds.end());
}

double Turns::median() const
{
    std::vector<double> sorted = seconds;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
}

nlohmann::ordered_json turns_json(const Turns& turns)
{
    return {{"least_s", turns.least()}, {"median_s", turns.median()}, {"turns_s", turns.seconds}};
}

}  // namespace seamflow
