#include <algorithm>

#include <doctest/doctest.h>

#include "partition/cut/refine.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// A mesh whose faces are the nodes of a graph.
struct Graph {
    explicit Graph(PolygonMesh whole)
        : mesh(std::move(whole))
        , topology(make_topology(mesh))
        , faces(make_face_graph(mesh, topology, grow_clusters(mesh, topology, 1), ArcMeasure::Count))
    {
    }

    /// By the row of quads.
    template <class LabelAt>
    [[nodiscard]] std::vector<Index> labels_by_row(Index quads_per_row, LabelAt&& label_at) const
    {
        std::vector<Index> labels(mesh.n_faces());
        for (Index f = 0; f < mesh.n_faces(); ++f)
            labels[f] = label_at(f / quads_per_row);
        return labels;
    }

    PolygonMesh mesh;
    Topology topology;
    FaceGraph faces;
};

Index count(const std::vector<Index>& labels, Index label)
{
    return static_cast<Index>(std::count(labels.begin(), labels.end(), label));
}

}  // namespace

TEST_CASE("loose components go to the parts across most of their edges, rings of them too")
{
    const Graph graph(quad_grid(12, 12));
    std::vector<Index> labels = graph.labels_by_row(12, [](Index row) { return row < 6 ? 0 : 1; });
    const std::vector<Index> whole = labels;
    CHECK(!join_loose_components(graph.faces, 3, labels));
    CHECK(labels == whole);
    // A ring of part 1 within part 0 and a component of part 2, which has another one, in its middle.
    for (Index row = 1; row < 4; ++row)
        for (Index column = 4; column < 7; ++column)
            labels[row * 12 + column] = row == 2 && column == 5 ? 2 : 1;
    labels[11 * 12] = labels[11 * 12 + 1] = 2;
    std::vector<Index> expected = whole;
    expected[11 * 12] = expected[11 * 12 + 1] = 2;
    CHECK(join_loose_components(graph.faces, 3, labels));
    CHECK(labels == expected);
}

TEST_CASE("refined parts are balanced and connected")
{
    const Graph graph(quad_grid(30, 30));
    std::vector<Index> labels = graph.labels_by_row(30, [](Index row) { return row < 16 ? 0 : row < 27 ? 1 : 2; });
    refine(graph.faces, 3, labels);
    for (Index label = 0; label < 3; ++label) {
        CHECK(count(labels, label) <= 300 * (1.0 + balance_tolerance) + 1);
        CHECK(count(labels, label) >= 300 / (1.0 + balance_tolerance) - 1);
    }
    CHECK(!join_loose_components(graph.faces, 3, labels));
}

TEST_CASE("a balanced cut along straight lines is left as it is")
{
    const Graph graph(quad_grid(20, 20));
    const std::vector<Index> before = graph.labels_by_row(20, [](Index row) { return row / 5; });
    std::vector<Index> labels = before;
    refine(graph.faces, 4, labels);
    CHECK(labels == before);
}
