#include <algorithm>

#include <doctest/doctest.h>

#include "partition/connected_components.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("components are numbered by their lowest face")
{
    const PolygonMesh mesh = side_by_side({quad_grid(2, 1), quad_torus(3, 3), quad_grid(1, 1)});
    const Components components = face_components(mesh, make_topology(mesh));
    CHECK(components.count() == 3);
    CHECK(components.component_of == std::vector<Index>{0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2});
}

TEST_CASE("the nodes of a component follow each other breadth first from the lowest")
{
    // Two paths, 0 - 4 - 1 - 3 and 2 - 5.
    const std::vector<std::vector<Index>> adjacency{{4}, {3, 4}, {5}, {1}, {1, 0}, {2}};
    const Components components = connected_components(6, [&](Index node, auto&& visit) {
        for (const Index neighbour : adjacency[node])
            visit(neighbour);
    });
    CHECK(components.component_of == std::vector<Index>{0, 0, 1, 0, 0, 1});
    CHECK(components.nodes.offsets == std::vector<Index>{0, 4, 6});
    CHECK(components.nodes.values == std::vector<Index>{0, 4, 1, 3, 2, 5});
}

TEST_CASE("neither a vertex nor an edge of three faces connects")
{
    CHECK(face_components(bow_tie(), make_topology(bow_tie())).count() == 2);
    CHECK(face_components(hourglass(), make_topology(hourglass())).count() == 2);
    CHECK(face_components(three_wings(), make_topology(three_wings())).count() == 3);
}

TEST_CASE("a mesh without faces has no components")
{
    CHECK(face_components(PolygonMesh{}, make_topology(PolygonMesh{})).count() == 0);
}
