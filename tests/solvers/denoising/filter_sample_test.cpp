#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "samples/meshes/meshes.h"
#include "solvers/denoising/filter_sample.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

/// Whether the neighbours of all that have some in the sample are those of the mesh.
bool has_all_neighbours(const FilterSample& sample, const PolygonMesh& mesh, const Topology& topology)
{
    for (Index i = 0; i < sample.neighbours.size(); ++i) {
        std::vector<Index> found;
        for (const Index j : sample.neighbours[i])
            found.push_back(sample.vertices[j]);
        if (!found.empty() && found != neighbours_of(mesh, topology, sample.vertices[i]))
            return false;
    }
    return true;
}

}  // namespace

TEST_CASE("small meshes are their own samples, and what does not move has no neighbours")
{
    for (const PolygonMesh& mesh : {test::triangle_grid(9, 7), test::hexagon_sheet(5, 6), make_gear(3000)}) {
        const Topology topology = make_topology(mesh);
        const FilterSample sample = take_filter_sample(mesh, topology);
        CHECK(static_cast<Index>(sample.vertices.size()) == mesh.n_vertices());
        CHECK(has_all_neighbours(sample, mesh, topology));
        std::size_t n_moving = 0;
        for (Index v = 0; v < mesh.n_vertices(); ++v) {
            CHECK(sample.neighbours[v].empty() == !topology.moves(v));
            n_moving += topology.moves(v) ? 1 : 0;
        }
        CHECK(sample.measured.size() == n_moving);
    }
}

TEST_CASE("of large meshes there are patches all over, measured inside their rims")
{
    const PolygonMesh mesh = make_triangles(120'000);
    const Topology topology = make_topology(mesh);
    const FilterSample sample = take_filter_sample(mesh, topology, run_in_parallel);
    CHECK(std::ranges::is_sorted(sample.vertices));
    CHECK(sample.vertices.size() > 20'000);
    CHECK(sample.vertices.size() < 35'000);
    CHECK(has_all_neighbours(sample, mesh, topology));
    CHECK(sample.measured.size() > 6'000);
    std::vector<std::uint8_t> quarters(4, 0);
    for (const Index i : sample.measured) {
        CHECK_FALSE(sample.neighbours[i].empty());
        // Four rings further there is no rim.
        std::vector<Index> front{i};
        for (int ring = 0; ring < 4; ++ring) {
            std::vector<Index> next;
            for (const Index j : front)
                next.insert(next.end(), sample.neighbours[j].begin(), sample.neighbours[j].end());
            sort_unique(next);
            front = std::move(next);
            if (std::ranges::any_of(front, [&](Index j) { return !topology.moves(sample.vertices[j]); }))
                break;
            CHECK(std::ranges::none_of(front, [&](Index j) { return sample.neighbours[j].empty(); }));
        }
        const auto point = mesh.vertices.row(sample.vertices[i]);
        quarters[(point[0] > 0.5 ? 1 : 0) + (point[1] > 0.5 ? 2 : 0)] = 1;
    }
    CHECK(std::ranges::count(quarters, 1) == 4);
}
