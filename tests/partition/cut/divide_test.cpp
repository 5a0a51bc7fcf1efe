#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "partition/cut/divide.h"
#include "samples/common/meshes.h"
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
        std::vector<std::set<Index>> components_of_part(at(k) + 31);
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
        CHECK(parts_of_component[0].size() == at(k) - 1);
        CHECK(parts_of_component[1].size() == 1);
    }
}

TEST_CASE("there may be about as many parts as nodes, or more")
{
    for (const Index k : {20, 64, 100, 399, 400, 401, 1000})
        CHECK(divided(quad_torus(20, 20), 1, k).labels.size() == 400);
    CHECK(divided(PolygonMesh{}, 1, 3).labels.empty());
}
