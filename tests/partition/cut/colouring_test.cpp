#include <algorithm>
#include <random>

#include <doctest/doctest.h>

#include "partition/cut/colouring.h"
#include "partition/cut/cut_into.h"
#include "tests/support/cut_checks.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

Adjacency ring(Index n)
{
    Adjacency adjacency(static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i) {
        adjacency[static_cast<std::size_t>(i)] = {(i + n - 1) % n, (i + 1) % n};
        std::sort(adjacency[static_cast<std::size_t>(i)].begin(), adjacency[static_cast<std::size_t>(i)].end());
    }
    return adjacency;
}

Adjacency random_graph(Index n, std::uint32_t one_in, std::uint32_t seed)
{
    std::mt19937 generator(seed);
    Adjacency adjacency(static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i)
        for (Index j = i + 1; j < n; ++j)
            if (generator() % one_in == 0) {
                adjacency[static_cast<std::size_t>(i)].push_back(j);
                adjacency[static_cast<std::size_t>(j)].push_back(i);
            }
    return adjacency;
}

void check_valid(const Adjacency& adjacency, const std::vector<Index>& colours)
{
    REQUIRE(colours.size() == adjacency.size());
    for (std::size_t i = 0; i < adjacency.size(); ++i) {
        CHECK(colours[i] >= 0);
        CHECK(colours[i] < n_colours(colours));
        for (const Index j : adjacency[i])
            CHECK(colours[i] != colours[static_cast<std::size_t>(j)]);
    }
    CHECK(colour(adjacency) == colours);
}

/// m by n nodes in rows, each joined to the next in its row and to two in the next row.
Adjacency triangular_grid(Index m, Index n)
{
    Adjacency adjacency(usize(m * n));
    const auto join = [&](Index a, Index b) {
        adjacency[a].push_back(b);
        adjacency[b].push_back(a);
    };
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < m; ++i) {
            if (i + 1 < m)
                join(j * m + i, j * m + i + 1);
            if (j + 1 < n)
                join(j * m + i, (j + 1) * m + i);
            if (i + 1 < m && j + 1 < n)
                join(j * m + i, (j + 1) * m + i + 1);
        }
    for (auto& neighbours : adjacency)
        std::sort(neighbours.begin(), neighbours.end());
    return adjacency;
}

}  // namespace

TEST_CASE("rings take two colours or three")
{
    for (Index n = 3; n < 40; ++n) {
        const auto colours = colour(ring(n));
        check_valid(ring(n), colours);
        CHECK(n_colours(colours) == (n % 2 == 0 ? 2 : 3));
    }
}

TEST_CASE("a grid of triangles, of which one colour follows from the others, takes three colours")
{
    for (const Index m : {2, 5, 12})
        for (const Index n : {2, 7, 12}) {
            const Adjacency adjacency = triangular_grid(m, n);
            const auto colours = colour(adjacency);
            check_valid(adjacency, colours);
            CHECK(n_colours(colours) == 3);
        }
}

TEST_CASE("few nodes take few colours")
{
    CHECK(n_colours(colour({})) == 0);
    CHECK(colour({{}}) == std::vector<Index>{0});
    CHECK(colour({{}, {2}, {1}}) == std::vector<Index>{0, 0, 1});
}

TEST_CASE("a component that is not bipartite does not spoil the others")
{
    const Adjacency adjacency{{1, 2}, {0, 2}, {0, 1}, {4}, {3, 5}, {4}};
    const auto colours = colour(adjacency);
    check_valid(adjacency, colours);
    CHECK(n_colours(colours) == 3);
    CHECK(std::vector<Index>(colours.begin() + 3, colours.end()) == std::vector<Index>{0, 1, 0});
}

TEST_CASE("random graphs are coloured validly, with no more colours than neighbours and one")
{
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        const Adjacency adjacency = random_graph(60, 2 + seed, seed);
        const auto colours = colour(adjacency);
        check_valid(adjacency, colours);
        std::size_t most = 0;
        for (const auto& neighbours : adjacency)
            most = std::max(most, neighbours.size());
        CHECK(n_colours(colours) <= static_cast<Index>(most) + 1);
    }
}

TEST_CASE("parts that share an interface vertex are adjacent")
{
    const PolygonMesh mesh = quad_grid(4, 4);
    const Topology topology = make_topology(mesh);
    const std::vector<Index> quarters{0, 0, 1, 1, 0, 0, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3};
    CHECK(adjacency_of(mesh, topology, quarters, 4) == Adjacency{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}});
    const std::vector<Index> stripes{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2};
    CHECK(adjacency_of(mesh, topology, stripes, 3) == Adjacency{{1}, {0, 2}, {1}});
}

TEST_CASE("parts that share vertices of the boundary only are not adjacent")
{
    const PolygonMesh mesh = quad_grid(3, 1);
    CHECK(adjacency_of(mesh, make_topology(mesh), std::vector<Index>{0, 1, 2}, 3) == Adjacency{{}, {}, {}});
}

TEST_CASE("cuts of meshes are coloured with few colours")
{
    for (const PolygonMesh& mesh : {triangle_torus(40, 30), quad_torus(40, 30), hexagon_sheet(30, 30)}) {
        const Topology topology = make_topology(mesh);
        for (const Index k : {2, 7, 30}) {
            const Cut cut = cut_into(mesh, topology, k);
            const Adjacency adjacency = adjacency_of(mesh, topology, cut.labels, cut.n_parts);
            const auto colours = colour(adjacency);
            check_valid(adjacency, colours);
            CHECK(n_colours(colours) <= 7);
        }
    }
}
