#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/volume.h"
#include "partition/vector_area.h"
#include "samples/meshes/random_numbers.h"
#include "solvers/rounding/rounded_surface.h"
#include "tests/support/digitised.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::ball;
using test::crossed_edges;
using test::height_grid;
using test::Inside;
using test::stepped_pyramid;
using test::voxel_faces;

namespace {

Topology free_topology(const PolygonMesh& mesh)
{
    Topology topology = make_topology(mesh, run_in_parallel);
    free_junctions(mesh, topology, run_in_parallel);
    free_boundary(topology);
    return topology;
}

std::optional<SmoothedWithinSteps> smoothed(const PolygonMesh& mesh, const std::vector<double>& strengths = {},
                                            const Executor& exec = run_in_parallel)
{
    return smooth_rounded(mesh, free_topology(mesh), mesh.vertices, {.strengths = strengths}, exec);
}

/// The mean angle between the faces and the sphere around the origin, in degrees.
double angle_to_ball(const PolygonMesh& mesh, const Points& positions)
{
    double total = 0.0;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const Point normal = vector_area(mesh.face(f), positions).normalized();
        Point middle = Point::Zero();
        for (const Index v : mesh.face(f))
            middle += positions.row(v);
        total += std::acos(std::clamp(normal.dot(middle.normalized()), -1.0, 1.0));
    }
    return 180.0 / std::numbers::pi * total / mesh.n_faces();
}

double distance_to_ball(const Points& positions, double radius)
{
    return std::sqrt((positions.rowwise().norm().array() - radius).square().mean());
}

Inside box(const Point& half_lengths)
{
    return [=](const Point& point) { return (point.cwiseAbs().array() < half_lengths.array()).all(); };
}

double waves(double x, double y)
{
    return 6.0 * std::sin(x / 13.0) * std::cos(y / 17.0) + 3.0 * std::sin((x + 2.0 * y) / 23.0);
}

}  // namespace

TEST_CASE("a ball of voxels becomes round, within half a voxel")
{
    constexpr double radius = 9.3;
    struct Case {
        const char* name;
        PolygonMesh mesh;
        Point spacing;
        double angle;
        double distance;
    };
    // The measured values are about four fifths of these.
    for (const Case& one :
         {Case{"faces", voxel_faces(ball(radius), 24), Point::Ones(), 1.4, 0.06},
          Case{"marching cubes", crossed_edges(ball(radius), 24), Point::Ones(), 1.05, 0.06},
          Case{"slices", crossed_edges(ball(radius), 40, Point(0.5, 0.5, 2.5)), Point(0.5, 0.5, 2.5), 2.3, 0.1}}) {
        CAPTURE(std::string(one.name));
        const auto result = smoothed(one.mesh);
        REQUIRE(result);
        CHECK((result->steps - one.spacing).cwiseAbs().maxCoeff() < 1e-9);
        const Point furthest = (result->positions - one.mesh.vertices).cwiseAbs().colwise().maxCoeff();
        CHECK((furthest.array() <= 0.5 * one.spacing.array() + 1e-12).all());
        CHECK(angle_to_ball(one.mesh, result->positions) < one.angle);
        CHECK(distance_to_ball(result->positions, radius) < one.distance);
        const double before = volume_of_cones(one.mesh, one.mesh.vertices, Point::Zero(), run_serially);
        const double after = volume_of_cones(one.mesh, result->positions, Point::Zero(), run_serially);
        CHECK(std::abs(after / before - 1.0) < 0.01);
    }
}

TEST_CASE("whole heights become the ground, and x and y stay bit for bit")
{
    const PolygonMesh truth = height_grid(60, waves);
    for (const double step : {1.0, 0.5, 0.25}) {
        CAPTURE(step);
        const PolygonMesh mesh = test::rounded(truth, Point(0.0, 0.0, step));
        const auto result = smoothed(mesh);
        REQUIRE(result);
        CHECK(result->positions.leftCols<2>() == mesh.vertices.leftCols<2>());
        CHECK((result->positions - mesh.vertices).cwiseAbs().maxCoeff() <= 0.5 * step + 1e-12);
        const auto rms = [&](const Points& positions) {
            return std::sqrt((positions.col(2) - truth.vertices.col(2)).squaredNorm() / mesh.n_vertices());
        };
        CHECK(rms(result->positions) < 0.45 * rms(mesh.vertices));
    }
}

