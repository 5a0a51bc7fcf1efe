#include <doctest/doctest.h>

#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "samples/report/comparison.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

PolygonMesh raised(PolygonMesh mesh, double by)
{
    mesh.vertices.col(2).array() += by;
    return mesh;
}

PolygonMesh without_faces(const PolygonMesh& mesh)
{
    PolygonMesh points;
    points.vertices = mesh.vertices;
    return points;
}

}  // namespace

TEST_CASE("meshes that correspond have all distances")
{
    const PolygonMesh plane = make_quads(200, {.amplitude = 0.0});
    const Comparison found = compare_meshes(plane, raised(plane, 0.5), Direction::Both);
    REQUIRE(found.vertex_distance);
    REQUIRE(found.surface_distance);
    REQUIRE(found.surface_distance_back);
    REQUIRE(found.displacement);
    CHECK(found.vertex_distance->mean == test::relative(0.5, 1e-5));
    CHECK(found.surface_distance->rms == test::relative(0.5, 1e-5));
    CHECK(found.surface_distance_back->max == test::relative(0.5, 1e-5));
    CHECK(found.displacement->normal.mean == test::relative(0.5, 1e-5));
    CHECK(found.displacement->tangential.max == 0.0);
    CHECK(found.mean_edge == found.vertex_distance->mean_edge);
    CHECK(found.remarks.empty());
}

TEST_CASE("H_ needs no corresponding vertices, V_ does")
{
    const PolygonMesh coarse = make_quads(200, {.amplitude = 0.0});
    const PolygonMesh fine = raised(make_triangles(900, {.amplitude = 0.0}), 0.25);
    for (const Direction direction :
         {Direction::ReferenceToCandidate, Direction::CandidateToReference, Direction::Both, Direction::Symmetric}) {
        const Comparison found = compare_meshes(coarse, fine, direction);
        CHECK_FALSE(found.vertex_distance);
        CHECK_FALSE(found.displacement);
        REQUIRE(found.surface_distance);
        CHECK(found.surface_distance->mean == test::relative(0.25, 1e-5));
        CHECK(found.surface_distance_back.has_value() == (direction == Direction::Both));
        REQUIRE(found.remarks.size() == 1);
        CHECK(found.remarks[0].find("V_") != std::string::npos);
        CHECK(found.remarks[0].find(std::to_string(fine.n_vertices())) != std::string::npos);
    }
}

TEST_CASE("the directions are what their names say")
{
    // A square within a larger one: from the small one to the large one there is nothing to go.
    const PolygonMesh large = make_quads(200, {.amplitude = 0.0});
    PolygonMesh small = large;
    small.vertices *= 0.5;
    CHECK(compare_meshes(small, large, Direction::ReferenceToCandidate).surface_distance->max < 1e-15);
    CHECK(compare_meshes(small, large, Direction::CandidateToReference).surface_distance->max > 0.4);
    CHECK(compare_meshes(small, large, Direction::Symmetric).surface_distance->max > 0.4);
    const Comparison both = compare_meshes(small, large, Direction::Both);
    CHECK(both.surface_distance->max < 1e-15);
    CHECK(both.surface_distance_back->max > 0.4);
}

TEST_CASE("without faces there is V_ at most")
{
    const PolygonMesh mesh = make_quads(200);
    const PolygonMesh points = without_faces(mesh);
    const Comparison found = compare_meshes(points, points, Direction::Symmetric);
    CHECK(found.vertex_distance);
    CHECK_FALSE(found.surface_distance);
    CHECK(found.remarks.size() == 1);
    CHECK_THROWS_AS(compare_meshes(mesh, points, Direction::Symmetric), InputError);
    CHECK_THROWS_AS(compare_meshes(points, mesh, Direction::ReferenceToCandidate), InputError);
}

TEST_CASE("the reason why vertices do not correspond is told")
{
    const PolygonMesh mesh = make_quads(200);
    PolygonMesh other = mesh;
    CHECK(why_not_corresponding(mesh, other).empty());
    std::swap(other.face_vertices[0], other.face_vertices[2]);
    CHECK(why_not_corresponding(mesh, other).find("face 0") != std::string::npos);
}
