#include <algorithm>
#include <set>
#include <utility>

#include <doctest/doctest.h>

#include "samples/page/page_triangles.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

using DrawnEdge = std::pair<Index, Index>;

DrawnEdge edge(std::uint32_t a, std::uint32_t b)
{
    return {static_cast<Index>(std::min(a, b)), static_cast<Index>(std::max(a, b))};
}

std::multiset<DrawnEdge> drawn_edges(const PageTriangles& triangles)
{
    std::multiset<DrawnEdge> edges;
    for (std::size_t t = 0; t < triangles.edges.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            if ((triangles.edges[t] >> k & 1U) != 0)
                edges.insert(edge(triangles.corners[3 * t + k], triangles.corners[3 * t + (k + 1) % 3]));
    return edges;
}

std::set<DrawnEdge> edges_of(const PolygonMesh& mesh)
{
    std::set<DrawnEdge> edges;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto face = mesh.face(f);
        for (std::size_t k = 0; k < face.size(); ++k)
            edges.insert(
                edge(static_cast<std::uint32_t>(face[k]), static_cast<std::uint32_t>(face[(k + 1) % face.size()])));
    }
    return edges;
}

}  // namespace

TEST_CASE("a face of n sides is n - 2 triangles of its corners")
{
    for (const test::NamedMesh& named : test::assorted_meshes()) {
        CAPTURE(named.name);
        const PolygonMesh& mesh = named.mesh;
        const Topology& topology = named.topology;
        const PageTriangles triangles = page_triangles(mesh, topology);
        REQUIRE(triangles.per_face.size() == usize(mesh.n_faces()));
        std::size_t t = 0;
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            const auto face = mesh.face(f);
            CHECK(triangles.per_face[f] == face.size() - 2);
            for (std::size_t corner = 3 * t; corner < 3 * (t + face.size() - 2); ++corner)
                CHECK(std::find(face.begin(), face.end(), static_cast<Index>(triangles.corners[corner])) != face.end());
            t += face.size() - 2;
        }
        CHECK(triangles.edges.size() == t);
        CHECK(triangles.corners.size() == 3 * t);
    }
}

TEST_CASE("the edges of the mesh are drawn, all of them and nothing else")
{
    for (const test::NamedMesh& named : test::assorted_meshes()) {
        CAPTURE(named.name);
        const PolygonMesh& mesh = named.mesh;
        const Topology& topology = named.topology;
        const std::multiset<DrawnEdge> drawn = drawn_edges(page_triangles(mesh, topology));
        const std::set<DrawnEdge> expected = edges_of(mesh);
        CHECK(std::set<DrawnEdge>(drawn.begin(), drawn.end()) == expected);
        if (std::count(topology.kind.begin(), topology.kind.end(), VertexKind::NonManifold) == 0)
            CHECK(drawn.size() == expected.size());
    }
}
