#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

#include <doctest/doctest.h>

#include "partition/connected_components.h"
#include "partition/cut/face_graph.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

FaceGraph graph_of(const PolygonMesh& mesh, Index cluster_weight = 1, ArcMeasure measure = ArcMeasure::Length)
{
    const Topology topology = make_topology(mesh);
    return make_face_graph(mesh, topology, grow_clusters(mesh, topology, cluster_weight), measure);
}

/// The weight of the arc from one node to another, 0 if there is none.
Index weight(const FaceGraph& graph, Index from, Index to)
{
    const auto first = static_cast<std::size_t>(graph.offsets[static_cast<std::size_t>(from)]);
    const auto last = static_cast<std::size_t>(graph.offsets[static_cast<std::size_t>(from) + 1]);
    for (std::size_t i = first; i < last; ++i)
        if (graph.targets[i] == to)
            return graph.arc_weights[i];
    return 0;
}

double sum(const std::vector<Index>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("the graph is symmetric, without loops or double arcs, and its weights are bounded")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        const FaceGraph graph = graph_of(m.mesh);
        REQUIRE(graph.n_nodes() == m.mesh.n_faces());
        CHECK(graph.targets.size() == graph.arc_weights.size());
        CHECK(sum(graph.arc_weights) <= max_weight_sum);
        CHECK(sum(graph.node_weights) <= max_weight_sum);
        for (Index i = 0; i < graph.n_nodes(); ++i) {
            const auto first = graph.targets.begin() + graph.offsets[static_cast<std::size_t>(i)];
            const auto last = graph.targets.begin() + graph.offsets[static_cast<std::size_t>(i) + 1];
            CHECK(std::adjacent_find(first, last, std::greater_equal<>()) == last);
            for (auto target = first; target != last; ++target) {
                CHECK(*target != i);
                CHECK(weight(graph, i, *target) >= 1);
                CHECK(weight(graph, i, *target) == weight(graph, *target, i));
            }
        }
    }
}

TEST_CASE("a torus of quads has four neighbours everywhere, a grid fewer at its border")
{
    const FaceGraph torus = graph_of(quad_torus(5, 4));
    for (std::size_t i = 0; i < 20; ++i)
        CHECK(torus.offsets[i + 1] - torus.offsets[i] == 4);
    CHECK(graph_of(quad_grid(3, 2)).targets.size() == 14);
}

TEST_CASE("arc weights are in proportion to edge lengths, whatever the unit")
{
    PolygonMesh mesh = quad_grid(2, 2);
    mesh.vertices.col(0) *= 3;
    for (const double unit : {1e-100, 1e-6, 1.0, 1e100}) {
        PolygonMesh scaled = mesh;
        scaled.vertices *= unit;
        const FaceGraph graph = graph_of(scaled);
        CHECK(weight(graph, 0, 1) == 32);
        CHECK(weight(graph, 0, 2) == 96);
    }
}

TEST_CASE("edges shared by the same two faces add up")
{
    PolygonMesh mesh;
    mesh.vertices.resize(5, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 1, 0, 1, -1, 0;
    mesh.add_face(std::array<Index, 4>{0, 1, 2, 3});
    mesh.add_face(std::array<Index, 4>{2, 1, 0, 4});
    const FaceGraph graph = graph_of(mesh);
    CHECK(graph.targets == std::vector<Index>{1, 0});
    CHECK(graph.node_weights == std::vector<Index>{2, 2});
}

TEST_CASE("lengths without a finite sum count as equal")
{
    for (const double factor : {0.0, 1e308}) {
        PolygonMesh mesh = quad_grid(2, 2);
        mesh.vertices *= factor;
        const FaceGraph graph = graph_of(mesh);
        CHECK(graph.arc_weights == std::vector<Index>(graph.targets.size(), 1));
    }
}

TEST_CASE("induced subgraphs keep the arcs within their parts")
{
    const auto parts = induced_subgraphs(graph_of(quad_grid(4, 1)), std::vector<Index>{2, 0, 0, 2}, 3);
    REQUIRE(parts.size() == 3);
    CHECK(parts[0].offsets == std::vector<Index>{0, 1, 2});
    CHECK(parts[0].targets == std::vector<Index>{1, 0});
    CHECK(parts[0].arc_weights == std::vector<Index>{64, 64});
    CHECK(parts[0].node_weights == std::vector<Index>{2, 2});
    CHECK(parts[1].n_nodes() == 0);
    CHECK(parts[2].n_nodes() == 2);
    CHECK(parts[2].targets.empty());
}

TEST_CASE("node weights count the triangles of a face")
{
    CHECK(graph_of(hexagon_sheet(2, 1)).node_weights == std::vector<Index>{4, 4});
    CHECK(graph_of(triangle_grid(1, 1)).node_weights == std::vector<Index>{1, 1});
}

TEST_CASE("the graph of clusters weighs as much as that of the faces, and has fewer nodes and arcs")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        const FaceGraph fine = graph_of(m.mesh);
        const FaceGraph coarse = graph_of(m.mesh, 6);
        CHECK(sum(coarse.node_weights) == sum(fine.node_weights));
        CHECK(coarse.n_nodes() <= fine.n_nodes());
        CHECK(coarse.targets.size() <= fine.targets.size());
        for (Index i = 0; i < coarse.n_nodes(); ++i)
            for (Index arc = coarse.offsets[i]; arc < coarse.offsets[i + 1]; ++arc)
                CHECK(weight(coarse, coarse.targets[arc], i) == coarse.arc_weights[arc]);
    }
}

TEST_CASE("edges may count alike, however long")
{
    PolygonMesh mesh = quad_grid(2, 2);
    mesh.vertices.col(0) *= 3;
    const FaceGraph graph = graph_of(mesh, 1, ArcMeasure::Count);
    CHECK(graph.arc_weights == std::vector<Index>(8, 64));
}

TEST_CASE("the components of a graph are those of its faces")
{
    for (const NamedMesh& m : assorted_meshes())
        for (const Index weight : {1, 2, 5, 30, 1000}) {
            CAPTURE(m.name);
            CAPTURE(weight);
            const FaceClusters clusters = grow_clusters(m.mesh, m.topology, weight);
            const Components components =
                graph_components(make_face_graph(m.mesh, m.topology, clusters, ArcMeasure::Count));
            const Components of_faces = face_components(m.mesh, m.topology);
            CHECK(components.count() == of_faces.count());
            for (Index f = 0; f < m.mesh.n_faces(); ++f)
                CHECK(components.component_of[clusters.cluster_of[f]] == of_faces.component_of[f]);
        }
}
