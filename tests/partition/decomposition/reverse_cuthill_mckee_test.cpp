#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>
#include <utility>

#include <doctest/doctest.h>

#include "partition/decomposition/reverse_cuthill_mckee.h"

using namespace seamflow;

namespace {

using Neighbours = std::vector<std::vector<Index>>;

std::vector<Index> shuffled_numbers(Index n, std::uint32_t seed)
{
    std::vector<Index> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0);
    std::shuffle(numbers.begin(), numbers.end(), std::mt19937(seed));
    return numbers;
}

/// A rectangle of m by n vertices, each joined to those beside, above and below it, numbered at random.
Neighbours shuffled_grid(Index m, Index n, std::uint32_t seed)
{
    const std::vector<Index> number = shuffled_numbers(m * n, seed);
    Neighbours adjacency(number.size());
    const auto join = [&](Index a, Index b) {
        adjacency[number[a]].push_back(number[b]);
        adjacency[number[b]].push_back(number[a]);
    };
    for (Index y = 0; y < n; ++y)
        for (Index x = 0; x < m; ++x) {
            if (x + 1 < m)
                join(y * m + x, y * m + x + 1);
            if (y + 1 < n)
                join(y * m + x, (y + 1) * m + x);
        }
    for (auto& neighbours : adjacency)
        std::sort(neighbours.begin(), neighbours.end());
    return adjacency;
}

/// All graphs in one, numbered one after the other.
Neighbours side_by_side(const std::vector<Neighbours>& graphs)
{
    Neighbours all;
    for (const Neighbours& graph : graphs) {
        const auto first = static_cast<Index>(all.size());
        for (std::vector<Index> neighbours : graph) {
            for (Index& neighbour : neighbours)
                neighbour += first;
            all.push_back(std::move(neighbours));
        }
    }
    return all;
}

std::vector<Index> places_in(const std::vector<Index>& order)
{
    std::vector<Index> places(order.size(), -1);
    for (std::size_t i = 0; i < order.size(); ++i)
        places.at(usize(order[i])) = static_cast<Index>(i);
    return places;
}

/// The largest distance between the places of two adjacent vertices.
Index bandwidth(const Neighbours& adjacency, const std::vector<Index>& order)
{
    const std::vector<Index> places = places_in(order);
    Index widest = 0;
    for (std::size_t v = 0; v < adjacency.size(); ++v)
        for (const Index neighbour : adjacency[v])
            widest = std::max(widest, std::abs(places[v] - places[neighbour]));
    return widest;
}

bool is_permutation_of(const std::vector<Index>& order, std::size_t n)
{
    const std::vector<Index> places = order.size() == n ? places_in(order) : std::vector<Index>{-1};
    return std::find(places.begin(), places.end(), -1) == places.end();
}

}  // namespace

TEST_CASE("the order has every vertex once, also of several components and of none")
{
    const Neighbours several = side_by_side({shuffled_grid(5, 4, 1), Neighbours(3), shuffled_grid(1, 7, 2)});
    for (const Neighbours& graph : {several, shuffled_grid(9, 9, 3), Neighbours(1), Neighbours()}) {
        const std::vector<Index> order = reverse_cuthill_mckee(graph);
        CHECK(is_permutation_of(order, graph.size()));
        CHECK(order == reverse_cuthill_mckee(graph));
    }
}

TEST_CASE("of a grid numbered at random, adjacent vertices are about as near as its shorter side is long")
{
    for (const std::uint32_t seed : {1U, 2U, 3U})
        for (const auto& sides : {std::pair<Index, Index>{1, 50}, {2, 40}, {8, 30}, {20, 20}, {30, 8}}) {
            CAPTURE(sides.first);
            CAPTURE(sides.second);
            const Neighbours grid = shuffled_grid(sides.first, sides.second, seed);
            CHECK(bandwidth(grid, reverse_cuthill_mckee(grid)) <= std::min(sides.first, sides.second) + 1);
        }
}

TEST_CASE("components follow each other, each as narrow as alone")
{
    const Neighbours several = side_by_side({shuffled_grid(6, 6, 1), shuffled_grid(3, 30, 2), shuffled_grid(6, 6, 3)});
    const std::vector<Index> places = places_in(reverse_cuthill_mckee(several));
    for (const auto& [first, n] : {std::pair<Index, Index>{0, 36}, {36, 90}, {126, 36}}) {
        const auto [least, most] = std::minmax_element(places.begin() + first, places.begin() + first + n);
        CHECK(*most - *least == n - 1);
    }
    CHECK(bandwidth(several, reverse_cuthill_mckee(several)) <= 7);
}
