#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "partition/cut/colouring.h"
#include "partition/decomposition/decomposition.h"
#include "tests/support/backwards.h"
#include "tests/support/cut_checks.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Calls `check` for every cut mesh.
template <class Check>
void for_each_decomposition(Check&& check)
{
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        check(cut, test::decompose(cut));
    }
}

}  // namespace

TEST_CASE("every face lies in exactly one sub-mesh, the one of its label")
{
    for_each_decomposition([](const CutMesh& cut, const Decomposition& decomposition) {
        REQUIRE(decomposition.sub_meshes.size() == usize(cut.n_parts));
        std::vector<int> times(cut.mesh.n_faces(), 0);
        for (Index s = 0; s < cut.n_parts; ++s)
            for (const Index f : decomposition.sub_meshes[s].faces) {
                ++times[f];
                CHECK(cut.labels[f] == s);
            }
        CHECK(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
    });
}

TEST_CASE("all sub-meshes at a vertex of the interface know of each other")
{
    for_each_decomposition([](const CutMesh&, const Decomposition& decomposition) {
        std::set<Index> on_interface;
        for (Index s = 0; s < static_cast<Index>(decomposition.sub_meshes.size()); ++s) {
            const SubMesh& sub_mesh = decomposition.sub_meshes[s];
            const auto& interface = sub_mesh.interface;
            REQUIRE(interface.sharing.size() == interface.size());
            REQUIRE(interface.index_in_sharing.size() == interface.size());
            for (Index i = 0; i < interface.size(); ++i) {
                const Index v = sub_mesh.local_to_global[interface.vertices[i]];
                on_interface.insert(v);
                const auto sharing = interface.sharing[i];
                CHECK(sharing.size() >= 2);
                CHECK(std::is_sorted(sharing.begin(), sharing.end()));
                CHECK(std::count(sharing.begin(), sharing.end(), s) == 1);
                for (std::size_t k = 0; k < sharing.size(); ++k) {
                    const SubMesh& other = decomposition.sub_meshes[sharing[k]];
                    const Index local = interface.index_in_sharing[i][k];
                    REQUIRE(other.local_to_global[local] == v);
                    const auto place =
                        std::find(other.interface.vertices.begin(), other.interface.vertices.end(), local);
                    REQUIRE(place != other.interface.vertices.end());
                    const auto j = static_cast<Index>(place - other.interface.vertices.begin());
                    CHECK(std::equal(sharing.begin(), sharing.end(), other.interface.sharing[j].begin(),
                                     other.interface.sharing[j].end()));
                }
            }
        }
        CHECK(decomposition.n_interface_vertices == static_cast<Index>(on_interface.size()));
    });
}

TEST_CASE("sub-meshes are adjacent when they share a vertex of the interface, as in the graph that is coloured")
{
    for_each_decomposition([](const CutMesh& cut, const Decomposition& decomposition) {
        CHECK(decomposition.adjacency == adjacency_of(cut.mesh, cut.topology, cut.labels, cut.n_parts));
        for (Index s = 0; s < cut.n_parts; ++s)
            for (const Index t : decomposition.adjacency[s]) {
                CHECK(t != s);
                const auto& back = decomposition.adjacency[t];
                CHECK(std::binary_search(back.begin(), back.end(), s));
            }
    });
}

TEST_CASE("transfers fill every vertex of the halo once, with the same vertex of an adjacent sub-mesh")
{
    for_each_decomposition([](const CutMesh& cut, const Decomposition& decomposition) {
        REQUIRE(decomposition.halo.size() == usize(cut.n_parts));
        for (Index s = 0; s < cut.n_parts; ++s) {
            const SubMesh& to = decomposition.sub_meshes[s];
            const auto& adjacent = decomposition.adjacency[s];
            std::vector<int> filled(to.local_to_global.size(), 0);
            Index previous = -1;
            for (const Transfer& transfer : decomposition.halo[s]) {
                CHECK(transfer.to == s);
                CHECK(transfer.from > previous);
                previous = transfer.from;
                CHECK(std::binary_search(adjacent.begin(), adjacent.end(), transfer.from));
                const SubMesh& from = decomposition.sub_meshes[transfer.from];
                REQUIRE(transfer.source.size() == transfer.target.size());
                CHECK(!transfer.source.empty());
                for (std::size_t k = 0; k < transfer.source.size(); ++k) {
                    CHECK(transfer.source[k] < from.n_vertices);
                    CHECK(from.local_to_global[transfer.source[k]] == to.local_to_global[transfer.target[k]]);
                    ++filled[transfer.target[k]];
                }
            }
            for (std::size_t i = 0; i < filled.size(); ++i)
                CHECK(filled[i] == (i < usize(to.n_vertices) ? 0 : 1));
        }
    });
}

TEST_CASE("one part shares nothing")
{
    const PolygonMesh& mesh = cut_meshes().front().mesh;
    const Topology& topology = cut_meshes().front().topology;
    const Decomposition whole = seamflow::decompose(mesh, topology, std::vector<Index>(mesh.n_faces(), 0), 1);
    REQUIRE(whole.sub_meshes.size() == 1);
    CHECK(whole.n_interface_vertices == 0);
    CHECK(whole.adjacency.front().empty());
    CHECK(whole.halo.front().empty());
}

TEST_CASE("faces are listed by label, in ascending order")
{
    CHECK(faces_by_label(std::vector<Index>{2, 0, 2, 0, 0}, 4) ==
          std::vector<std::vector<Index>>{{1, 3, 4}, {}, {0, 2}, {}});
    CHECK(faces_by_label({}, 0).empty());

    const Index n_faces = 200'000;
    const Index n_parts = 11;
    const std::vector<Index> labels = random_labels(n_faces, n_parts - 1, 3);
    std::vector<std::vector<Index>> expected(n_parts);
    for (Index f = 0; f < n_faces; ++f)
        expected[labels[f]].push_back(f);
    CHECK(faces_by_label(labels, n_parts) == expected);
    CHECK(faces_by_label(labels, n_parts, run_backwards) == expected);
}

TEST_CASE("rows of one sender make one transfer, in their order; senders ascend")
{
    const std::vector<TransferRow> rows{{7, 1, 10}, {2, 5, 11}, {7, 0, 12}, {2, 4, 3}, {7, 9, 2}};
    const auto transfers = transfers_to(4, rows);
    REQUIRE(transfers.size() == 2);
    CHECK(transfers[0].from == 2);
    CHECK(transfers[0].to == 4);
    CHECK(transfers[0].source == std::vector<Index>{5, 4});
    CHECK(transfers[0].target == std::vector<Index>{11, 3});
    CHECK(transfers[1].from == 7);
    CHECK(transfers[1].to == 4);
    CHECK(transfers[1].source == std::vector<Index>{1, 0, 9});
    CHECK(transfers[1].target == std::vector<Index>{10, 12, 2});
    CHECK(transfers_to(4, {}).empty());
}
