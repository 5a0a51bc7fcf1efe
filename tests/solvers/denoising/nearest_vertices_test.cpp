#include <algorithm>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "solvers/denoising/nearest_vertices.h"

using namespace seamflow;

namespace {

/// The neighbours in a wheel: the hub 0, around it n vertices that are joined in a circle.
IndexLists wheel(Index n)
{
    IndexLists neighbours;
    for (Index v = 1; v <= n; ++v)
        neighbours.values.push_back(v);
    neighbours.close();
    for (Index v = 1; v <= n; ++v) {
        neighbours.values.insert(neighbours.values.end(), {0, v > 1 ? v - 1 : n, v < n ? v + 1 : 1});
        neighbours.close();
    }
    return neighbours;
}

/// Positions of the wheel: each vertex is nearer to the hub than the one before.
Points inward(Index n)
{
    Points positions = Points::Zero(n + 1, 3);
    for (Index v = 1; v <= n; ++v)
        positions(v, 0) = 2.0 - static_cast<double>(v) / n;
    return positions;
}

std::vector<std::pair<double, Index>> found(NearestVertices& search, Index n, Index centre, std::size_t count)
{
    const auto nearest = search.find(wheel(n), inward(n), centre, count);
    return {nearest.begin(), nearest.end()};
}

}  // namespace

TEST_CASE("the vertices found around a hub do not depend on earlier searches")
{
    constexpr Index n = 300;
    for (const Index centre : {0, 1, 17}) {
        NearestVertices fresh;
        NearestVertices used;
        found(used, n, centre, 200);
        const auto expected = found(fresh, n, centre, 6);
        REQUIRE(expected.size() == 7);
        CHECK(found(used, n, centre, 6) == expected);
    }
}

TEST_CASE("the nearest vertices come first, with the centre before them")
{
    NearestVertices search;
    const auto nearest = found(search, 12, 0, 6);
    REQUIRE(nearest.size() == 7);
    CHECK(nearest.front() == std::pair<double, Index>(0.0, 0));
    CHECK(std::ranges::is_sorted(nearest));
    CHECK(nearest.back().second == 7);
}
