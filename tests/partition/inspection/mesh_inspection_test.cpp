#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <doctest/doctest.h>

#include "partition/inspection/mesh_inspection.h"
#include "partition/repeated_faces.h"
#include "partition/vector_area.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Whether any of the lists holds something, or the mesh cannot be oriented.
bool has_findings(const MeshInspection& found)
{
    return !found.orientable ||
           !(found.defects.vertices_not_finite.empty() && found.defects.non_manifold_edges.empty() &&
             found.defects.non_manifold_vertices.empty() && found.defects.inconsistent_edges.empty() &&
             found.defects.duplicate_faces.empty() && found.defects.faces_without_area.empty() &&
             found.defects.edges_without_length.empty() && found.defects.coincident_vertices.empty() &&
             found.defects.isolated_vertices.empty());
}

MeshInspection inspected(const PolygonMesh& mesh)
{
    return inspect(mesh, make_topology(mesh));
}

using Numbers = std::vector<Index>;
using Edges = std::vector<Edge>;

Numbers all_faces(const PolygonMesh& mesh)
{
    Numbers all(usize(mesh.n_faces()));
    std::iota(all.begin(), all.end(), 0);
    return all;
}

}  // namespace

TEST_CASE("a sound mesh is counted and measured, without findings")
{
    PolygonMesh mesh = quad_grid(4, 3);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        mesh.vertices.row(v) = Point(v % 5, v / 5, 0.0);
    const MeshInspection found = inspected(mesh);
    CHECK_FALSE(has_findings(found));
    CHECK(found.counts.vertices == 20);
    CHECK(found.counts.faces == 12);
    CHECK(found.counts.edges == 31);
    CHECK(found.counts.boundary_edges == 14);
    CHECK(found.counts.components == 1);
    CHECK(found.counts.faces_by_sides == std::array<Index, 5>{0, 12, 0, 0, 0});
    CHECK(found.edge_lengths.shortest == 1.0);
    CHECK(found.edge_lengths.mean == 1.0);
    CHECK(found.edge_lengths.longest == 1.0);
    CHECK(found.box.middle == std::array<double, 3>{2.0, 1.5, 0.0});
    CHECK(found.box.diagonal == 5.0);
    CHECK(found.bits_for_detail == 51);
    mesh.vertices.rowwise() += Point(1048576.0, 0.0, 0.0);
    CHECK(inspected(mesh).bits_for_detail == 33);
}

TEST_CASE("what is not manifold is listed")
{
    const MeshInspection wings = inspected(three_wings());
    CHECK(wings.defects.non_manifold_edges.size() == 1);
    CHECK(wings.defects.non_manifold_vertices.size() == 2);
    CHECK(has_findings(wings));
    const MeshInspection glass = inspected(hourglass());
    CHECK(glass.defects.non_manifold_edges.empty());
    CHECK(glass.defects.non_manifold_vertices.size() == 1);
}

TEST_CASE("edges whose faces run against each other are listed, and what can be oriented is known")
{
    PolygonMesh mesh = triangle_torus(8, 6);
    std::reverse(mesh.face_vertices.begin() + mesh.face_offsets[5], mesh.face_vertices.begin() + mesh.face_offsets[6]);
    const MeshInspection found = inspected(mesh);
    const auto face = mesh.face(5);
    Edges expected;
    for (std::size_t k = 0; k < 3; ++k)
        expected.push_back({std::min(face[k], face[(k + 1) % 3]), std::max(face[k], face[(k + 1) % 3])});
    std::sort(expected.begin(), expected.end());
    CHECK(found.defects.inconsistent_edges == expected);
    CHECK(found.orientable);
    const MeshInspection band = inspected(moebius_band(12, 3));
    CHECK_FALSE(band.orientable);
    CHECK(has_findings(band));
}

TEST_CASE("repetitions are listed, not what they repeat")
{
    PolygonMesh mesh = quad_grid(3, 3);
    const Numbers first(mesh.face(2).begin(), mesh.face(2).end());
    mesh.add_face(Numbers{first[2], first[3], first[0], first[1]});
    mesh.add_face(Numbers{first[3], first[2], first[1], first[0]});
    mesh.vertices.row(7) = mesh.vertices.row(3);
    mesh.vertices.row(9) = mesh.vertices.row(3);
    const MeshInspection found = inspected(mesh);
    CHECK(found.defects.duplicate_faces == Numbers{9, 10});
    CHECK(found.defects.coincident_vertices == Numbers{7, 9});
}

