#include "partition/metrics/coordinate_steps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace seamflow {

namespace {

/// In lengths of edges: values that differ by less are one value, and the smallest step that is looked for.
constexpr double same_value = 1e-5;
constexpr double least_step = 0.005;
/// In steps: a value so near to a plane lies on it.
constexpr double near_plane = 0.02;
/// In steps: so near are the values that lie on planes but for the rounding of a file.
constexpr double on_plane = 0.002;
/// The fraction of all values that lie on planes.
constexpr double most_values = 0.8;
/// Of two steps, the larger counts if it has this fraction of the values of the other.
constexpr double almost_as_many = 0.98;
/// The number of different steps that are tried, the commonest first.
constexpr std::size_t most_candidates = 12;

/// A value of a coordinate that several vertices have.
struct SharedValue {
    double value = 0.0;
    double count = 0.0;
};

/// The values that at least two vertices have, ascending.
/// @param sorted ascending. @param same values that differ by less are one value.
std::vector<SharedValue> shared_values(std::span<const double> sorted, double same)
{
    std::vector<SharedValue> shared;
    for (std::size_t begin = 0; begin < sorted.size();) {
        std::size_t end = begin + 1;
        while (end < sorted.size() && sorted[end] - sorted[end - 1] <= same)
            ++end;
        // Values that lie close together without being equal, as those of a curved surface do, form one long run.
        if (end - begin > 1 && sorted[end - 1] - sorted[begin] <= 2.0 * same)
            shared.push_back({0.5 * (sorted[begin] + sorted[end - 1]), static_cast<double>(end - begin)});
        begin = end;
    }
    return shared;
}

/// The gaps between neighbouring values, each once, the commonest first.
std::vector<double> common_gaps(const std::vector<SharedValue>& values, double same)
{
    std::vector<double> gaps;
    for (std::size_t i = 1; i < values.size(); ++i)
        gaps.push_back(values[i].value - values[i - 1].value);
    std::ranges::sort(gaps);
    std::vector<SharedValue> found;
    for (const double gap : gaps) {
        if (found.empty() || gap - found.back().value > 2.0 * same)
            found.push_back({gap, 0.0});
        found.back().count += 1.0;
    }
    std::ranges::stable_sort(found, [](const SharedValue& a, const SharedValue& b) { return a.count > b.count; });
    std::vector<double> candidates;
    for (const SharedValue& one : found)
        if (candidates.size() < most_candidates)
            candidates.push_back(one.value);
    return candidates;
}

/// Fits values at numbered planes by a line.
class LineFit {
  public:
    void add(double plane, double value, double weight)
    {
        n_ += weight;
        k_ += weight * plane;
        x_ += weight * value;
        kk_ += weight * plane * plane;
        kx_ += weight * plane * value;
    }

    /// The planes; none if all values are at one. @param base the place of values of 0.
    [[nodiscard]] CoordinateSteps line(double base) const
    {
        const double spread = n_ * kk_ - k_ * k_;
        if (!(spread > 0.0))
            return {};
        const double step = (n_ * kx_ - k_ * x_) / spread;
        return {step, base + (x_ - step * k_) / n_};
    }

  private:
    double n_ = 0.0;
    double k_ = 0.0;
    double x_ = 0.0;
    double kk_ = 0.0;
    double kx_ = 0.0;
};

/// The planes through most values whose step is about this one: the numbers of planes are counted from gap to gap, so
/// that a small error of the step does not add up, then line and values are fitted to each other.
CoordinateSteps fitted(const std::vector<SharedValue>& values, double step)
{
    // The beginning is a value with a neighbour one step away: it is no stray one.
    std::size_t first = 0;
    while (first + 1 < values.size() &&
           std::abs(values[first + 1].value - values[first].value - step) > near_plane * step)
        ++first;
    if (first + 1 == values.size())
        return {};
    const double base = values[first].value;
    LineFit rough;
    double k = 0.0;
    double last = base;
    for (std::size_t i = first; i < values.size(); ++i) {
        const double planes = (values[i].value - last) / step;
        if (std::abs(planes - std::round(planes)) > near_plane)
            continue;
        k += std::round(planes);
        last = values[i].value;
        rough.add(k, last - base, values[i].count);
    }
    // A few stray values are near planes by chance.
    const CoordinateSteps steps = rough.line(base);
    if (!(steps.step > 0.0))
        return steps;
    LineFit fine;
    for (const SharedValue& one : values)
        if (std::abs((one.value - steps.origin) / steps.step - steps.plane_of(one.value)) <= on_plane)
            fine.add(steps.plane_of(one.value), one.value - steps.origin, one.count);
    return fine.line(steps.origin);
}

CoordinateSteps steps_of(std::vector<double> values, double length)
{
    std::ranges::sort(values);
    const double same = same_value * length;
    const auto needed = most_values * static_cast<double>(values.size());
    const std::vector<SharedValue> shared = shared_values(values, same);
    const auto total = [](double sum, const SharedValue& one) { return sum + one.count; };
    if (shared.size() < 2 || std::accumulate(shared.begin(), shared.end(), 0.0, total) < needed)
        return {};
    std::vector<std::pair<CoordinateSteps, double>> found;
    double most = needed;
    for (const double candidate : common_gaps(shared, same)) {
        if (candidate < least_step * length)
            continue;
        const CoordinateSteps steps = fitted(shared, candidate);
        if (!(steps.step > 0.0))
            continue;
        double on_planes = 0.0;
        for (const SharedValue& one : shared)
            on_planes += steps.has(one.value) ? one.count : 0.0;
        most = std::max(most, on_planes);
        found.emplace_back(steps, on_planes);
    }
    // Twice the step still has the planes of most vertices, if few lie on those between.
    CoordinateSteps best;
    for (const auto& [steps, on_planes] : found)
        if (on_planes >= almost_as_many * most && steps.step > best.step)
            best = steps;
    return best;
}

}  // namespace

bool CoordinateSteps::has(double value) const
{
    return std::abs((value - origin) / step - plane_of(value)) <= near_plane;
}

double CoordinateSteps::plane_of(double value) const
{
    return std::round((value - origin) / step);
}

std::array<CoordinateSteps, 3> find_coordinate_steps(const Points& points, double length, const Executor& exec)
{
    std::array<CoordinateSteps, 3> steps;
    if (!(length > 0.0))
        return steps;
    for_each(exec, 3, [&](Index axis) {
        std::vector<double> values(usize(static_cast<Index>(points.rows())));
        for (Eigen::Index v = 0; v < points.rows(); ++v)
            values[static_cast<std::size_t>(v)] = points(v, axis);
        steps[static_cast<std::size_t>(axis)] = steps_of(std::move(values), length);
    });
    return steps;
}

}  // namespace seamflow
