#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "partition/executor.h"
#include "partition/index.h"
#include "partition/metrics/box.h"

namespace seamflow {

/// The numbers of points in an order that keeps neighbours together: halved again and again across the longest side of
/// their box, where a node of a BoxTree over the points in this order begins (Bentley, Multidimensional Binary Search
/// Trees, 1975).
/// @param points finite.
std::vector<Index> order_of_neighbours(std::span<const Point> points, const Executor& exec = run_serially);

/// A binary tree over boxes in an order that keeps neighbours together. Node k of a level has the children 2k and 2k +
/// 1 in the level below, as far as these exist.
class BoxTree {
  public:
    /// A node of a level; leaves have level 0.
    struct Node {
        int level;
        Index number;
    };

    explicit BoxTree(std::vector<Box> leaves)
    {
        levels_.push_back(std::move(leaves));
        while (levels_.back().size() > 1)
            levels_.push_back(parents_of(levels_.back()));
    }

    [[nodiscard]] Index size() const { return static_cast<Index>(levels_.front().size()); }
    [[nodiscard]] const Box& leaf(Index i) const { return levels_.front()[i]; }
    [[nodiscard]] Node root() const { return {static_cast<int>(levels_.size()) - 1, 0}; }
    [[nodiscard]] const Box& box(Node node) const { return levels_[node.level][node.number]; }

    /// Calls visit(child) for the one or two children of a node that is no leaf.
    template <class Visit>
    void for_each_child(Node node, Visit&& visit) const
    {
        const Index last = std::min(2 * node.number + 1, static_cast<Index>(levels_[node.level - 1].size()) - 1);
        for (Index k = 2 * node.number; k <= last; ++k)
            visit(Node{node.level - 1, k});
    }

    /// Calls visit(i) for the leaves i ≥ first that meet the box, ascending.
    template <class Visit>
    void for_each_meeting(const Box& box, Index first, Visit&& visit) const
    {
        // At each level at most one node waits, besides the children of the last one.
        std::array<Node, 64> waiting;
        std::size_t n_waiting = 0;
        if (size() > 0)
            waiting[n_waiting++] = root();
        while (n_waiting > 0) {
            const auto [level, k] = waiting[--n_waiting];
            if ((k + 1) * (std::size_t{1} << level) <= usize(first) || !levels_[level][k].meets(box))
                continue;
            if (level == 0) {
                visit(k);
                continue;
            }
            if (usize(2 * k + 1) < levels_[level - 1].size())
                waiting[n_waiting++] = {level - 1, 2 * k + 1};
            waiting[n_waiting++] = {level - 1, 2 * k};
        }
    }

    /// Calls visit(i) for the leaves i of a node whose squared distance from p is less than a bound, near leaves first.
    /// @param from the node. @param bound of the squared distance; visits may lower it.
    template <class Visit>
    void for_each_nearer(const Point& p, Node from, const double& bound, Visit&& visit) const
    {
        struct Waiting {
            double squared;
            Node node;
        };
        const auto waiting_at = [&](Node node) { return Waiting{squared_distance(box(node), p), node}; };
        std::array<Waiting, 64> waiting;
        std::size_t n_waiting = 0;
        waiting[n_waiting++] = waiting_at(from);
        while (n_waiting > 0) {
            Waiting next = waiting[--n_waiting];
            while (next.node.level > 0 && next.squared < bound) {
                const Node left{next.node.level - 1, 2 * next.node.number};
                const Node right{left.level, left.number + 1};
                next = waiting_at(left);
                if (usize(right.number) == levels_[left.level].size())
                    continue;
                Waiting other = waiting_at(right);
                if (other.squared < next.squared)
                    std::swap(next, other);
                if (other.squared < bound)
                    waiting[n_waiting++] = other;
            }
            if (next.squared < bound)
                visit(next.node.number);
        }
    }

  private:
    static std::vector<Box> parents_of(const std::vector<Box>& nodes)
    {
        std::vector<Box> parents((nodes.size() + 1) / 2);
        for (std::size_t k = 0; k < nodes.size(); ++k)
            parents[k / 2].add(nodes[k]);
        return parents;
    }

    /// The boxes of each level; leaves are the first level, the root is the last.
    std::vector<std::vector<Box>> levels_;
};

}  // namespace seamflow
