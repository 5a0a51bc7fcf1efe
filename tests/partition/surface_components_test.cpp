#include <doctest/doctest.h>

#include "partition/metrics/bounding_box.h"
#include "partition/surface_components.h"
#include "samples/meshes/meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

TEST_CASE("bodies are connected by vertices, and numbered by the lowest of them; vertices without faces are in none")
{
    PolygonMesh mesh = test::side_by_side({make_quads(100), make_noisy_sphere(200), test::bow_tie()});
    const Index stray = mesh.n_vertices();
    mesh.vertices.conservativeResize(stray + 1, 3);
    mesh.vertices.row(stray).setConstant(1e9);
    const SurfaceComponents found = surface_components(mesh);
    REQUIRE(found.count() == 3);
    CHECK(found.of_vertex[stray] == -1);
    CHECK(found.of_vertex[0] == 0);
    Index n_faces = 0;
    Index n_vertices = 0;
    const IndexLists vertices = found.vertices();
    for (Index c = 0; c < found.count(); ++c) {
        n_faces += static_cast<Index>(found.faces[c].size());
        n_vertices += static_cast<Index>(vertices[c].size());
        for (const Index f : found.faces[c])
            for (const Index v : mesh.face(f))
                CHECK(found.of_vertex[v] == c);
    }
    CHECK(n_faces == mesh.n_faces());
    CHECK(n_vertices == stray);
    CHECK(surface_components(PolygonMesh{}).count() == 0);
}

TEST_CASE("where there are several bodies they are the same, and where there is one it is not listed")
{
    const PolygonMesh one = make_noisy_sphere(200);
    CHECK(surface_components(one).count() == 1);
    CHECK(surface_components_if_several(one).count() == 0);
    const PolygonMesh two = test::side_by_side({make_quads(100), one});
    const SurfaceComponents found = surface_components_if_several(two);
    CHECK(found.count() == 2);
    CHECK(found.of_vertex == surface_components(two).of_vertex);
    CHECK(found.faces.values == surface_components(two).faces.values);
}

TEST_CASE("the largest diagonal is that of the largest body, however far others are")
{
    const PolygonMesh large = make_noisy_sphere(200);
    PolygonMesh small = make_noisy_sphere(100);
    small.vertices *= 0.01;
    PolygonMesh both = test::side_by_side({small, large});
    both.vertices.topRows(small.n_vertices()).rowwise() += Point(1e4, 0.0, 0.0);
    CHECK(largest_diagonal(both) == test::relative(box_of_faces(large).diagonal(), 1e-9));
    CHECK(largest_diagonal(large) == box_of_faces(large).diagonal());
    CHECK(largest_diagonal(PolygonMesh{}) == 0.0);
}
