#include <algorithm>

#include <doctest/doctest.h>

#include "partition/connected_components.h"
#include "partition/cut/part_boundaries.h"
#include "partition/cut/refine.h"
#include "partition/labels.h"
#include "tests/support/backwards.h"
#include "tests/support/cut_checks.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// The number of edges between faces of different labels.
Index cut_edges(const NamedMesh& m, const std::vector<Index>& labels)
{
    Index n = 0;
    for (Index h = 0; h < m.mesh.n_corners(); ++h)
        if (const Index twin = m.topology.twin[h]; twin > h)
            n += labels[m.topology.face_of[h]] != labels[m.topology.face_of[twin]] ? 1 : 0;
    return n;
}

std::vector<double> weights(const PolygonMesh& mesh, const std::vector<Index>& labels, Index n_labels)
{
    std::vector<double> weight(n_labels, 0.0);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        weight[labels[f]] += face_weight(mesh, f);
    return weight;
}

}  // namespace

TEST_CASE("fewer edges are cut, and no label enters another component")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        std::vector<Index> labels = random_labels(m.mesh.n_faces(), 3, 7);
        const Index before = cut_edges(m, labels);
        shorten_boundaries(m.mesh, m.topology, 3, labels);
        CHECK(cut_edges(m, labels) <= before);

        const Components components = face_components(m.mesh, m.topology);
        std::vector<Index> whole = components.component_of;
        shorten_boundaries(m.mesh, m.topology, components.count(), whole);
        CHECK(whole == components.component_of);
    }
}

TEST_CASE("parts in balance remain so, and the result does not depend on how loops are run")
{
    const NamedMesh m = with_topology(triangle_torus(40, 40));
    std::vector<Index> labels = random_labels(m.mesh.n_faces(), 4, 7);
    std::vector<Index> other = labels;
    const auto before = weights(m.mesh, labels, 4);
    const Index cut_before = cut_edges(m, labels);
    shorten_boundaries(m.mesh, m.topology, 4, labels);
    CHECK(cut_edges(m, labels) < cut_before * 2 / 3);
    const auto after = weights(m.mesh, labels, 4);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(after[i] <= std::max(before[i], 800 * (1.0 + balance_tolerance)));
        CHECK(after[i] >= std::min(before[i], 800 / (1.0 + balance_tolerance) - 1.0));
    }
    shorten_boundaries(m.mesh, m.topology, 4, other, run_backwards);
    CHECK(other == labels);
}

TEST_CASE("a spike is cut off, a straight seam stays")
{
    const NamedMesh grid = with_topology(quad_grid(16, 12));
    std::vector<Index> straight(grid.mesh.n_faces());
    for (Index f = 0; f < grid.mesh.n_faces(); ++f)
        straight[f] = f % 16 < 8 ? 0 : 1;
    std::vector<Index> labels = straight;
    shorten_boundaries(grid.mesh, grid.topology, 2, labels);
    CHECK(labels == straight);
    for (Index f = 6 * 16 + 8; f < 6 * 16 + 11; ++f)
        labels[f] = 0;
    shorten_boundaries(grid.mesh, grid.topology, 2, labels);
    CHECK(labels == straight);
}

TEST_CASE("a part that is too heavy gives faces to its neighbours until it is not, and stays whole")
{
    const NamedMesh m = with_topology(triangle_torus(40, 40));
    std::vector<Index> labels(m.mesh.n_faces());
    for (Index f = 0; f < m.mesh.n_faces(); ++f)
        labels[f] = f < m.mesh.n_faces() * 55 / 100 ? 0 : 1;
    const Index before = cut_edges(m, labels);
    shorten_boundaries(m.mesh, m.topology, 2, labels);
    for (const double weight : weights(m.mesh, labels, 2))
        CHECK(weight <= 0.5 * m.mesh.n_faces() * (1.0 + balance_tolerance));
    CHECK(cut_edges(m, labels) < before * 5 / 4);
    CHECK(!first_defect(m.mesh, m.topology, labels));
}

TEST_CASE("however far a seam moves, what is there then is suspected")
{
    const NamedMesh m = with_topology(triangle_torus(40, 40));
    std::vector<Index> labels(m.mesh.n_faces());
    for (Index f = 0; f < m.mesh.n_faces(); ++f)
        labels[f] = f < m.mesh.n_faces() * 70 / 100 ? 0 : 1;
    const auto seam_before = mixed_vertices(m.topology, labels);
    const SuspectedDefects defects = shorten_boundaries(m.mesh, m.topology, 2, labels);
    std::vector<bool> suspected(m.mesh.n_vertices(), false);
    for (const Index f : defects.faces)
        for (const Index v : m.mesh.face(f))
            suspected[v] = true;
    Index n_new = 0;
    for (const Index v : mixed_vertices(m.topology, labels)) {
        CHECK(suspected[v]);
        n_new += std::binary_search(seam_before.begin(), seam_before.end(), v) ? 0 : 1;
    }
    CHECK(n_new > 40);
}

TEST_CASE("mixed vertices are those whose faces differ")
{
    const NamedMesh m = with_topology(quad_grid(2, 1));
    CHECK(mixed_vertices(m.topology, std::vector<Index>{0, 1}) == std::vector<Index>{1, 4});
    CHECK(mixed_vertices(m.topology, std::vector<Index>{5, 5}).empty());
}
