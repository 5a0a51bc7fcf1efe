#include <cmath>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/metrics/displacement.h"
#include "samples/meshes/meshes.h"
#include "tests/support/mesh_files.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

DisplacementStatistics statistics(const PolygonMesh& mesh, const Points& after)
{
    return displacement_statistics(displacement_field(mesh, mesh.vertices, after));
}

Points rotated(const Points& points, double angle, const Eigen::Vector3d& axis)
{
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    return points * rotation.transpose();
}

PolygonMesh smooth_sphere(Index vertices)
{
    return make_noisy_sphere(vertices, {.amplitude = 0.0, .noise = 0.0});
}

}  // namespace

TEST_CASE("a disc that turns in its plane moves tangentially only")
{
    const PolygonMesh disc = make_hexagons(300, {.amplitude = 0.0});
    for (const double angle : {0.01, 1.0, 3.0}) {
        const Points after = rotated(disc.vertices, angle, Eigen::Vector3d::UnitZ());
        const DisplacementStatistics moved = statistics(disc, after);
        CHECK(moved.normal.max == 0.0);
        CHECK(moved.tangential.max == test::relative((after - disc.vertices).rowwise().norm().maxCoeff(), 1e-12));
    }
}

TEST_CASE("a disc that leaves its plane moves normally only, with the sign of its normal")
{
    const PolygonMesh disc = test::quad_grid(5, 5);
    Points after = disc.vertices;
    after.col(2).array() += 0.75;
    const DisplacementField field = displacement_field(disc, disc.vertices, after);
    const DisplacementField back = displacement_field(disc, after, disc.vertices);
    for (Index v = 0; v < disc.n_vertices(); ++v) {
        CHECK(field.tangential[v] == 0.0);
        CHECK(std::abs(field.normal[v]) == 0.75);
        CHECK(back.normal[v] == -field.normal[v]);
    }
}

TEST_CASE("vertices of a sphere that move outwards move normally")
{
    const PolygonMesh sphere = smooth_sphere(4000);
    for (const double factor : {0.5, 0.99, 2.0}) {
        const DisplacementStatistics moved = statistics(sphere, factor * sphere.vertices);
        // The normals of an irregular mesh of triangles are radial up to its fineness.
        CHECK(moved.normal.mean == test::relative(std::abs(factor - 1.0), 1e-3));
        CHECK(moved.tangential.mean < 0.02 * moved.normal.mean);
    }
}

TEST_CASE("a sphere that turns in itself, however far, moves tangentially")
{
    const PolygonMesh sphere = smooth_sphere(4000);
    for (const double angle : {0.01, 0.5, 1.5}) {
        const DisplacementStatistics moved = statistics(sphere, rotated(sphere.vertices, angle, {1.0, 2.0, 3.0}));
        CHECK(moved.tangential.mean > 0.0);
        CHECK(moved.normal.mean < 0.02 * moved.tangential.mean);
    }
}

TEST_CASE("the parts are at right angles")
{
    const Displacement d = split_displacement({1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0});
    REQUIRE(d.defined);
    CHECK(d.normal == test::relative(5.0 / std::sqrt(2.0), 1e-5));
    CHECK(d.tangential.squaredNorm() + d.normal * d.normal == test::relative(14.0, 1e-5));
}

TEST_CASE("one normal is enough, opposite ones or none are not")
{
    const Point d(1.0, 0.0, 2.0);
    const Point n(0.0, 0.0, 1.0);
    CHECK(split_displacement(d, n, Point::Zero()).normal == 2.0);
    CHECK(split_displacement(d, Point::Zero(), n).normal == 2.0);
    CHECK_FALSE(split_displacement(d, n, -n).defined);
    CHECK_FALSE(split_displacement(d, Point::Zero(), Point::Zero()).defined);
}

TEST_CASE("vertices without a normal are left out")
{
    PolygonMesh mesh = test::quad_grid(1, 1);
    mesh.vertices.conservativeResize(5, 3);
    mesh.vertices.bottomRows(1).setZero();
    Points after = mesh.vertices;
    after.col(2).array() += 1.0;
    const DisplacementField field = displacement_field(mesh, mesh.vertices, after);
    CHECK(std::isnan(field.tangential[4]));
    CHECK(std::isnan(field.normal[4]));
    CHECK(displacement_statistics(field).normal.mean == 1.0);
    CHECK_THROWS_AS(displacement_field(mesh, mesh.vertices, Points(3, 3)), InputError);
}

TEST_CASE("statistics of lengths")
{
    const std::vector<double> lengths{3.0, std::nan(""), -4.0};
    CHECK(length_statistics(lengths).mean == 3.5);
    CHECK(length_statistics(lengths).rms == test::relative(std::sqrt(12.5), 1e-5));
    CHECK(length_statistics(lengths).max == 4.0);
    CHECK(length_statistics({}).mean == 0.0);
}

TEST_CASE("lengths may be added up in parts")
{
    LengthSums first;
    LengthSums second;
    first.add(3.0);
    second.add(std::nan(""));
    second.add(-4.0);
    first.add(second);
    first.add(LengthSums());
    CHECK(first.statistics().mean == 3.5);
    CHECK(first.statistics().rms == test::relative(std::sqrt(12.5), 1e-5));
    CHECK(first.statistics().max == 4.0);
    CHECK(LengthSums().statistics().rms == 0.0);
}