TEST_CASE("a box that is tilted against its voxels keeps its edges")
{
    // Turned by 31 degrees around z and 37 around x.
    Eigen::Matrix3d turn;
    turn = Eigen::AngleAxisd(0.64, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(0.54, Eigen::Vector3d::UnitZ());
    const Inside tilted = [&](const Point& point) { return box(Point(11.0, 8.0, 9.0))(point * turn); };
    const PolygonMesh mesh = voxel_faces(tilted, 36);
    const auto result = smoothed(mesh);
    REQUIRE(result);
    double total = 0.0;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const Point normal = vector_area(mesh.face(f), result->positions).normalized() * turn;
        total += std::acos(std::min(1.0, normal.cwiseAbs().maxCoeff()));
    }
    // Without edges that are kept they are 8 to 9 degrees off, and the faces of voxels 50.
    CHECK(180.0 / std::numbers::pi * total / mesh.n_faces() < 5.0);
}

TEST_CASE("shapes of blocks, noise and exact surfaces are not taken for rounded")
{
    RandomNumbers random(3);
    PolygonMesh noisy = height_grid(60, [&](double x, double y) { return waves(x, y) + 3.0 * random.symmetric(); });
    const auto studs = [](double x, double y) {
        return std::fmod(x, 9.0) < 3.0 && std::fmod(y, 9.0) < 3.0 ? 1.0 : 0.0;
    };
    const auto ribs = [](double x, double) { return std::fmod(x, 6.0) < 3.0 ? 1.0 : 0.0; };
    const auto letters = [](double x, double y) {
        return std::fmod(x, 30.0) < 4.0 || std::fmod(y, 45.0) < 4.0 ? 1.0 : 0.0;
    };
    const auto disc = [](double x, double y) { return std::hypot(x - 30.0, y - 30.0) < 20.0 ? 5.0 : 0.0; };
    const Inside diagonal_of_pixels = [](const Point& point) {
        return std::abs(point.z()) < 1.0 && std::abs(point.x()) < 11.0 && std::abs(point.x() - point.y()) < 1.5;
    };
    const std::vector<std::pair<std::string, PolygonMesh>> meshes{
        {"diagonal of pixels", voxel_faces(diagonal_of_pixels, 26)},
        {"box", voxel_faces(box(Point(10.0, 7.0, 6.0)), 24)},
        {"box, marching cubes", crossed_edges(box(Point(10.0, 7.0, 6.0)), 24)},
        {"steps 1 by 1", voxel_faces(stepped_pyramid(1.0, 1.0), 26)},
        {"steps 2 by 2", voxel_faces(stepped_pyramid(2.0, 2.0), 26)},
        {"steps 3 by 2", voxel_faces(stepped_pyramid(3.0, 2.0), 26)},
        {"steps 4 by 4", voxel_faces(stepped_pyramid(4.0, 4.0), 26)},
        {"steps 3 by 3, marching cubes", crossed_edges(stepped_pyramid(3.0, 3.0), 26)},
        {"studs", height_grid(63, studs)},
        {"ribs", height_grid(60, ribs)},
        {"letters", height_grid(90, letters)},
        {"disc", height_grid(60, disc)},
        {"noise, rounded", test::rounded(noisy, Point(0.0, 0.0, 1.0))},
        {"noise", noisy},
        {"exact", height_grid(60, waves)},
        {"torus", test::triangle_torus(30, 20)},
    };
    for (const auto& named : meshes) {
        CAPTURE(named.first);
        CHECK_FALSE(smoothed(named.second));
    }
}

