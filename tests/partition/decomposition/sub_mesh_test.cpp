#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "partition/decomposition/make_sub_mesh.h"
#include "partition/decomposition/sub_mesh.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

std::vector<Index> to_global(const SubMesh& sub_mesh, std::span<const Index> vertices)
{
    std::vector<Index> global;
    for (const Index v : vertices)
        global.push_back(sub_mesh.local_to_global[v]);
    return global;
}

std::vector<Index> face_of(const PolygonMesh& mesh, Index f)
{
    return {mesh.face(f).begin(), mesh.face(f).end()};
}

bool is_ascending(std::span<const Index> values)
{
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

std::set<Index> labels_at(const CutMesh& cut, Index v)
{
    std::set<Index> labels;
    for (const Index corner : cut.topology.corners_at(v))
        labels.insert(cut.labels[cut.topology.face_of[corner]]);
    return labels;
}

Index label_of(const CutMesh& cut, const SubMesh& sub_mesh)
{
    return cut.labels[sub_mesh.faces.front()];
}

/// The faces of other sub-meshes that touch Γ, in ascending order, as the mesh tells.
std::vector<Index> halo_faces_of(const CutMesh& cut, const SubMesh& sub_mesh)
{
    std::set<Index> faces;
    for (const Index v : to_global(sub_mesh, sub_mesh.interface.vertices))
        for (const Index corner : cut.topology.corners_at(v))
            if (const Index f = cut.topology.face_of[corner]; cut.labels[f] != label_of(cut, sub_mesh))
                faces.insert(f);
    return {faces.begin(), faces.end()};
}

}  // namespace

TEST_CASE("the cuts are cuts: there are sub-meshes, interfaces and cross points to test")
{
    int n_cross_points = 0;
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        CHECK(cut.n_parts >= 2);
        for (Index v = 0; v < cut.mesh.n_vertices(); ++v)
            if (cut.topology.kind[v] == VertexKind::Interior && labels_at(cut, v).size() >= 3)
                ++n_cross_points;
    }
    CHECK(n_cross_points > 50);
}

TEST_CASE("local and global vertices correspond, and own vertices are those of the faces")
{
    for_each_sub_mesh([](const CutMesh& cut, const SubMesh& sub_mesh) {
        const std::span<const Index> all = sub_mesh.local_to_global;
        REQUIRE(all.size() == usize(sub_mesh.n_vertices + sub_mesh.n_halo));
        CHECK(is_ascending(all.first(sub_mesh.n_vertices)));
        CHECK(is_ascending(all.subspan(sub_mesh.n_vertices)));
        std::set<Index> own;
        for (const Index f : sub_mesh.faces)
            own.insert(cut.mesh.face(f).begin(), cut.mesh.face(f).end());
        CHECK(std::equal(own.begin(), own.end(), all.begin(), all.begin() + sub_mesh.n_vertices));
        for (Index v = 0; v < cut.mesh.n_vertices(); ++v) {
            const Index local = local_index(sub_mesh, v);
            CHECK((local >= 0) == own.contains(v));
            if (local >= 0)
                CHECK(sub_mesh.local_to_global[local] == v);
        }
    });
}

TEST_CASE("faces and twins are those of the mesh")
{
    for_each_sub_mesh([](const CutMesh& cut, const SubMesh& sub_mesh) {
        CHECK(is_ascending(sub_mesh.faces));
        REQUIRE(sub_mesh.face_vertices.size() == static_cast<Index>(sub_mesh.faces.size()));
        REQUIRE(sub_mesh.twin.size() == sub_mesh.face_vertices.values.size());
        std::vector<Index> whole_halfedge;
        for (Index f = 0; f < sub_mesh.face_vertices.size(); ++f) {
            const Index whole = sub_mesh.faces[f];
            CHECK(to_global(sub_mesh, sub_mesh.face_vertices[f]) == face_of(cut.mesh, whole));
            for (Index h = cut.mesh.face_offsets[whole]; h < cut.mesh.face_offsets[whole + 1]; ++h)
                whole_halfedge.push_back(h);
        }
        for (std::size_t h = 0; h < sub_mesh.twin.size(); ++h) {
            const Index twin = cut.topology.twin[whole_halfedge[h]];
            const bool inside = twin >= 0 && cut.labels[cut.topology.face_of[twin]] == label_of(cut, sub_mesh);
            REQUIRE((sub_mesh.twin[h] >= 0) == inside);
            if (inside)
                CHECK(whole_halfedge[sub_mesh.twin[h]] == twin);
        }
    });
}

TEST_CASE("vertices are fixed, on the interface or neither, as their kind and their faces tell")
{
    for_each_sub_mesh([](const CutMesh& cut, const SubMesh& sub_mesh) {
        const auto& vertices = sub_mesh.interface.vertices;
        CHECK(is_ascending(vertices));
        for (Index i = 0; i < sub_mesh.n_vertices; ++i) {
            const Index v = sub_mesh.local_to_global[i];
            const bool moves = cut.topology.kind[v] == VertexKind::Interior;
            CHECK((sub_mesh.fixed[i] == 1) == !moves);
            CHECK(std::binary_search(vertices.begin(), vertices.end(), i) == (moves && labels_at(cut, v).size() > 1));
        }
    });
}

