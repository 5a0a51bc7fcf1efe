#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "partition/decomposition/grown_part.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

constexpr int reach = 2;

GrownPart grown_part(const CutMesh& cut, int layers, Index s)
{
    const std::vector<Index> rank(cut.n_parts, 0);
    return make_grown_part(cut.mesh, cut.topology, {cut.labels, rank, layers}, reach, s,
                           faces_by_label(cut.labels, cut.n_parts)[s]);
}

/// The faces that share a vertex with one of these, these among them.
std::set<Index> with_neighbours(const CutMesh& cut, const std::set<Index>& faces)
{
    std::set<Index> grown;
    for (const Index f : faces)
        for (const Index v : cut.mesh.face(f))
            for (const Index corner : cut.topology.corners_at(v))
                grown.insert(cut.topology.face_of[corner]);
    return grown;
}

std::set<Index> movable_vertices(const CutMesh& cut, const std::set<Index>& faces)
{
    std::set<Index> vertices;
    for (const Index f : faces)
        for (const Index v : cut.mesh.face(f))
            if (cut.topology.kind[v] == VertexKind::Interior)
                vertices.insert(v);
    return vertices;
}

}  // namespace

TEST_CASE("a grown part has its layers' vertices as unknowns, and the faces that equations there reach")
{
    for (const CutMesh& cut : cut_meshes())
        for (const int layers : {0, 1, 2}) {
            CAPTURE(cut.name);
            CAPTURE(layers);
            const auto own_faces = faces_by_label(cut.labels, cut.n_parts);
            for (Index s = 0; s < cut.n_parts; ++s) {
                const auto& [sub_mesh, unknowns] = grown_part(cut, layers, s);
                std::set<Index> faces(own_faces[s].begin(), own_faces[s].end());
                for (int layer = 0; layer < layers; ++layer)
                    faces = with_neighbours(cut, faces);
                std::set<Index> found;
                for (const Index u : unknowns)
                    found.insert(sub_mesh.local_to_global[u]);
                CHECK(found == movable_vertices(cut, faces));
                CHECK(std::is_sorted(unknowns.begin(), unknowns.end()));
                for (int layer = 0; layer < reach; ++layer)
                    faces = with_neighbours(cut, faces);
                CHECK(std::equal(faces.begin(), faces.end(), sub_mesh.faces.begin(), sub_mesh.faces.end()));
                for (Index v = 0; v < sub_mesh.n_vertices; ++v)
                    CHECK((sub_mesh.fixed[v] == 0) ==
                          (cut.topology.kind[sub_mesh.local_to_global[v]] == VertexKind::Interior));
            }
        }
}

TEST_CASE("exactly one grown part owns each vertex that may move, and has its faces as its own")
{
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        std::vector<Index> owners(cut.mesh.n_vertices(), 0);
        for (Index s = 0; s < cut.n_parts; ++s) {
            const GrownPart part = grown_part(cut, 1, s);
            for (Index v = 0; v < part.sub_mesh.n_vertices; ++v) {
                if (part.sub_mesh.owned[v] == 0)
                    continue;
                const Index global = part.sub_mesh.local_to_global[v];
                ++owners[global];
                CHECK(std::binary_search(part.unknowns.begin(), part.unknowns.end(), v));
                const auto corners = cut.topology.corners_at(global);
                CHECK(std::any_of(corners.begin(), corners.end(),
                                  [&](Index c) { return cut.labels[cut.topology.face_of[c]] == s; }));
            }
        }
        for (Index v = 0; v < cut.mesh.n_vertices(); ++v)
            CHECK(owners[v] == (cut.topology.kind[v] == VertexKind::Interior ? 1 : 0));
    }
}
