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
            const Index s = copies.sub_mesh[at(copy)];
            const SubMesh& sub_mesh = decomposition.sub_meshes[at(s)];
            REQUIRE(copy >= copies.first[at(s)]);
            REQUIRE(copy - copies.first[at(s)] < copies.n_in(s));
            return sub_mesh.local_to_global[at(sub_mesh.interface.vertices[at(copy - copies.first[at(s)])])];
        };
        for (Index v = 0; v < copies.n_vertices(); ++v) {
            const auto of_vertex = copies.of_vertex[v];
            CHECK(of_vertex.size() >= 2);
            for (std::size_t k = 0; k < of_vertex.size(); ++k) {
                CHECK(copies.vertex[at(of_vertex[k])] == v);
                CHECK(global(of_vertex[k]) == global(of_vertex.front()));
                if (k > 0)
                    CHECK(copies.sub_mesh[at(of_vertex[k])] > copies.sub_mesh[at(of_vertex[k - 1])]);
            }
        }
    }
}
