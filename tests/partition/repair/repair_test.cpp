#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "partition/cut/clusters.h"
#include "partition/cut/divide.h"
#include "partition/cut/face_graph.h"
#include "partition/cut/part_boundaries.h"
#include "partition/cut/refine.h"
#include "partition/labels.h"
#include "partition/repair/repair.h"
#include "samples/meshes/meshes.h"
#include "tests/support/cut_checks.h"
#include "tests/support/random_meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Repairs and checks all that repair promises whatever the labels.
std::vector<Index> checked_repair(const PolygonMesh& mesh, const Topology& topology, const std::vector<Index>& given)
{
    std::vector<Index> labels = given;
    const Index moved = repair(mesh, topology, labels);
    REQUIRE(labels.size() == given.size());
    // Nothing is moved where nothing is wrong, and as many faces as have another label then, but for its number.
    std::vector<Index> compact = given;
    static_cast<void>(compact_labels(compact));
    CHECK((moved == 0) == (labels == compact));
    CHECK(moved <= std::max(mesh.n_faces() - 1, 0));
    CHECK_MESSAGE(!first_defect(mesh, topology, labels), first_defect(mesh, topology, labels).value_or(""));
    const std::set<Index> distinct(labels.begin(), labels.end());
    if (!labels.empty()) {
        CHECK(*distinct.begin() == 0);
        CHECK(*distinct.rbegin() == static_cast<Index>(distinct.size()) - 1);
    }
    std::vector<Index> again = given;
    CHECK(repair(mesh, topology, again) == moved);
    CHECK(again == labels);
    CHECK(repair(mesh, topology, again) == 0);
    CHECK(again == labels);
    return labels;
}

/// About k parts of clusters of a weight, each connected, before their seams are shortened.
std::vector<Index> parts_of_clusters(const PolygonMesh& mesh, const Topology& topology, Index weight, Index k)
{
    const FaceClusters clusters = grow_clusters(mesh, topology, weight);
    const FaceGraph graph = make_face_graph(mesh, topology, clusters, ArcMeasure::Count);
    std::vector<Index> part = divide(graph, graph_components(graph), k, Afterwards::Refined);
    refine(graph, *std::max_element(part.begin(), part.end()) + 1, part);
    std::vector<Index> labels;
    for (const Index cluster : clusters.cluster_of)
        labels.push_back(part[cluster]);
    return labels;
}

}  // namespace

TEST_CASE("what is suspected of shortened seams is all that there is to repair")
{
    RandomNumbers random(17);
    Index n_repaired = 0;
    Index n_suspected = 0;
    Index n_parts = 0;
    for (int round = 0; round < 300; ++round) {
        const RandomMesh m = random_mesh(random);
        CAPTURE(round);
        CAPTURE(m.description);
        const Topology topology = make_topology(m.mesh);
        std::vector<Index> labels = parts_of_clusters(m.mesh, topology, 2 + random.below(8), 2 + random.below(12));
        const SuspectedDefects suspected = shorten_boundaries(m.mesh, topology, compact_labels(labels), labels);
        std::vector<Index> all = labels;
        n_repaired += repair_where_suspected(m.mesh, topology, suspected, labels);
        repair_within_components(m.mesh, topology, all);
        // That would not have to be so where a move pinches a vertex that is not suspected: it is mended a round later.
        CHECK(labels == all);
        CHECK_MESSAGE(!first_defect(m.mesh, topology, labels), first_defect(m.mesh, topology, labels).value_or(""));
        n_suspected += static_cast<Index>(std::count(suspected.parts.begin(), suspected.parts.end(), true));
        n_parts += static_cast<Index>(suspected.parts.size());
    }
    CHECK(n_repaired > 50);
    CHECK(n_suspected > 0);
    CHECK(n_suspected < n_parts / 2);
}

TEST_CASE("repair mends random labels on every mesh")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        for (const Index k : {1, 2, 3, 5, 20, 1000})
            for (std::uint32_t seed = 0; seed < 12; ++seed) {
                CAPTURE(k);
                CAPTURE(seed);
                checked_repair(m.mesh, m.topology, random_labels(m.mesh.n_faces(), k, seed));
            }
    }
}

