#include <algorithm>

#include <doctest/doctest.h>

#include "partition/cut/seams.h"
#include "partition/labels.h"
#include "partition/repair/fans.h"
#include "partition/repair/pinches.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

std::vector<Index> sorted(std::vector<Index> values)
{
    std::sort(values.begin(), values.end());
    return values;
}

/// The faces of each fan, sorted, the fans sorted.
std::vector<std::vector<Index>> face_sets(const Topology& topology, const std::vector<Fan>& fans)
{
    std::vector<std::vector<Index>> sets;
    for (const Fan& fan : fans) {
        auto& set = sets.emplace_back();
        for (const Index corner : fan.corners)
            set.push_back(topology.face_of[static_cast<std::size_t>(corner)]);
        std::sort(set.begin(), set.end());
    }
    std::sort(sets.begin(), sets.end());
    return sets;
}

/// Whether the two faces have an edge at v in common.
bool share_edge_at(const PolygonMesh& mesh, const Topology& topology, Index v, Index f, Index g)
{
    const auto shares = [&](Index h) {
        const Index twin = topology.twin[static_cast<std::size_t>(h)];
        return twin >= 0 && topology.face_of[static_cast<std::size_t>(twin)] == g;
    };
    for (const Index corner : topology.corners_at(v))
        if (topology.face_of[static_cast<std::size_t>(corner)] == f)
            return shares(corner) || shares(topology.previous(mesh, corner));
    return false;
}

/// Faces with a label around v, joined by repeated merging of sets that share an edge at v.
std::vector<std::vector<Index>> fans_by_merging(const PolygonMesh& mesh, const Topology& topology, Index v,
                                                const std::vector<Index>& labels, Index label)
{
    std::vector<std::vector<Index>> sets;
    for (const Index corner : topology.corners_at(v)) {
        const Index f = topology.face_of[static_cast<std::size_t>(corner)];
        if (labels[static_cast<std::size_t>(f)] != label)
            continue;
        std::vector<Index> joined{f};
        std::erase_if(sets, [&](const std::vector<Index>& set) {
            const bool joins =
                std::any_of(set.begin(), set.end(), [&](Index g) { return share_edge_at(mesh, topology, v, f, g); });
            if (joins)
                joined.insert(joined.end(), set.begin(), set.end());
            return joins;
        });
        sets.push_back(sorted(joined));
    }
    std::sort(sets.begin(), sets.end());
    return sets;
}

}  // namespace

TEST_CASE("the walker finds the fans of the whole mesh")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        FanWalker walker(m.mesh, m.topology);
        for (Index v = 0; v < m.mesh.n_vertices(); ++v) {
            const auto expected = fans_at(m.mesh, m.topology, v, {}, 0);
            const auto fans = walker.at_vertex(v);
            std::vector<std::vector<Index>> sets;
            for (const FanWalker::Fan& fan : fans) {
                sets.push_back(sorted({fan.faces.begin(), fan.faces.end()}));
                for (std::size_t i = fan.closed ? 0 : 1; i < fan.faces.size(); ++i)
                    CHECK(share_edge_at(m.mesh, m.topology, v, fan.faces[i],
                                        fan.faces[(i + fan.faces.size() - 1) % fan.faces.size()]));
            }
            std::sort(sets.begin(), sets.end());
            CHECK(sets == face_sets(m.topology, expected));
            if (expected.size() == 1) {
                CHECK(fans.front().closed == expected.front().closed);
                CHECK(fans.front().closed == (m.topology.kind[static_cast<std::size_t>(v)] == VertexKind::Interior));
            }
        }
    }
}

TEST_CASE("an interior vertex may be pinched if it is, any other may be as soon as it is mixed")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        auto labels = random_labels(m.mesh.n_faces(), 3, 5);
        PinchMender mender(m.mesh, m.topology, labels, 3);
        for (Index v = 0; v < m.mesh.n_vertices(); ++v) {
            const bool may_be = may_be_pinched(m.mesh, m.topology, labels, v);
            if (m.topology.kind[static_cast<std::size_t>(v)] == VertexKind::Interior)
                CHECK(may_be == (mender.pinches_at(v) > 0));
            else
                CHECK(may_be == is_mixed(m.topology, labels, v));
        }
    }
}

TEST_CASE("fans of a part are the sets of its faces joined by edges")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        const auto labels = random_labels(m.mesh.n_faces(), 2, 5);
        for (Index v = 0; v < m.mesh.n_vertices(); ++v)
            for (const Index label : {0, 1})
                CHECK(face_sets(m.topology, fans_at(m.mesh, m.topology, v, labels, label)) ==
                      fans_by_merging(m.mesh, m.topology, v, labels, label));
    }
}
