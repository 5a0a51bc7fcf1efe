#include <set>

#include <doctest/doctest.h>

#include "partition/decomposition/separated_sub_meshes.h"
#include "partition/topology.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("separated, no two sub-meshes share a vertex, and everything keeps its place")
{
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        const SeparatedSubMeshes separated = separate(cut.mesh, decomposition);
        CHECK(separated.mesh.face_offsets == cut.mesh.face_offsets);
        CHECK(separated.mesh.vertices.topRows(cut.mesh.n_vertices()) == cut.mesh.vertices);
        for (std::size_t c = 0; c < cut.mesh.face_vertices.size(); ++c)
            CHECK(separated.mesh.vertices.row(separated.mesh.face_vertices[c]) ==
                  cut.mesh.vertices.row(cut.mesh.face_vertices[c]));

        std::set<Index> used;
        std::size_t n = 0;
        for (std::size_t s = 0; s < decomposition.sub_meshes.size(); ++s) {
            const SubMesh& sub_mesh = decomposition.sub_meshes[s];
            REQUIRE(separated.vertex_of[s].size() == usize(sub_mesh.n_vertices));
            used.insert(separated.vertex_of[s].begin(), separated.vertex_of[s].end());
            n += separated.vertex_of[s].size();
            for (std::size_t f = 0; f < sub_mesh.faces.size(); ++f) {
                const auto corners = sub_mesh.face_vertices[static_cast<Index>(f)];
                const auto face = separated.mesh.face(sub_mesh.faces[f]);
                REQUIRE(face.size() == corners.size());
                for (std::size_t k = 0; k < corners.size(); ++k)
                    CHECK(face[k] == separated.vertex_of[s][corners[k]]);
            }
        }
        CHECK(used.size() == n);
    }
}
