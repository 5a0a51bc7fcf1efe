#include <set>

#include <doctest/doctest.h>

#include "partition/decomposition/unjoined.h"
#include "partition/topology.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("taken apart, no two sub-meshes share a vertex, and everything keeps its place")
{
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        const Unjoined unjoined = take_apart(cut.mesh, decomposition);
        CHECK(unjoined.mesh.face_offsets == cut.mesh.face_offsets);
        CHECK(unjoined.mesh.vertices.topRows(cut.mesh.n_vertices()) == cut.mesh.vertices);
        for (std::size_t c = 0; c < cut.mesh.face_vertices.size(); ++c)
            CHECK(unjoined.mesh.vertices.row(unjoined.mesh.face_vertices[c]) ==
                  cut.mesh.vertices.row(cut.mesh.face_vertices[c]));

        std::set<Index> used;
        std::size_t n = 0;
        for (std::size_t s = 0; s < decomposition.sub_meshes.size(); ++s) {
            const SubMesh& sub_mesh = decomposition.sub_meshes[s];
            REQUIRE(unjoined.vertex_of[s].size() == at(sub_mesh.n_vertices));
            used.insert(unjoined.vertex_of[s].begin(), unjoined.vertex_of[s].end());
            n += unjoined.vertex_of[s].size();
            for (std::size_t f = 0; f < sub_mesh.faces.size(); ++f) {
                const auto corners = sub_mesh.face_vertices[static_cast<Index>(f)];
                const auto face = unjoined.mesh.face(sub_mesh.faces[f]);
                REQUIRE(face.size() == corners.size());
                for (std::size_t k = 0; k < corners.size(); ++k)
                    CHECK(face[k] == unjoined.vertex_of[s][at(corners[k])]);
            }
        }
        CHECK(used.size() == n);
    }
}
