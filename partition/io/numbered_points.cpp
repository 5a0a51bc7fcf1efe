#include "partition/io/numbered_points.h"

#include <cstdint>
#include <numeric>

#include "partition/index_lists.h"
#include "partition/io/slices.h"

namespace seamflow {

namespace {

/// Points are divided by the upper bits of their hashes (a table of points uses the lower ones) into shares that are
/// looked through one by one.
constexpr unsigned share_bits = 6;
constexpr Index n_shares = 1 << share_bits;

Index share_of(const PointNumbers::Place& point)
{
    return static_cast<Index>(PointNumbers::hash_of(point) >> (64U - share_bits));
}

}  // namespace

NumberedPoints number_together(std::span<const std::vector<PointNumbers::Place>> lists, const Executor& exec)
{
    const auto n_lists = static_cast<Index>(lists.size());
    NumberedPoints result;
    result.begin.assign(lists.size() + 1, 0);
    for (Index i = 0; i < n_lists; ++i)
        result.begin[i + 1] = sum_of_counts(result.begin[i], std::ssize(lists[i]));
    // Shares lie together in memory.
    std::vector<IndexLists> of_share(lists.size());
    std::vector<std::vector<PointNumbers::Place>> points(lists.size());
    for_each(exec, n_lists, [&](Index i) {
        of_share[i] = make_lists(n_shares, [&](auto&& add) {
            for (Index k = 0; k < std::ssize(lists[i]); ++k)
                add(share_of(lists[i][k]), k);
        });
        points[i].reserve(lists[i].size());
        for (const Index k : of_share[i].values)
            points[i].push_back(lists[i][k]);
    });
    // For each point, the first that equals it.
    std::vector<Index> first(at(result.begin.back()));
    for_each(exec, n_shares, [&](Index share) {
        std::size_t n = 0;
        for (Index i = 0; i < n_lists; ++i)
            n += of_share[i][share].size();
        PointNumbers found;
        found.reserve(n);
        std::vector<Index> first_of;
        for (Index i = 0; i < n_lists; ++i)
            for (Index m = of_share[i].offsets[share]; m < of_share[i].offsets[share + 1]; ++m) {
                const Index k = result.begin[i] + of_share[i].values[m];
                const Index number = found(points[i][m]);
                if (number == std::ssize(first_of))
                    first_of.push_back(k);
                first[k] = first_of[number];
            }
    });
    // New points of each list, and before it.
    std::vector<Index> n_new(lists.size() + 1, 0);
    for_each(exec, n_lists, [&](Index i) {
        for (Index k = result.begin[i]; k < result.begin[i + 1]; ++k)
            n_new[i + 1] += first[k] == k ? 1 : 0;
    });
    std::partial_sum(n_new.begin(), n_new.end(), n_new.begin());
    result.points = uninitialised_points(n_new.back());
    result.numbers.resize(first.size());
    for_each(exec, n_lists, [&](Index i) {
        Index next = n_new[i];
        for (Index k = result.begin[i]; k < result.begin[i + 1]; ++k) {
            if (first[k] != k)
                continue;
            const PointNumbers::Place& point = lists[i][k - result.begin[i]];
            result.points.row(next) = Point(point[0], point[1], point[2]);
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

}  // namespace seamflow
