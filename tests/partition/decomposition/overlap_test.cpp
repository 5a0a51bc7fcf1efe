#include <algorithm>
#include <numeric>
#include <set>

#include <doctest/doctest.h>

#include "engine/sweep/sweep_plan.h"
#include "partition/cut/colouring.h"
#include "partition/decomposition/local_mesh.h"
#include "partition/decomposition/overlap.h"
#include "partition/labels.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

struct Grown {
    const CutMesh& cut;
    std::vector<Index> stage;
    Decomposition decomposition;
    SweepPlan plan;

    [[nodiscard]] std::set<Index> parts_at(Index v) const
    {
        std::set<Index> parts;
        for (const Index corner : cut.topology.corners_at(v))
            parts.insert(cut.labels[cut.topology.face_of[corner]]);
        return parts;
    }
    [[nodiscard]] Index first_at(Index v) const
    {
        Index first = *parts_at(v).begin();
        for (const Index part : parts_at(v))
            if (stage[part] < stage[first])
                first = part;
        return first;
    }
    [[nodiscard]] Index global(Index s, Index i) const { return decomposition.sub_meshes[s].local_to_global[i]; }
};

Grown grown(const CutMesh& cut, std::vector<Index> stage, int layers)
{
    const Overlap overlap{cut.labels, stage, layers};
    std::vector<SubMesh> sub_meshes;
    auto faces = faces_by_label(cut.labels, cut.n_parts);
    for (Index s = 0; s < cut.n_parts; ++s)
        sub_meshes.push_back(make_overlapping_sub_mesh(cut.mesh, cut.topology, overlap, s, std::move(faces[s])));
    Decomposition decomposition = connect_overlapping(std::move(sub_meshes), cut.topology, overlap);
    SweepPlan plan = plan_overlapping_sweep(decomposition, stage);
    return {cut, std::move(stage), std::move(decomposition), std::move(plan)};
}

/// Calls `check` with every cut mesh, grown by one and two layers, in the order of colours and of labels.
template <class Check>
void for_each_grown(Check&& check)
{
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        std::vector<Index> by_label(cut.n_parts);
        std::iota(by_label.begin(), by_label.end(), 0);
        for (const auto& stage : {colour(test::decompose(cut).adjacency), by_label})
            for (const int layers : {1, 2})
                check(grown(cut, stage, layers));
    }
}

std::vector<Index> row_of(std::initializer_list<Index> ends)
{
    std::vector<Index> row(*(ends.begin() + 1) - *ends.begin());
    std::iota(row.begin(), row.end(), *ends.begin());
    return row;
}

}  // namespace

TEST_CASE("a part grows by the faces around its vertices, into parts of equal or higher rank only")
{
    // Twelve unit squares in a row, one face high: parts of four.
    const PolygonMesh mesh = quad_grid(12, 1);
    const Topology topology = make_topology(mesh);
    std::vector<Index> labels;
    for (Index f = 0; f < 12; ++f)
        labels.push_back(f / 4);
    const std::vector<Index> stage{1, 0, 1};
    const auto grown_by = [&](int layers, Index s) {
        return grow(mesh, topology, {labels, stage, layers}, s, row_of({4 * s, 4 * s + 4}));
    };
    CHECK(grown_by(0, 1) == row_of({4, 8}));
    CHECK(grown_by(1, 1) == row_of({3, 9}));
    CHECK(grown_by(3, 1) == row_of({1, 11}));
    CHECK(grown_by(100, 1) == row_of({0, 12}));
    CHECK(grown_by(100, 0) == row_of({0, 4}));
}

TEST_CASE("a layer reaches across corners")
{
    const PolygonMesh mesh = quad_grid(3, 3);
    std::vector<Index> labels(9, 1);
    labels[4] = 0;
    const std::vector<Index> stage{0, 1};
    CHECK(grow(mesh, make_topology(mesh), {labels, stage, 1}, 0, {4}).size() == 9);
}