TEST_CASE("repair mends parts of sheets that meet, where a face that moves may pinch another vertex")
{
    for (const char* kind : {"foam", "foam-quads"}) {
        CAPTURE(kind);
        const PolygonMesh mesh = make_mesh(kind, 1000);
        Topology topology = make_topology(mesh);
        free_junctions(mesh, topology);
        RandomNumbers random(5);
        for (int cut = 0; cut < 80; ++cut) {
            CAPTURE(cut);
            checked_repair(mesh, topology, random_cut(mesh, 2 + random.below(30), random));
        }
    }
}

TEST_CASE("repair mends mostly good labels with a few strays")
{
    const PolygonMesh mesh = triangle_torus(24, 20);
    const Topology topology = make_topology(mesh);
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        std::vector<Index> labels(static_cast<std::size_t>(mesh.n_faces()));
        for (Index f = 0; f < mesh.n_faces(); ++f)
            labels[static_cast<std::size_t>(f)] = f / 120;
        for (const Index f : random_labels(30, mesh.n_faces(), seed))
            labels[static_cast<std::size_t>(f)] = f % 8;
        const auto repaired = checked_repair(mesh, topology, labels);
        CHECK(*std::max_element(repaired.begin(), repaired.end()) == 7);
    }
}

TEST_CASE("gaps are closed and the order of labels is kept")
{
    const PolygonMesh mesh = quad_grid(4, 1);
    const Topology topology = make_topology(mesh);
    std::vector<Index> labels{2000000000, 7, 7, 30};
    CHECK(repair(mesh, topology, labels) == 0);
    CHECK(labels == std::vector<Index>{2, 0, 0, 1});
}

TEST_CASE("the largest component of a part stays where it is")
{
    const PolygonMesh mesh = quad_grid(7, 1);
    const Topology topology = make_topology(mesh);
    std::vector<Index> labels{0, 1, 1, 1, 0, 0, 2};
    CHECK(repair(mesh, topology, labels) == 1);
    CHECK(labels == std::vector<Index>{1, 1, 1, 1, 0, 0, 2});
}

TEST_CASE("a pinch on a grid is mended by one face")
{
    const PolygonMesh mesh = quad_grid(4, 4);
    const Topology topology = make_topology(mesh);
    // Part 1 is connected around the hole of part 0 and pinched in its middle.
    std::vector<Index> labels{1, 1, 1, 1,  //
                              1, 0, 1, 1,  //
                              1, 1, 0, 0,  //
                              1, 1, 0, 0};
    CHECK(first_defect(mesh, topology, labels));
    CHECK(repair(mesh, topology, labels) == 1);
    CHECK(!first_defect(mesh, topology, labels));
}

TEST_CASE("a part in several components becomes one part in each")
{
    const PolygonMesh mesh = side_by_side({quad_grid(2, 1), quad_grid(2, 1), quad_grid(1, 1)});
    const Topology topology = make_topology(mesh);
    std::vector<Index> labels{0, 1, 0, 1, 1};
    CHECK(repair(mesh, topology, labels) == 3);
    CHECK(labels == std::vector<Index>{0, 1, 2, 3, 4});
}

TEST_CASE("the checker finds what is wrong")
{
    const PolygonMesh mesh = quad_grid(2, 2);
    const Topology topology = make_topology(mesh);
    CHECK(!first_defect(mesh, topology, std::vector<Index>{0, 0, 1, 1}));
    CHECK(first_defect(mesh, topology, std::vector<Index>{0, 1, 2, 0}) ==
          "Part 0 is not connected: face 3 lies apart.");
    const PolygonMesh ring = quad_grid(3, 3);
    const Topology ring_topology = make_topology(ring);
    CHECK(first_defect(ring, ring_topology, std::vector<Index>{0, 0, 0, 0, 1, 0, 0, 0, 1}) ==
          "Part 1 is not connected: face 8 lies apart.");
    const std::vector<Index> pinched{0, 1, 1, 0, 0, 1, 1, 0, 0};
    CHECK(first_defect(ring, ring_topology, pinched));
}
