#include <algorithm>
#include <array>
#include <cstdlib>
#include <thread>

#include <doctest/doctest.h>

#include "partition/cut/metis.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

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
        CHECK(size[i] == doctest::Approx(450.0 * shares[i]).epsilon(0.05));
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
