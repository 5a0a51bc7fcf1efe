#include <doctest/doctest.h>

#include "partition/labels.h"
#include "partition/repair/loose_components.h"
#include "partition/repair/pinches.h"
#include "tests/support/cut_checks.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("loose components join their neighbours, and merging mends every pinch that is left")
{
    for (const NamedMesh& m : assorted_meshes())
        for (const Index k : {2, 3, 6, 40})
            for (std::uint32_t seed = 0; seed < 12; ++seed) {
                CAPTURE(m.name);
                CAPTURE(k);
                CAPTURE(seed);
                auto labels = random_labels(m.mesh.n_faces(), k, seed);
                const Index n_labels = split_by_component(m.mesh, m.topology, compact_labels(labels), labels);
                const std::vector<bool> all(static_cast<std::size_t>(n_labels), true);
                join_loose_components(m.mesh, m.topology, all, labels);
                CHECK(join_loose_components(m.mesh, m.topology, all, labels).empty());
                auto compact = labels;
                CHECK(compact_labels(compact) == n_labels);

                merge_pinched(m.mesh, m.topology, n_labels, labels);
                CHECK_MESSAGE(!first_defect(m.mesh, m.topology, labels),
                              first_defect(m.mesh, m.topology, labels).value_or(""));
            }
}

TEST_CASE("the smaller part is merged into the larger")
{
    const PolygonMesh mesh = quad_grid(3, 3);
    const Topology topology = make_topology(mesh);
    // Part 1 is pinched between the middle and the right below; 2 is the smaller of the parts beside.
    std::vector<Index> labels{1, 1, 1,  //
                              1, 1, 2,  //
                              0, 0, 1};
    merge_pinched(mesh, topology, 3, labels);
    CHECK(labels == std::vector<Index>{1, 1, 1, 1, 1, 1, 0, 0, 1});
}

TEST_CASE("an interior vertex may be pinched if it is, any other may be as soon as it is mixed")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        auto labels = random_labels(m.mesh.n_faces(), 3, 5);
        PinchMender mender(m.mesh, m.topology, labels, 3);
        for (Index v = 0; v < m.mesh.n_vertices(); ++v) {
            const bool may_be = may_be_pinched(m.mesh, m.topology, labels, v);
            if (m.topology.kind[v] != VertexKind::Interior) {
                CHECK(may_be == is_mixed(m.topology, labels, v));
                continue;
            }
            Index excess = 0;
            for (const Index label : {0, 1, 2})
                if (const auto n = fans_at(m.mesh, m.topology, v, labels, label).size(); n > 1)
                    excess += static_cast<Index>(n) - 1;
            CHECK(mender.pinches_at(v) == excess);
            CHECK(may_be == (excess > 0));
        }
    }
}
