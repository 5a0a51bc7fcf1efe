#include <algorithm>
#include <random>

#include <doctest/doctest.h>

#include "partition/cut/components.h"
#include "partition/cut/seams.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Σ over vertices of kind Interior of the pairs of faces with different labels.
Index raggedness(const NamedMesh& m, const std::vector<Index>& labels)
{
    Index pairs = 0;
    for (Index v = 0; v < m.mesh.n_vertices(); ++v) {
        if (m.topology.kind[at(v)] != VertexKind::Interior)
            continue;
        const auto corners = m.topology.corners_at(v);
        for (const Index a : corners)
            for (const Index b : corners)
                pairs += labels[at(m.topology.face_of[at(a)])] < labels[at(m.topology.face_of[at(b)])] ? 1 : 0;
    }
    return pairs;
}

NamedMesh named(PolygonMesh mesh)
{
    Topology topology = make_topology(mesh);
    return {"", std::move(mesh), std::move(topology)};
}

}  // namespace

TEST_CASE("every round lessens the pairs of different faces at vertices, until nothing changes")
{
    std::mt19937 random(7);
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        std::vector<Index> labels(at(m.mesh.n_faces()));
        for (Index& label : labels)
            label = static_cast<Index>(random() % 3);
        for (int round = 0; round < 20; ++round) {
            const std::vector<Index> before = labels;
            straighten_seams(m.mesh, m.topology, labels, 1);
            if (labels != before)
                CHECK(raggedness(m, labels) < raggedness(m, before));
        }
    }
}

TEST_CASE("several rounds at once are the same as one after the other, however loops are run")
{
    const NamedMesh m = named(triangle_torus(40, 40));
    std::mt19937 random(3);
    std::vector<Index> together(at(m.mesh.n_faces()));
    for (Index& label : together)
        label = static_cast<Index>(random() % 4);
    std::vector<Index> one_by_one = together;
    const Loop backwards = [](Index n, const LoopBody& body) {
        for (Index i = n; i > 0; --i)
            body(i - 1, i);
    };
    straighten_seams(m.mesh, m.topology, together, 5, backwards);
    for (int round = 0; round < 5; ++round)
        straighten_seams(m.mesh, m.topology, one_by_one, 1);
    CHECK(together == one_by_one);
}

TEST_CASE("a spike is cut off, a straight seam stays, and labels stay within their components")
{
    const NamedMesh grid = named(quad_grid(8, 6));
    std::vector<Index> straight(48);
    for (Index f = 0; f < 48; ++f)
        straight[at(f)] = f % 8 < 4 ? 0 : 1;
    std::vector<Index> unchanged = straight;
    straighten_seams(grid.mesh, grid.topology, unchanged, 3);
    CHECK(unchanged == straight);
    // A spike three faces long goes but for its root, where the two labels weigh the same.
    std::vector<Index> spiked = straight;
    for (Index f = 3 * 8 + 4; f < 3 * 8 + 7; ++f)
        spiked[at(f)] = 0;
    straighten_seams(grid.mesh, grid.topology, spiked, 3);
    straight[at(3 * 8 + 4)] = 0;
    CHECK(spiked == straight);

    const NamedMesh m = named(hourglass());
    const FaceComponents components = face_components(m.mesh, m.topology);
    std::vector<Index> labels = components.component;
    straighten_seams(m.mesh, m.topology, labels, 3);
    CHECK(labels == components.component);
}

TEST_CASE("mixed vertices are those whose faces differ")
{
    const NamedMesh m = named(quad_grid(2, 1));
    CHECK(mixed_vertices(m.topology, std::vector<Index>{0, 1}) == std::vector<Index>{1, 4});
    CHECK(mixed_vertices(m.topology, std::vector<Index>{5, 5}).empty());
}