TEST_CASE("the interface is the artificial boundary, and never touches what the sub-mesh itself leads")
{
    for_each_grown([](const Grown& g) {
        for (Index s = 0; s < g.cut.n_parts; ++s) {
            const SubMesh& sub_mesh = g.decomposition.sub_meshes[s];
            const std::set<Index> faces(sub_mesh.faces.begin(), sub_mesh.faces.end());
            const std::set<Index> interface(sub_mesh.interface.vertices.begin(), sub_mesh.interface.vertices.end());
            for (Index i = 0; i < sub_mesh.n_vertices; ++i) {
                const auto corners = g.cut.topology.corners_at(g.global(s, i));
                const bool inside = std::all_of(corners.begin(), corners.end(), [&](Index corner) {
                    return faces.contains(g.cut.topology.face_of[corner]);
                });
                CHECK(interface.contains(i) == (!inside && sub_mesh.fixed[i] == 0));
                if (interface.contains(i))
                    CHECK(g.first_at(g.global(s, i)) != s);
            }
        }
    });
}

TEST_CASE("halo transfers fill all that is not of the own part, from those whose part it is")
{
    for_each_grown([](const Grown& g) {
        for (Index s = 0; s < g.cut.n_parts; ++s) {
            const SubMesh& to = g.decomposition.sub_meshes[s];
            std::vector<int> received(to.local_to_global.size(), 0);
            for (const Transfer& transfer : g.decomposition.halo[s]) {
                const auto& adjacent = g.decomposition.adjacency;
                CHECK(std::binary_search(adjacent[s].begin(), adjacent[s].end(), transfer.from));
                CHECK(std::binary_search(adjacent[transfer.from].begin(), adjacent[transfer.from].end(), s));
                for (std::size_t k = 0; k < transfer.source.size(); ++k) {
                    ++received[transfer.target[k]];
                    CHECK(g.global(transfer.from, transfer.source[k]) == g.global(s, transfer.target[k]));
                    CHECK(g.parts_at(g.global(s, transfer.target[k])).contains(transfer.from));
                }
            }
            for (std::size_t i = 0; i < received.size(); ++i)
                CHECK(received[i] == (g.parts_at(to.local_to_global[i]).contains(s) ? 0 : 1));
        }
    });
}

TEST_CASE("traces come from the part of lowest rank where that solves before, and everyone follows")
{
    for_each_grown([](const Grown& g) {
        for (Index s = 0; s < g.cut.n_parts; ++s) {
            const auto& interface = g.decomposition.sub_meshes[s].interface;
            CHECK(g.plan.roles[s] == std::vector<InterfaceRole>(interface.vertices.size(), InterfaceRole::Follows));
            std::set<std::pair<Index, Index>> expected;
            for (const Index i : interface.vertices)
                if (const Index first = g.first_at(g.global(s, i)); g.stage[first] < g.stage[s])
                    expected.emplace(first, i);
            std::set<std::pair<Index, Index>> found;
            for (const Transfer& trace : g.plan.traces[s])
                for (std::size_t k = 0; k < trace.source.size(); ++k) {
                    CHECK(g.global(trace.from, trace.source[k]) == g.global(s, trace.target[k]));
                    found.emplace(trace.from, trace.target[k]);
                }
            CHECK(found == expected);
        }
    });
}

TEST_CASE("on the interface are the vertices that may move and have faces of several parts")
{
    std::vector<Index> labels;
    for (const CutMesh& cut : cut_meshes())
        for (Index v = 0; v < cut.mesh.n_vertices(); ++v) {
            labels_around(cut.topology, cut.labels, v, labels);
            CHECK(is_on_interface(cut.topology, cut.labels, v) == (cut.topology.moves(v) && labels.size() > 1));
        }
}

TEST_CASE("growing changes neither Γ nor who speaks for a vertex")
{
    for_each_grown([](const Grown& g) {
        const Decomposition plain = test::decompose(g.cut);
        CHECK(g.decomposition.n_interface_vertices == plain.n_interface_vertices);
        for (Index s = 0; s < g.cut.n_parts; ++s) {
            const auto owned = [&](const SubMesh& sub_mesh) {
                std::set<Index> vertices;
                for (Index i = 0; i < sub_mesh.n_vertices; ++i)
                    if (sub_mesh.owned[i] != 0)
                        vertices.insert(sub_mesh.local_to_global[i]);
                return vertices;
            };
            CHECK(owned(g.decomposition.sub_meshes[s]) == owned(plain.sub_meshes[s]));
        }
    });
}
