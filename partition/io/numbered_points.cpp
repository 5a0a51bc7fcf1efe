#include "partition/io/numbered_points.h"

#include <array>
#include <cstdint>
#include <memory>
#include <numeric>

#include "partition/io/slices.h"
#include "partition/large_arrays.h"
#include "partition/point_numbers.h"

namespace seamflow {

namespace {

/// Points are divided by the upper bits of their hashes (a table of points uses the lower bits) into shares that are
/// searched one by one.
constexpr unsigned share_bits = 6;
constexpr Index n_shares = 1 << share_bits;

template <class Real>
Index share_of(const std::array<Real, 3>& point)
{
    return static_cast<Index>(BasicPointNumbers<Real>::hash_of(point) >> (64U - share_bits));
}

/// The points of all lists, one share after the other; within a share in their order.
template <class Real>
struct Shares {
    /// The index of the first point of each share; then the number of all points.
    std::vector<Index> begin;
    std::unique_ptr<std::array<Real, 3>[]> points;
    /// For each point, its index among the points of all lists.
    std::unique_ptr<Index[]> origins;
};

/// Divides the points of all lists into shares.
/// @param begin for each list the number of points before it; then the number of all points.
template <class Real>
Shares<Real> divide(std::span<const std::vector<std::array<Real, 3>>> lists, const std::vector<Index>& begin,
                    const Executor& exec)
{
    const auto n_lists = static_cast<Index>(lists.size());
    // For each share and each list the number of points; then the index of the first of them.
    std::vector<Index> counts(usize(n_shares) * lists.size() + 1, 0);
    for_each(exec, n_lists, [&](Index i) {
        std::array<Index, n_shares> n_points{};
        for (const auto& point : lists[i])
            ++n_points[share_of(point)];
        for (Index share = 0; share < n_shares; ++share)
            counts[usize(share) * lists.size() + usize(i) + 1] = n_points[share];
    });
    std::partial_sum(counts.begin(), counts.end(), counts.begin());
    Shares<Real> shares;
    for (Index share = 0; share <= n_shares; ++share)
        shares.begin.push_back(counts[usize(share) * lists.size()]);
    shares.points = uninitialised<std::array<Real, 3>>(usize(begin.back()));
    shares.origins = uninitialised<Index>(usize(begin.back()));
    for_each(exec, n_lists, [&](Index i) {
        std::array<Index, n_shares> next{};
        for (Index share = 0; share < n_shares; ++share)
            next[share] = counts[usize(share) * lists.size() + usize(i)];
        for (Index k = 0; k < std::ssize(lists[i]); ++k) {
            const Index index = next[share_of(lists[i][k])]++;
            shares.points[index] = lists[i][k];
            shares.origins[index] = begin[i] + k;
        }
    });
    return shares;
}

/// For each point of all lists, the index of the first point that equals it.
template <class Real>
std::unique_ptr<Index[]> first_equal(std::span<const std::vector<std::array<Real, 3>>> lists,
                                     const std::vector<Index>& begin, const Executor& exec)
{
    const Shares<Real> shares = divide(lists, begin, exec);
    auto first = uninitialised<Index>(usize(begin.back()));
    for_each(exec, n_shares, [&](Index share) {
        const auto n = usize(shares.begin[share + 1] - shares.begin[share]);
        const Index* const origins = shares.origins.get() + shares.begin[share];
        const std::vector<Index> of_share =
            BasicPointNumbers<Real>::first_equal({shares.points.get() + shares.begin[share], n});
        for (std::size_t i = 0; i < n; ++i)
            first[origins[i]] = origins[of_share[i]];
    });
    return first;
}

}  // namespace

template <class Real>
NumberedPoints number_together(std::span<const std::vector<std::array<Real, 3>>> lists, const Executor& exec)
{
    const auto n_lists = static_cast<Index>(lists.size());
    NumberedPoints result;
    result.begin.assign(lists.size() + 1, 0);
    for (Index i = 0; i < n_lists; ++i)
        result.begin[i + 1] = sum_of_counts(result.begin[i], std::ssize(lists[i]));
    const std::unique_ptr<Index[]> first = first_equal(lists, result.begin, exec);
    // For each list the number of new points; then the number of new points before the list.
    std::vector<Index> n_new(lists.size() + 1, 0);
    for_each(exec, n_lists, [&](Index i) {
        for (Index k = result.begin[i]; k < result.begin[i + 1]; ++k)
            n_new[i + 1] += first[k] == k ? 1 : 0;
    });
    std::partial_sum(n_new.begin(), n_new.end(), n_new.begin());
    result.points = uninitialised_points(n_new.back());
    result.numbers = uninitialised<Index>(usize(result.begin.back()));
    for_each(exec, n_lists, [&](Index i) {
        Index next = n_new[i];
        for (Index k = result.begin[i]; k < result.begin[i + 1]; ++k) {
            if (first[k] != k)
                continue;
            const std::array<Real, 3>& point = lists[i][k - result.begin[i]];
            result.points.row(next) << point[0], point[1], point[2];
            result.numbers[k] = next++;
        }
    });
    for_each(exec, n_lists, [&](Index i) {
        for (Index k = result.begin[i]; k < result.begin[i + 1]; ++k)
            if (first[k] != k)
                result.numbers[k] = result.numbers[first[k]];
    });
    return result;
}

template NumberedPoints number_together(std::span<const std::vector<std::array<double, 3>>> lists,
                                        const Executor& exec);
template NumberedPoints number_together(std::span<const std::vector<std::array<float, 3>>> lists, const Executor& exec);

}  // namespace seamflow