TEST_CASE("the sub-mesh of the lowest label speaks for a vertex that may move, and for no other")
{
    for_each_sub_mesh([](const CutMesh& cut, const SubMesh& sub_mesh) {
        REQUIRE(sub_mesh.owned.size() == usize(sub_mesh.n_vertices));
        for (Index v = 0; v < sub_mesh.n_vertices; ++v) {
            const Index global = sub_mesh.local_to_global[v];
            const bool is_lowest = *labels_at(cut, global).begin() == label_of(cut, sub_mesh);
            CHECK((sub_mesh.owned[v] != 0) == (cut.topology.moves(global) && is_lowest));
        }
    });
}

TEST_CASE("own and complement faces of a vertex of the interface are all faces at it")
{
    for_each_sub_mesh([](const CutMesh& cut, const SubMesh& sub_mesh) {
        const auto& interface = sub_mesh.interface;
        REQUIRE(interface.own_faces.size() == interface.size());
        REQUIRE(interface.complement_faces.size() == interface.size());
        const auto halo_faces = halo_faces_of(cut, sub_mesh);
        for (Index i = 0; i < interface.size(); ++i) {
            std::set<Index> expected;
            const Index v = sub_mesh.local_to_global[interface.vertices[i]];
            for (const Index corner : cut.topology.corners_at(v))
                expected.insert(cut.topology.face_of[corner]);
            std::set<Index> found;
            for (const Index f : interface.own_faces[i]) {
                found.insert(sub_mesh.faces[f]);
                CHECK(cut.labels[sub_mesh.faces[f]] == label_of(cut, sub_mesh));
            }
            for (const Index f : interface.complement_faces[i]) {
                found.insert(halo_faces[f]);
                CHECK(cut.labels[halo_faces[f]] != label_of(cut, sub_mesh));
            }
            CHECK(found == expected);
            CHECK(interface.own_faces[i].size() + interface.complement_faces[i].size() == expected.size());
        }
    });
}

TEST_CASE("reduced to the faces at its interface, a sub-mesh has the same faces at each vertex there")
{
    for_each_sub_mesh([](const CutMesh&, const SubMesh& sub_mesh) {
        SubMesh reduced = sub_mesh;
        keep_faces_at_interface(reduced);
        const auto& all = sub_mesh.interface.own_faces.values;
        const auto& kept = reduced.interface.own_faces.values;
        REQUIRE(kept.size() == all.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            CHECK(std::ranges::equal(reduced.face_vertices[kept[i]], sub_mesh.face_vertices[all[i]]));
        CHECK(usize(reduced.face_vertices.size()) == std::set<Index>(all.begin(), all.end()).size());
    });
}

TEST_CASE("the halo is the faces of others that touch the interface, and their vertices")
{
    for_each_sub_mesh([](const CutMesh& cut, const SubMesh& sub_mesh) {
        const auto halo_faces = halo_faces_of(cut, sub_mesh);
        REQUIRE(sub_mesh.interface.halo_faces.size() == static_cast<Index>(halo_faces.size()));
        std::set<Index> halo;
        for (Index f = 0; f < sub_mesh.interface.halo_faces.size(); ++f) {
            const auto vertices = to_global(sub_mesh, sub_mesh.interface.halo_faces[f]);
            CHECK(vertices == face_of(cut.mesh, halo_faces[f]));
            std::copy_if(vertices.begin(), vertices.end(), std::inserter(halo, halo.end()),
                         [&](Index v) { return local_index(sub_mesh, v) < 0; });
        }
        CHECK(std::equal(halo.begin(), halo.end(), sub_mesh.local_to_global.begin() + sub_mesh.n_vertices,
                         sub_mesh.local_to_global.end()));
    });
}

TEST_CASE("before and after are the two neighbours along the sub-mesh's own boundary")
{
    for_each_sub_mesh([](const CutMesh&, const SubMesh& sub_mesh) {
        std::vector<std::set<Index>> along(sub_mesh.n_vertices);
        for (Index f = 0; f < sub_mesh.face_vertices.size(); ++f) {
            const auto corners = sub_mesh.face_vertices[f];
            for (std::size_t k = 0; k < corners.size(); ++k)
                if (sub_mesh.twin[sub_mesh.face_vertices.offsets[f] + k] < 0) {
                    const Index next = corners[(k + 1) % corners.size()];
                    along[corners[k]].insert(next);
                    along[next].insert(corners[k]);
                }
        }
        const auto& interface = sub_mesh.interface;
        for (Index i = 0; i < interface.size(); ++i) {
            CHECK(interface.before[i] != interface.after[i]);
            CHECK(along[interface.vertices[i]] == std::set<Index>{interface.before[i], interface.after[i]});
        }
    });
}

TEST_CASE("the neighbours of a vertex of the interface are the other ends of its edges")
{
    for_each_sub_mesh([](const CutMesh& cut, const SubMesh& sub_mesh) {
        for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
            std::set<Index> expected;
            for (const Index corner : cut.topology.corners_at(sub_mesh.local_to_global[sub_mesh.interface.vertices[i]]))
                for (const Index end : {cut.topology.next(cut.mesh, corner), cut.topology.previous(cut.mesh, corner)})
                    expected.insert(cut.mesh.face_vertices[end]);
            const auto found = to_global(sub_mesh, sub_mesh.corrected.neighbours[i]);
            CHECK(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
        }
    });
}