TEST_CASE("thin vessels of voxels become round, and bars of blocks with grooves or bends stay")
{
    // A helix, as points on its axis.
    Points axis(400, 3);
    for (Index i = 0; i < 400; ++i) {
        const double t = 4.0 * std::numbers::pi * i / 400.0;
        axis.row(i) = Point(9.0 * std::cos(t), 9.0 * std::sin(t), 1.1 * t - 6.0);
    }
    const auto nearest = [&](const Point& point) {
        Eigen::Index i = 0;
        (axis.rowwise() - point).rowwise().squaredNorm().minCoeff(&i);
        return Point(axis.row(i));
    };
    for (const double radius : {1.2, 2.0}) {
        CAPTURE(radius);
        const Inside vessel = [&](const Point& point) { return (point - nearest(point)).norm() < radius; };
        const PolygonMesh mesh = voxel_faces(vessel, 24);
        const auto result = smoothed(mesh);
        REQUIRE(result);
        CHECK((result->positions - mesh.vertices).cwiseAbs().maxCoeff() <= 0.5 + 1e-12);
        double total = 0.0;
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            const Point normal = vector_area(mesh.face(f), result->positions).normalized();
            Point middle = Point::Zero();
            for (const Index v : mesh.face(f))
                middle += result->positions.row(v) / 4.0;
            total += std::acos(std::clamp(normal.dot((middle - nearest(middle)).normalized()), -1.0, 1.0));
        }
        // 9 and 4 are measured, 42 before.
        CHECK(180.0 / std::numbers::pi * total / mesh.n_faces() < 8.0 / radius + 4.0);
        // The same, cut off.
        PolygonMesh open;
        open.vertices = mesh.vertices;
        for (Index f = 0; f < mesh.n_faces(); ++f)
            if (mesh.vertices(mesh.face(f).front(), 0) < 7.0)
                open.add_face(mesh.face(f));
        CHECK(open.n_faces() < mesh.n_faces() - 50);
        CHECK(smoothed(open));
    }
    const Inside grooved = [](const Point& point) {
        const double width = std::fmod(std::floor(point.z()) + 20.0, 10.0) < 5.0 ? 5.0 : 4.0;
        return std::abs(point.z()) < 14.0 && std::max(std::abs(point.x()), std::abs(point.y())) < width;
    };
    CHECK_FALSE(smoothed(voxel_faces(grooved, 32)));
    // Three wide, and two further to the side with each three.
    const Inside bent = [](const Point& point) {
        const double bends = 2.0 * std::floor((point.x() + 12.0) / 3.0) - 8.0;
        return std::abs(point.x()) < 12.0 && std::abs(point.z()) < 2.0 && std::abs(point.y() - bends) < 3.0;
    };
    CHECK_FALSE(smoothed(voxel_faces(bent, 30)));
}

TEST_CASE("crests and valleys keep their height")
{
    const auto height = [](const Point& point) { return 3.0 * std::sin(point.x() / 2.5) * std::sin(point.y() / 2.5); };
    const Inside crate = [&](const Point& point) { return point.z() < height(point) + 0.3 && point.norm() < 14.3; };
    for (const bool is_marching_cubes : {false, true}) {
        CAPTURE(is_marching_cubes);
        PolygonMesh mesh = is_marching_cubes ? crossed_edges(crate, 32) : voxel_faces(crate, 32);
        const auto mean_height_over_crests = [&](const Points& positions) {
            double total = 0.0;
            double n = 0.0;
            for (Index v = 0; v < mesh.n_vertices(); ++v) {
                const Point before = mesh.vertices.row(v);
                if (before.norm() < 11.0 && std::abs(height(before)) > 2.0) {
                    const Point after = positions.row(v);
                    total += (after.z() - 0.3) / height(after);
                    n += 1.0;
                }
            }
            return total / n;
        };
        const auto result = smoothed(mesh);
        REQUIRE(result);
        // 0.953 and 0.951 are measured, and without what is taken back 0.866 and 0.879.
        CHECK(mean_height_over_crests(result->positions) > 0.93);
        // It makes no difference whether faces are turned outwards or inwards.
        const Points outwards = result->positions;
        for (Index f = 0; f < mesh.n_faces(); ++f)
            std::reverse(mesh.face_vertices.begin() + mesh.face_offsets[f],
                         mesh.face_vertices.begin() + mesh.face_offsets[f + 1]);
        const auto inwards = smoothed(mesh);
        REQUIRE(inwards);
        CHECK((inwards->positions - outwards).cwiseAbs().maxCoeff() < 1e-3);
    }
}

TEST_CASE("rounding is found alike in other units, at other places and with other axes")
{
    const PolygonMesh mesh = crossed_edges(ball(7.3), 18, Point(1.0, 1.0, 2.0));
    const auto result = smoothed(mesh);
    REQUIRE(result);
    const double unit = 0.0254;
    PolygonMesh other = mesh;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        other.vertices.row(v) =
            unit * Point(mesh.vertices(v, 2), mesh.vertices(v, 0), mesh.vertices(v, 1)) + Point(5.0, -3.0, 0.7);
    const auto of_other = smoothed(other);
    REQUIRE(of_other);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const Point back = (of_other->positions.row(v) - Point(5.0, -3.0, 0.7)) / unit;
        CHECK((Point(back[1], back[2], back[0]) - result->positions.row(v)).norm() < 1e-3);
    }
}

