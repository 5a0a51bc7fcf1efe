// A tile with bands of others as one mesh, and the borders where it continues.

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "partition/topology.h"
#include "samples/tiles/tile_borders.h"
#include "samples/tiles/tile_stepper.h"
#include "samples/tiles/tile_union.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

/// A unit square of n by n quads with its lower left corner there.
PolygonMesh square_at(double x, double y, Index n)
{
    PolygonMesh mesh;
    mesh.vertices.resize((n + 1) * (n + 1), 3);
    for (Index i = 0; i <= n; ++i)
        for (Index j = 0; j <= n; ++j)
            mesh.vertices.row(i * (n + 1) + j) << x + static_cast<double>(j) / n, y + static_cast<double>(i) / n, 0.0;
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
            const Index v = i * (n + 1) + j;
            mesh.add_face(std::vector<Index>{v, v + 1, v + n + 2, v + n + 1});
        }
    return mesh;
}

/// Four squares around a corner, and the owners of their borders.
struct FourSquares {
    std::vector<PolygonMesh> meshes;
    std::vector<TileOwners> owners;

    explicit FourSquares(Index n, double gap = 0.0, double weld = 0.0)
    {
        for (int t = 0; t < 4; ++t)
            meshes.push_back(square_at(t % 2 * (1.0 + gap), t / 2 * (1.0 + gap), n));
        for (Index t = 0; t < 4; ++t) {
            std::vector<BorderOfTile> near;
            for (Index other = 0; other < 4; ++other)
                near.push_back({other, border_of(meshes[other], make_topology(meshes[other])),
                                other < t ? owners[other] : TileOwners{}});
            owners.push_back(owners_of(t, near, weld));
        }
    }

    [[nodiscard]] TileFaces faces(Index t) const { return {meshes[t].face_offsets, meshes[t].face_vertices}; }
};

}  // namespace

TEST_CASE("the vertices of a border belong to the lowest tile that has them")
{
    constexpr Index n = 5;
    for (const auto& [gap, weld] : {std::pair(0.0, 0.0), std::pair(1e-3, 2e-3)}) {
        const FourSquares squares(n, gap, weld);
        // The lower left corner of the last square is the upper right one of the first.
        const TileOwners& last = squares.owners[3];
        REQUIRE(last.vertices.front() == 0);
        CHECK(last.tiles.front() == 0);
        CHECK(last.numbers.front() == (n + 1) * (n + 1) - 1);
        CHECK(std::ranges::count(last.is_shared, 1) == 2 * n + 1);
        CHECK(std::ranges::count(last.tiles, 3) == 4 * n - (2 * n + 1));
        // A corner of the first square lies at the others, but is its own.
        const TileOwners& first = squares.owners[0];
        CHECK(std::ranges::count(first.tiles, 0) == 4 * n);
        CHECK(std::ranges::equal(first.vertices, first.numbers));
        CHECK(std::ranges::count(first.is_shared, 1) == 2 * n + 1);
    }
    CHECK(std::ranges::count(FourSquares(n, 1e-3).owners[3].is_shared, 1) == 0);
}

TEST_CASE("a neighbourhood has all points within a width, and none that are much farther")
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    const auto points = [&](Index n) {
        Points list(n, 3);
        for (Eigen::Index i = 0; i < list.size(); ++i)
            list.data()[i] = place(random);
        return list;
    };
    constexpr double width = 0.2;
    const Points centres = points(20);
    const Neighbourhood near(centres, width);
    for (const Points others = points(5000); const auto& other : others.rowwise()) {
        const double distance = (centres.rowwise() - other).rowwise().norm().minCoeff();
        const double largest_coordinate = (centres.rowwise() - other).cwiseAbs().rowwise().maxCoeff().minCoeff();
        if (distance <= width)
            CHECK(near.contains(other));
        if (largest_coordinate > 1.5 * width)
            CHECK_FALSE(near.contains(other));
    }
}

TEST_CASE("bands are as wide as a step reaches, and wider with higher orders of a filter")
{
    const FlowOptions step{.time_step = 4.0};
    CHECK(width_of_bands({.time_step = 16.0}, 0.0) == test::relative(2.0 * width_of_bands(step, 0.0), 1e-12));
    CHECK(width_of_bands(step, 1.0) > width_of_bands(step, 0.0) + 2.0);
    for (const Filter filter : {Filter::Diffusion, Filter::LowPass}) {
        FlowOptions options = step;
        options.filter = filter;
        double before = width_of_bands(step, 1.0);
        for (const int order : {2, 3}) {
            options.order = order;
            const double width = width_of_bands(options, 1.0);
            CHECK(width > 1.05 * before);
            before = width;
        }
    }
}

TEST_CASE("a tile and a band of another are one mesh, whose outer rim alone is held")
{
    constexpr Index n = 8;
    const FourSquares squares(n);
    TileUnion both;
    const std::vector<std::uint8_t> all((n + 1) * (n + 1), 1);
    const auto numbers = both.add(squares.faces(0), squares.owners[0], squares.meshes[0].vertices, all);
    CHECK(both.held().empty());
    CHECK(std::ranges::count(numbers, -1) == 0);
    // Wanted: the first three columns. The faces around them end at the fourth.
    std::vector<std::uint8_t> is_wanted(all.size(), 0);
    for (std::size_t v = 0; v < all.size(); ++v)
        is_wanted[v] = v % (n + 1) < 3 ? 1 : 0;
    const auto of_band = both.add(squares.faces(1), squares.owners[1], squares.meshes[1].vertices, is_wanted);
    CHECK(both.mesh().n_vertices() == (n + 1) * (n + 1) + 3 * (n + 1));
    CHECK(both.mesh().n_faces() == n * n + 3 * n);
    CHECK(both.held().size() == n + 1);
    for (const Index v : both.held())
        CHECK(both.mesh().vertices(v, 0) == 1.0 + 3.0 / n);
    CHECK(std::ranges::count(of_band, -1) == (n + 1) * (n + 1 - 4));
    const Topology topology = make_topology(both.mesh());
    for (Index v = 0; v < both.mesh().n_vertices(); ++v) {
        const auto position = both.mesh().vertices.row(v);
        const bool is_inside =
            position[0] > 0.0 && position[0] < 1.0 + 3.0 / n && position[1] > 0.0 && position[1] < 1.0;
        CHECK((topology.kind[v] == VertexKind::Interior) == is_inside);
    }
}
