#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "solvers/normals/face_neighbours.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

/// Triangles around the first vertex, all round or up to a gap.
PolygonMesh fan(Index n, bool is_closed)
{
    PolygonMesh mesh;
    mesh.vertices.setZero(n + 1, 3);
    for (Index k = 0; k < n; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / n;
        mesh.vertices.row(1 + k) << std::cos(angle), std::sin(angle), 0.0;
    }
    for (Index k = 0; k + (is_closed ? 0 : 1) < n; ++k)
        mesh.add_face(std::array{Index{0}, Index(1 + k), Index(1 + (k + 1) % n)});
    return mesh;
}

}  // namespace

TEST_CASE("around a vertex of many faces, neighbours are on all sides, and are each other's")
{
    constexpr Index n = 400;
    for (const bool is_closed : {true, false}) {
        CAPTURE(is_closed);
        const PolygonMesh mesh = fan(n, is_closed);
        const FaceNeighbours neighbours = make_face_neighbours(mesh, make_topology(mesh));
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            CHECK(neighbours[f].size() <= FaceNeighbours::most_at_vertex + 2);
            CHECK(std::ranges::count(neighbours[f], f) == 0);
            for (const Index g : neighbours[f])
                CHECK(std::ranges::count(neighbours[g], f) == 1);
            if (is_closed)
                CHECK(std::ranges::count(neighbours[f], (f + n / 2) % n) == 1);
        }
    }
}

TEST_CASE("up to some valence all faces at a vertex are neighbours")
{
    const PolygonMesh mesh = fan(static_cast<Index>(FaceNeighbours::most_at_vertex), true);
    const FaceNeighbours neighbours = make_face_neighbours(mesh, make_topology(mesh));
    for (Index f = 0; f < mesh.n_faces(); ++f)
        CHECK(neighbours[f].size() == FaceNeighbours::most_at_vertex - 1);
}

TEST_CASE("on their own sheet, faces have no neighbours across lines of several sheets and touching points")
{
    const PolygonMesh wings = test::three_wings();
    const PolygonMesh glass = test::hourglass();
    Topology freed = make_topology(wings);
    free_junctions(wings, freed);
    for (const Topology& topology : {make_topology(wings), freed}) {
        const FaceNeighbours all = make_face_neighbours(wings, topology);
        const FaceNeighbours own = make_face_neighbours(wings, topology, run_serially, Sheets::Own);
        for (Index f = 0; f < wings.n_faces(); ++f) {
            CHECK(all[f].size() == 2);
            CHECK(own[f].empty());
        }
    }
    const FaceNeighbours own = make_face_neighbours(glass, make_topology(glass), run_serially, Sheets::Own);
    for (Index f = 0; f < glass.n_faces(); ++f)
        CHECK(own[f].size() == 3);
    // Elsewhere they are the same.
    const PolygonMesh torus = test::quad_torus(7, 5);
    CHECK(make_face_neighbours(torus, make_topology(torus), run_serially, Sheets::Own).faces ==
          make_face_neighbours(torus, make_topology(torus)).faces);
}