TEST_CASE("each component is judged alone, and what is off the lattice stays")
{
    // A ball of voxels, a block of voxels, and a torus off the lattice.
    const PolygonMesh round = voxel_faces(ball(9.3), 24);
    const PolygonMesh block = voxel_faces(box(Point(10.0, 7.0, 6.0)), 24);
    const PolygonMesh torus = test::triangle_torus(20, 10);
    PolygonMesh mesh = round;
    for (const PolygonMesh* const other : {&block, &torus}) {
        const Index first = mesh.n_vertices();
        mesh.vertices.conservativeResize(first + other->n_vertices(), 3);
        mesh.vertices.bottomRows(other->n_vertices()) = other->vertices.rowwise() + Point(2.0 * first, 0.0, 0.0);
        for (Index f = 0; f < other->n_faces(); ++f) {
            std::vector<Index> corners(other->face(f).begin(), other->face(f).end());
            for (Index& v : corners)
                v += first;
            mesh.add_face(corners);
        }
    }
    const auto alone = smoothed(round);
    const auto result = smoothed(mesh);
    REQUIRE(alone);
    REQUIRE(result);
    const Index n = round.n_vertices();
    CHECK((result->positions.topRows(n) - alone->positions).cwiseAbs().maxCoeff() < 0.1);
    CHECK(result->positions.bottomRows(mesh.n_vertices() - n) == mesh.vertices.bottomRows(mesh.n_vertices() - n));
}

TEST_CASE("steep heights move along their own axis, and vertices without faces not at all")
{
    PolygonMesh mesh =
        test::rounded(height_grid(50, [](double x, double y) { return 1.9 * x + waves(x, y); }), Point(0.0, 0.0, 1.0));
    const Index n = mesh.n_vertices();
    mesh.vertices.conservativeResize(n + 900, 3);
    for (Index v = n; v < mesh.n_vertices(); ++v)
        mesh.vertices.row(v) = Point(0.3 * v, 0.1 * v, 0.77 * v);
    const auto result = smoothed(mesh);
    REQUIRE(result);
    CHECK(result->steps.head<2>().isZero(0.0));
    CHECK(result->positions.leftCols<2>() == mesh.vertices.leftCols<2>());
    CHECK(result->positions.bottomRows(900) == mesh.vertices.bottomRows(900));
}

TEST_CASE("fixed vertices stay, and a strength scales the bounds")
{
    const PolygonMesh mesh = voxel_faces(ball(8.3), 22);
    std::vector<double> strengths(usize(mesh.n_vertices()), 1.0);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        strengths[v] = mesh.vertices(v, 0) < 0.0 ? 0.0 : mesh.vertices(v, 1) < 0.0 ? 0.5 : 1.0;
    const auto result = smoothed(mesh, strengths);
    REQUIRE(result);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const double motion = (result->positions.row(v) - mesh.vertices.row(v)).cwiseAbs().maxCoeff();
        CHECK(motion <= 0.5 * strengths[v] + 1e-12);
        if (strengths[v] == 0.0)
            CHECK(result->positions.row(v) == mesh.vertices.row(v));
    }
}

TEST_CASE("the smooth surface has the same bits however loops are run")
{
    const PolygonMesh mesh = voxel_faces(ball(8.3), 22);
    const auto serial = smoothed(mesh, {}, run_serially);
    const auto parallel = smoothed(mesh);
    REQUIRE(serial);
    REQUIRE(parallel);
    CHECK(serial->positions == parallel->positions);
}

TEST_CASE("steps are named by their axes")
{
    CHECK(steps_in_words(Point(1.0, 1.0, 1.0)) == "1 in x, y and z");
    CHECK(steps_in_words(Point(0.0, 0.0, 0.25)) == "0.25 in z");
    CHECK(steps_in_words(Point(0.5, 0.5, 2.5)) == "0.5 in x, 0.5 in y, 2.5 in z");
}
