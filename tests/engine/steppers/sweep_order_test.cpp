#include <doctest/doctest.h>

#include "engine/steppers/sweep_order.h"
#include "partition/cut/cut.h"
#include "samples/common/meshes.h"

using namespace seamflow;

namespace {

Decomposition cut_up(const PolygonMesh& mesh, Index k)
{
    const Topology topology = make_topology(mesh);
    const Cut cut = cut_into(mesh, topology, k);
    return decompose(mesh, topology, cut.labels, cut.n_parts);
}

}  // namespace

TEST_CASE("adjacent sub-meshes have different ranks, and ranks have no gaps")
{
    for (const Index k : {2, 3, 8, 20}) {
        const Decomposition decomposition = cut_up(make_triangles(3000), k);
        for (const Coloring coloring : {Coloring::Greedy, Coloring::Label}) {
            const auto rank = rank_sub_meshes(decomposition, coloring, std::vector<double>(4000, 1.0));
            std::vector<int> used(rank.size(), 0);
            for (std::size_t s = 0; s < rank.size(); ++s) {
                ++used[rank[s]];
                for (const Index t : decomposition.adjacency[s])
                    CHECK(rank[s] != rank[t]);
            }
            bool ended = false;
            for (const int count : used) {
                CHECK_FALSE((ended && count > 0));
                ended = ended || count == 0;
            }
        }
    }
}

TEST_CASE("with labels as colours the rank is the label")
{
    const auto rank = rank_sub_meshes(cut_up(make_quads(1000), 5), Coloring::Label, std::vector<double>(2000, 0.0));
    CHECK(rank == std::vector<Index>{0, 1, 2, 3, 4});
}

TEST_CASE("the colour with more curvature in the interior of its sub-meshes goes first")
{
    const PolygonMesh mesh = make_quads(1000);
    const Decomposition decomposition = cut_up(mesh, 2);
    for (const Index curved : {0, 1}) {
        std::vector<double> curvature(mesh.n_vertices(), 1e-3);
        const SubMesh& sub_mesh = decomposition.sub_meshes[curved];
        for (Index v = 0; v < sub_mesh.n_vertices; ++v)
            curvature[sub_mesh.local_to_global[v]] = 1.0;
        const auto rank = rank_sub_meshes(decomposition, Coloring::Greedy, curvature);
        CHECK(rank[curved] == 0);
        CHECK(rank[1 - curved] == 1);
    }
}

TEST_CASE("curvature on the interface and on the boundary does not count")
{
    const PolygonMesh mesh = make_quads(1000);
    const Decomposition decomposition = cut_up(mesh, 2);
    std::vector<double> curvature(mesh.n_vertices(), 1e-3);
    for (Index v = 0; v < decomposition.sub_meshes[1].n_vertices; ++v)
        if (decomposition.sub_meshes[1].fixed[v] != 0)
            curvature[decomposition.sub_meshes[1].local_to_global[v]] = 1e6;
    for (const Index v : decomposition.sub_meshes[1].interface.vertices)
        curvature[decomposition.sub_meshes[1].local_to_global[v]] = 1e6;
    const SubMesh& first = decomposition.sub_meshes[0];
    for (Index v = 0; v < first.n_vertices; ++v)
        if (first.fixed[v] == 0)
            curvature[first.local_to_global[v]] += 1e-3;
    CHECK(rank_sub_meshes(decomposition, Coloring::Greedy, curvature) == std::vector<Index>{0, 1});
}

TEST_CASE("the reversed order turns first to last")
{
    CHECK(reversed({0, 2, 1, 0}) == std::vector<Index>{2, 0, 1, 2});
    CHECK(reversed({}).empty());
}
