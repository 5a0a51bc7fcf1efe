#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <thread>

#include <doctest/doctest.h>

#include "partition/cut/divide.h"
#include "samples/meshes/meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

struct Divided {
    FaceGraph graph;
    Components components;
    std::vector<Index> labels;
};

Divided divided(const PolygonMesh& mesh, Index cluster_weight, Index k)
{
    const Topology topology = make_topology(mesh);
    Divided result;
    result.graph = make_face_graph(mesh, topology, grow_clusters(mesh, topology, cluster_weight), ArcMeasure::Count);
    result.components = graph_components(result.graph);
    result.labels = divide(result.graph, result.components, k);
    return result;
}

FaceGraph face_graph_of(const PolygonMesh& mesh)
{
    const Topology topology = make_topology(mesh);
    return make_face_graph(mesh, topology, grow_clusters(mesh, topology, 1), ArcMeasure::Length);
}

std::vector<Index> equal(Index k)
{
    return std::vector<Index>(static_cast<std::size_t>(k), 1);
}

std::vector<Index> sizes(const std::vector<Index>& labels, Index k)
{
    std::vector<Index> result(static_cast<std::size_t>(k), 0);
    for (const Index label : labels)
        ++result[static_cast<std::size_t>(label)];
    return result;
}

}  // namespace

TEST_CASE("parts are balanced, in one stage and in two")
{
    const PolygonMesh mesh = make_triangles(12000);
    for (const Index k : {2, 7, 64, 65, 130, 401}) {
        CAPTURE(k);
        const Divided d = divided(mesh, 1, k);
        std::vector<double> weight(k, 0.0);
        for (std::size_t node = 0; node < d.labels.size(); ++node)
            weight[d.labels[node]] += d.graph.node_weights[node];
        CHECK(*std::max_element(weight.begin(), weight.end()) < 1.1 * mesh.n_faces() / k);
        CHECK(*std::min_element(weight.begin(), weight.end()) > 0.8 * mesh.n_faces() / k);
        CHECK(divided(mesh, 1, k).labels == d.labels);
    }
}

TEST_CASE("no part lies in two components, and every component has one")
{
    std::vector<PolygonMesh> many(30, quad_grid(2, 2));
    many.push_back(quad_torus(20, 20));
    const PolygonMesh mesh = side_by_side(many);
    for (const Index k : {1, 5, 100}) {
        const Divided d = divided(mesh, 1, k);
        std::vector<std::set<Index>> components_of_part(usize(k) + 31);
        for (std::size_t node = 0; node < d.labels.size(); ++node)
            components_of_part[d.labels[node]].insert(d.components.component_of[node]);
        Index parts = 0;
        for (const auto& components : components_of_part) {
            CHECK(components.size() <= 1);
            parts += components.empty() ? 0 : 1;
        }
        CHECK(parts >= 31);
    }
}

TEST_CASE("what is left over goes to the components that lack the most")
{
    // Of three parts 1.95 and 1.05 are due, of two 1.3 and 0.7.
    const PolygonMesh two = side_by_side({quad_grid(13, 10), quad_grid(7, 10)});
    for (const Index k : {2, 3}) {
        const Divided d = divided(two, 1, k);
        std::vector<std::set<Index>> parts_of_component(2);
        for (std::size_t node = 0; node < d.labels.size(); ++node)
            parts_of_component[d.components.component_of[node]].insert(d.labels[node]);
        CHECK(parts_of_component[0].size() == usize(k) - 1);
        CHECK(parts_of_component[1].size() == 1);
    }
}

TEST_CASE("there may be about as many parts as nodes, or more")
{
    for (const Index k : {20, 64, 100, 399, 400, 401, 1000})
        CHECK(divided(quad_torus(20, 20), 1, k).labels.size() == 400);
    CHECK(divided(PolygonMesh{}, 1, 3).labels.empty());
}

TEST_CASE("parts are balanced, none is empty, and the result is reproducible")
{
    const FaceGraph graph = face_graph_of(quad_torus(60, 60));
    for (const Index k : {2, 3, 8, 50, 70, 200, 300}) {
        CAPTURE(k);
        const auto labels = metis_k_way(graph, equal(k));
        REQUIRE(labels.size() == 3600);
        CHECK(*std::min_element(labels.begin(), labels.end()) >= 0);
        CHECK(*std::max_element(labels.begin(), labels.end()) < k);
        const auto size = sizes(labels, k);
        CHECK(*std::min_element(size.begin(), size.end()) > 0);
        CHECK(*std::max_element(size.begin(), size.end()) <= 3600 / k * 3 / 2 + 1);
        CHECK(metis_k_way(graph, equal(k)) == labels);
    }
}

TEST_CASE("one part needs no partitioning, and no graph is too small")
{
    CHECK(metis_k_way(face_graph_of(quad_grid(3, 2)), equal(1)) == std::vector<Index>(6, 0));
    CHECK(metis_k_way(FaceGraph{}, equal(5)).empty());
    CHECK(metis_k_way(face_graph_of(quad_grid(1, 1)), equal(5)) == std::vector<Index>{0});
    for (Index n = 2; n < 12; ++n)
        for (Index k = 2; k < 15; ++k)
            CHECK(metis_k_way(face_graph_of(quad_grid(n, 1)), equal(k)).size() == static_cast<std::size_t>(n));
}

TEST_CASE("parts get weight in proportion to their shares")
{
    const FaceGraph graph = face_graph_of(quad_torus(60, 60));
    const std::vector<Index> shares{1, 2, 5};
    const auto size = sizes(metis_k_way(graph, shares), 3);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(size[i] == relative(450.0 * shares[i], 0.05));
}

TEST_CASE("a graph need not be connected")
{
    const auto size =
        sizes(metis_k_way(face_graph_of(side_by_side({quad_grid(20, 20), quad_grid(20, 20)})), equal(4)), 4);
    CHECK(*std::min_element(size.begin(), size.end()) > 150);
}

TEST_CASE("callers from several threads get what they would get alone")
{
    const FaceGraph graph = face_graph_of(triangle_torus(30, 30));
    const auto alone = metis_k_way(graph, equal(9));
    std::vector<std::vector<Index>> together(4);
    std::vector<std::thread> threads;
    for (auto& labels : together)
        threads.emplace_back([&] { labels = metis_k_way(graph, equal(9)); });
    for (auto& thread : threads)
        thread.join();
    for (const auto& labels : together)
        CHECK(labels == alone);
}

TEST_CASE("the caller's random numbers go on as if nobody had drawn from them")
{
    const FaceGraph graph = face_graph_of(triangle_torus(20, 20));
    const auto drawn = [&](bool divides) {
        std::array<int, 20> numbers{};
        std::srand(7);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (divides && i % 5 == 0)
                metis_k_way(graph, equal(6));
            numbers[i] = std::rand();
        }
        return numbers;
    };
    CHECK(drawn(true) == drawn(false));
}