TEST_CASE("two sides that lie on each other do not cross; what crosses them is named once, by the first side")
{
    PolygonMesh sheet = quad_grid(4, 4);
    // One more face, which stands on the third one, and goes through it.
    const auto corners = sheet.face(2);
    const Point middle =
        0.5 * (sheet.vertices.row(corners[0]) + sheet.vertices.row(corners[2])) + Point(0.01, 0.02, 0.0);
    const Index n = sheet.n_vertices();
    sheet.vertices.conservativeResize(n + 3, 3);
    sheet.vertices.bottomRows<3>().rowwise() = middle;
    sheet.vertices.bottomRightCorner<3, 1>() << -1.0, 1.0, 1.0;
    sheet.vertices(n + 2, 0) += 0.1;
    sheet.add_face(Numbers{n, n + 1, n + 2});
    const auto crossings = inspected(sheet).defects.self_intersections;
    REQUIRE(crossings.size() == 1);
    PolygonMesh two_sided = sheet;
    for (Index f = 0; f < sheet.n_faces(); ++f) {
        Numbers turned(sheet.face(f).begin(), sheet.face(f).end());
        std::ranges::reverse(turned);
        two_sided.add_face(turned);
    }
    CHECK(inspected(two_sided).defects.self_intersections == crossings);
    CHECK(with_single_faces(two_sided, inspected(two_sided)).face_vertices == sheet.face_vertices);
}

TEST_CASE("what has no extent is listed, and what has no faces")
{
    PolygonMesh mesh = triangle_grid(4, 4);
    const Index a = mesh.face(3)[0];
    const Index b = mesh.face(3)[1];
    mesh.vertices.row(a) = mesh.vertices.row(b);
    mesh.vertices.conservativeResize(mesh.n_vertices() + 1, 3);
    mesh.vertices.bottomRows(1) = Point(9.0, 9.0, 9.0);
    const MeshInspection found = inspected(mesh);
    CHECK(found.defects.edges_without_length == Edges{{std::min(a, b), std::max(a, b)}});
    CHECK(std::count(found.defects.faces_without_area.begin(), found.defects.faces_without_area.end(), 3) == 1);
    CHECK(found.defects.faces_without_area.size() == 2);
    CHECK(found.defects.isolated_vertices == Numbers{mesh.n_vertices() - 1});

    // Three corners in a row, whose area is what rounding leaves of it.
    PolygonMesh flat;
    flat.vertices.resize(3, 3);
    flat.vertices << 0.1, 0.1, 0.1, 0.3, 0.3, 0.3, 0.7, 0.7, 0.7;
    flat.add_face(Numbers{0, 1, 2});
    CHECK(inspected(flat).defects.faces_without_area == Numbers{0});
}

TEST_CASE("vertices that are nowhere are listed, and the rest is measured")
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    PolygonMesh mesh = quad_grid(3, 3);
    mesh.vertices(5, 1) = nan;
    mesh.vertices(6, 0) = std::numeric_limits<double>::infinity();
    mesh.vertices(10, 1) = nan;
    const MeshInspection found = inspected(mesh);
    CHECK(found.defects.vertices_not_finite == Numbers{5, 6, 10});
    CHECK(has_findings(found));
    CHECK(found.defects.edges_without_length.empty());
    CHECK(found.defects.faces_without_area.empty());
    CHECK(found.defects.coincident_vertices.empty());
    CHECK(std::isfinite(found.edge_lengths.mean));
    CHECK(std::isfinite(found.box.diagonal));
}

TEST_CASE("nothing is found where there is nothing")
{
    CHECK_FALSE(has_findings(inspected(PolygonMesh{})));
}

TEST_CASE("repeated faces are found with the first of their vertices, whatever their order")
{
    PolygonMesh mesh;
    mesh.vertices.setZero(6, 3);
    for (const Numbers& face : {Numbers{0, 1, 2}, Numbers{3, 4, 5}, Numbers{2, 0, 1}, Numbers{0, 1, 2, 3},
                                Numbers{5, 4, 3}, Numbers{2, 1, 0}, Numbers{0, 1, 3}})
        mesh.add_face(face);
    const auto repeated = find_repeated_faces(mesh, all_faces(mesh));
    REQUIRE(repeated.size() == 3);
    CHECK((repeated[0].face == 2 && repeated[0].first == 0));
    CHECK((repeated[1].face == 4 && repeated[1].first == 1));
    CHECK((repeated[2].face == 5 && repeated[2].first == 0));
    CHECK(find_repeated_faces(mesh, {1, 2, 3}).empty());
    CHECK(find_repeated_faces(mesh, {}).empty());
}

TEST_CASE("sound meshes have no repeated faces")
{
    for (const test::NamedMesh& m : test::assorted_meshes()) {
        CAPTURE(m.name);
        CHECK(find_repeated_faces(m.mesh, all_faces(m.mesh)).empty());
    }
}
