#pragma once

#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "partition/executor.h"
#include "partition/large_arrays.h"

namespace seamflow {

/// The numbers 0 … n - 1 in sets that are joined (union-find). Several threads may join sets at once: the final sets
/// and their representatives do not depend on the order.
class DisjointSets {
  public:
    /// At first each number is a set of its own.
    DisjointSets(Index n, const Executor& exec)
        : n_(n)
        , towards_lowest_(uninitialised<Index>(n))
    {
        for_each(exec, n, [&](Index i) { towards_lowest_[i] = i; });
    }

    [[nodiscard]] Index size() const { return n_; }

    /// How many sets there are.
    [[nodiscard]] Index count(const Executor& exec) const
    {
        return sum(
            exec, n_, [&](Index i) { return next_of(i) == i ? 1 : 0; }, Index{0});
    }

    /// The lowest number of the set that contains i; while sets are being joined, a number of that set.
    Index find(Index i)
    {
        for (;;) {
            Index next = next_of(i);
            const Index after = next_of(next);
            if (next == after)
                return next;
            // Halves the path. If another thread has changed the link, its change is kept.
            link(i).compare_exchange_weak(next, after, std::memory_order_relaxed);
            i = after;
        }
    }

    /// Joins the sets of a and b, by a link from the higher of their lowest numbers to the lower one.
    void join(Index a, Index b)
    {
        // Most pairs are in one set already.
        if (next_of(a) == next_of(b))
            return;
        for (;;) {
            a = find(a);
            b = find(b);
            if (a == b)
                return;
            if (a < b)
                std::swap(a, b);
            // Succeeds unless another thread has joined the set of a to a lower one.
            Index expected = a;
            if (link(a).compare_exchange_strong(expected, b, std::memory_order_relaxed))
                return;
        }
    }

    /// For each number, the lowest number of its set.
    std::vector<Index> all_lowest(const Executor& exec)
    {
        auto lowest = large_vector<Index>(n_);
        for_each(exec, n_, [&](Index i) { lowest[i] = find(i); });
        return lowest;
    }

    /// For each number, the number of its set, the sets being numbered in the order of their lowest numbers; and the
    /// number of sets.
    std::pair<std::vector<Index>, Index> numbered(const Executor& exec)
    {
        const std::vector<Index> lowest = select(exec, size(), [&](Index i) { return next_of(i) == i; });
        auto number = large_vector<Index>(n_);
        const auto n = static_cast<Index>(lowest.size());
        for_each(exec, n, [&](Index set) { number[lowest[set]] = set; });
        for_each(exec, size(), [&](Index i) {
            if (const Index first = find(i); first != i)
                number[i] = number[first];
        });
        return {std::move(number), n};
    }

  private:
    [[nodiscard]] std::atomic_ref<Index> link(Index i) const { return std::atomic_ref(towards_lowest_[i]); }
    [[nodiscard]] Index next_of(Index i) const { return link(i).load(std::memory_order_relaxed); }

    Index n_;
    /// A lower number of the same set; for the lowest, itself.
    std::unique_ptr<Index[]> towards_lowest_;
};

}  // namespace seamflow
