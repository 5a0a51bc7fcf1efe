#include <doctest/doctest.h>

#include "solvers/interface/interface_copies.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("every copy is one of its vertex, in its sub-mesh, of the same vertex of the mesh")
{
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        const InterfaceCopies copies(decomposition);
        CHECK(copies.n_vertices() == decomposition.n_interface_vertices);
        CHECK(static_cast<Index>(copies.of_vertex.values.size()) == copies.n_copies());
        const auto global = [&](Index copy) {
            const Index s = copies.sub_mesh[copy];
            const SubMesh& sub_mesh = decomposition.sub_meshes[s];
            REQUIRE(copy >= copies.offsets[s]);
            REQUIRE(copy - copies.offsets[s] < copies.n_in(s));
            return sub_mesh.local_to_global[sub_mesh.interface.vertices[copy - copies.offsets[s]]];
        };
        for (Index v = 0; v < copies.n_vertices(); ++v) {
            const auto of_vertex = copies.of_vertex[v];
            CHECK(of_vertex.size() >= 2);
            for (std::size_t k = 0; k < of_vertex.size(); ++k) {
                CHECK(copies.vertex[of_vertex[k]] == v);
                CHECK(global(of_vertex[k]) == global(of_vertex.front()));
                if (k > 0)
                    CHECK(copies.sub_mesh[of_vertex[k]] > copies.sub_mesh[of_vertex[k - 1]]);
            }
        }
    }
}
