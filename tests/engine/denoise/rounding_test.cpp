#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "engine/denoise.h"
#include "engine/state/flow_state.h"
#include "partition/connected_components.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/metrics/volume.h"
#include "samples/meshes/meshes.h"
#include "samples/meshes/random_numbers.h"
#include "tests/support/denoising.h"
#include "tests/support/digitised.h"
#include "tests/support/flows.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::ball;
using test::denoise_in_place;
using test::furthest;
using test::Inside;
using test::names;
using test::same_bits;
using test::voxel_faces;

namespace {

PolygonMesh voxel_ball()
{
    return voxel_faces(ball(7.3), 20);
}

DenoiseOptions with_rounding(const Rounding& rounding)
{
    return {.method = RemoveNoise{.rounding = rounding}};
}

/// Whole heights, with one that stands for missing data.
PolygonMesh heights_with_a_gap()
{
    PolygonMesh mesh = test::rounded(
        test::height_grid(50, [](double x, double y) { return 6.0 * std::sin(x / 13.0) * std::cos(y / 17.0); }),
        Point(0.0, 0.0, 1.0));
    mesh.vertices(1225, 2) = -9999.0;
    return mesh;
}

/// Checks that copies of a vertex in two meshes in one keep together. @param n_first the number of vertices of the
/// first mesh. @returns the number of copies.
int count_kept_copies(const PolygonMesh& mesh, const PolygonMesh& before, Index n_first)
{
    int n_copies = 0;
    int n_kept = 0;
    for (Index v = 0; v < n_first; ++v)
        for (Index w = n_first; w < before.n_vertices(); ++w)
            if (before.vertices.row(v) == before.vertices.row(w)) {
                ++n_copies;
                n_kept += same_bits(mesh.vertices.row(v), mesh.vertices.row(w)) ? 1 : 0;
            }
    CHECK(n_kept == n_copies);
    return n_copies;
}

}  // namespace

TEST_CASE("denoise finds rounded coordinates, and reports them in place of noise")
{
    PolygonMesh mesh = voxel_ball();
    const DenoiseReport report = denoise_in_place(mesh);
    REQUIRE(report.rounding);
    CHECK((report.rounding->steps - Point::Ones()).cwiseAbs().maxCoeff() < 1e-9);
    CHECK(report.rounding->iterations > 10);
    CHECK(report.rounding->last_motion < 0.01);
    CHECK_FALSE(report.noise);
    CHECK(names(report.choices, "rounded coordinates"));
    CHECK_FALSE(names(report.remarks, "no noise"));
    CHECK(furthest(mesh, voxel_ball()) <= 0.5);
}

TEST_CASE("steps that are given are taken without a look, and never is never")
{
    // Heights that are all equal but for a step are not taken for rounded.
    const auto plateau = [](double x, double) { return x < 10.0 ? 0.0 : 1.0; };
    const PolygonMesh step = test::height_grid(21, plateau);
    PolygonMesh mesh = step;
    CHECK_FALSE(denoise_in_place(mesh).rounding);
    CHECK(same_bits(mesh.vertices, step.vertices));
    REQUIRE(denoise_in_place(mesh, with_rounding({Rounding::Kind::Given, Point(0.0, 0.0, 1.0)})).rounding);
    CHECK(furthest(mesh, step) > 0.3);
    CHECK(furthest(mesh, step) <= 0.5);
    CHECK(mesh.vertices.leftCols<2>() == step.vertices.leftCols<2>());

    PolygonMesh as_noise = voxel_ball();
    CHECK_FALSE(denoise_in_place(as_noise, with_rounding({.kind = Rounding::Kind::Never})).rounding);
}

TEST_CASE("rounded coordinates: vertices that are held stay, also those of feature edges and without faces")
{
    PolygonMesh mesh = voxel_ball();
    mesh.vertices.conservativeResize(mesh.n_vertices() + 1, 3);
    mesh.vertices.row(mesh.n_vertices() - 1) = Point(0.25, 0.1, 0.7);
    const PolygonMesh before = mesh;
    DenoiseOptions options = with_rounding({Rounding::Kind::Given, Point::Ones()});
    options.motion.fixed_vertices = {3, 4};
    options.motion.feature_edges = {{mesh.face(20)[0], mesh.face(20)[1]}, {mesh.face(20)[1], mesh.face(20)[2]}};
    REQUIRE(denoise_in_place(mesh, options).rounding);
    for (const Index v :
         {Index{3}, Index{4}, mesh.face(20)[0], mesh.face(20)[1], mesh.face(20)[2], mesh.n_vertices() - 1})
        CHECK(same_bits(mesh.vertices.row(v), before.vertices.row(v)));
    CHECK(furthest(mesh, before) > 0.3);
}

TEST_CASE("rounded coordinates: segments with a wall of their own each keep together, and sheets move with their lines")
{
    const auto left = [](const Point& point) { return point.norm() < 7.3 && point.x() + 0.4 * point.y() < 0.3; };
    const auto right = [=](const Point& point) { return point.norm() < 7.3 && !left(point); };
    PolygonMesh segments = test::together({voxel_faces(left, 20), voxel_faces(right, 20)});
    const PolygonMesh before = segments;
    const DenoiseReport report = denoise_in_place(segments);
    REQUIRE(report.rounding);
    CHECK_FALSE(names(report.remarks, "limited loss"));
    CHECK(furthest(segments, before) <= 0.5);
    const Index n_left = voxel_faces(left, 20).n_vertices();
    CHECK(count_kept_copies(segments, before, n_left) > 100);

    PolygonMesh walls =
        test::wall_faces([&](const Point& point) { return left(point)    ? 1
                                                          : right(point) ? 2
                                                                         : 0; }, 20);
    const PolygonMesh walls_before = walls;
    const DenoiseReport of_walls = denoise_in_place(walls);
    REQUIRE(of_walls.rounding);
    CHECK(of_walls.mesh.junction_vertices > 30);
    CHECK(furthest(walls, walls_before) <= 0.5);
    CHECK(((walls.vertices - walls_before.vertices).rowwise().norm().array() > 0.0).all());
}

TEST_CASE("rounded coordinates: walls keep together and volumes stay, of small segments and of cores in shells, too")
{
    const auto in_ball = [](const Point& centre, double radius) {
        return [=](const Point& point) { return (point - centre).norm() < radius; };
    };
    const auto in_large = in_ball(Point::Zero(), 8.3);
    struct Small {
        Point centre;
        double radius;
    };
    for (const Small& segment : {Small{Point(0.0, 0.0, 0.0), 5.3}, Small{Point(8.5, 1.0, 0.5), 2.2},
                                 Small{Point(8.5, 1.0, 0.5), 2.6}, Small{Point(9.0, 4.0, 2.0), 5.3}}) {
        CAPTURE(segment.radius);
        const auto in_small = in_ball(segment.centre, segment.radius);
        const PolygonMesh large =
            voxel_faces([&](const Point& point) { return in_large(point) && !in_small(point); }, 34);
        const PolygonMesh small = voxel_faces(in_small, 34);
        const PolygonMesh before = test::together({large, small});
        PolygonMesh mesh = before;
        const DenoiseReport report = denoise_in_place(mesh);
        REQUIRE(report.rounding);
        // A small segment may go the way of noise.
        const Points moved = mesh.vertices - before.vertices;
        CHECK(moved.topRows(large.n_vertices()).cwiseAbs().maxCoeff() <= 0.5);
        CHECK(count_kept_copies(mesh, before, large.n_vertices()) > 10);
        const auto volumes = [&](const PolygonMesh& of) {
            const Topology topology = make_topology(of);
            const Components components = face_components(of, topology);
            std::vector<double> found;
            for (Index c = 0; c < components.count(); ++c) {
                double total = 0.0;
                for (const Index f : components.nodes[c])
                    total += cone_volume(of.face(f), of.vertices, Point::Zero());
                found.push_back(total);
            }
            return found;
        };
        const std::vector<double> of_before = volumes(before);
        const std::vector<double> of_after = volumes(mesh);
        for (std::size_t c = 0; c < of_before.size(); ++c)
            CHECK(std::abs(of_after[c] - of_before[c]) <=
                  (std::abs(of_before[c]) > 500.0 ? 0.01 : 0.03) * std::abs(of_before[c]));

        // A bound from outside does not tear copies apart either.
        PolygonMesh nearer = before;
        DenoiseOptions options;
        options.motion.within = 0.3;
        REQUIRE(denoise_in_place(nearer, options).rounding);
        CHECK((nearer.vertices - before.vertices).rowwise().norm().maxCoeff() <= 0.3 * (1.0 + 1e-12));
        CHECK((nearer.vertices - before.vertices).rowwise().norm().maxCoeff() > 0.25);
        // Further along one axis than in the cube within the ball.
        CHECK(furthest(nearer, before) > 0.22);
        CHECK(count_kept_copies(nearer, before, large.n_vertices()) > 10);
    }
}

TEST_CASE("rounded coordinates: bounds along the axes, which percent may give, hold with those of rounding")
{
    const PolygonMesh before = voxel_ball();
    PolygonMesh mesh = before;
    DenoiseOptions options;
    const double diagonal = (before.vertices.colwise().maxCoeff() - before.vertices.colwise().minCoeff()).norm();
    options.motion.within = {0.2, LengthOnMesh(0.1 / diagonal, true), 3.0};
    REQUIRE(denoise_in_place(mesh, options).rounding);
    const Point furthest_along = (mesh.vertices - before.vertices).cwiseAbs().colwise().maxCoeff();
    const Point bounds(0.2, 0.1, 0.5);
    CHECK((furthest_along.array() <= bounds.array() * (1.0 + 1e-12)).all());
    CHECK((furthest_along.array() >= 0.95 * bounds.array()).all());
}

TEST_CASE("rounded coordinates: a clean box stays where a rounded ball touches it")
{
    const Inside in_box = [](const Point& point) {
        return std::abs(point.z() + 9.0) < 2.0 && std::max(std::abs(point.x()), std::abs(point.y())) < 10.0;
    };
    const PolygonMesh box = voxel_faces(in_box, 30);
    const PolygonMesh before = test::together({box, voxel_faces(ball(7.0), 30)});
    PolygonMesh mesh = before;
    REQUIRE(denoise_in_place(mesh).rounding);
    CHECK(same_bits(mesh.vertices.topRows(box.n_vertices()), box.vertices));
    CHECK(furthest(mesh, before) > 0.4);
    CHECK(count_kept_copies(mesh, before, box.n_vertices()) > 10);
}

TEST_CASE("rounded coordinates: the same bits on any number of threads, after a resumption, and in later steps")
{
    DenoiseOptions options;
    options.steps = 2;
    PolygonMesh whole = voxel_ball();
    std::shared_ptr<const FlowState> after_first;
    const DenoiseReport report = denoise(whole, options, [&](const StepState& state) {
        if (state.step == 1)
            after_first = state.capture();
    });
    REQUIRE(report.rounding);
    options.threads = 1;
    PolygonMesh serial = voxel_ball();
    denoise(serial, options);
    CHECK(same_bits(serial.vertices, whole.vertices));
    PolygonMesh resumed = voxel_ball();
    const DenoiseReport again = denoise(resumed, options, {}, {.resume = after_first});
    CHECK(same_bits(resumed.vertices, whole.vertices));
    REQUIRE(again.rounding);
    CHECK(again.rounding->steps == report.rounding->steps);
    CHECK(again.rounding->iterations == report.rounding->iterations);
    CHECK(again.choices == report.choices);

    // A state belongs to the rounding with which it was made.
    PolygonMesh other = voxel_ball();
    DenoiseOptions never = with_rounding({.kind = Rounding::Kind::Never});
    never.steps = 2;
    CHECK_THROWS_AS(denoise(other, never, {}, {.resume = after_first}), InputError);
}

TEST_CASE("rounded coordinates: vertices that move along an axis keep the bounds, and oblique directions have none")
{
    PolygonMesh mesh = voxel_ball();
    DenoiseOptions options = with_rounding({Rounding::Kind::Given, Point::Ones()});
    options.motion.direction = {MotionDirection::Kind::Vector, Point(0.0, 0.0, 2.0)};
    REQUIRE(denoise_in_place(mesh, options).rounding);
    CHECK(mesh.vertices.leftCols<2>() == voxel_ball().vertices.leftCols<2>());
    CHECK(furthest(mesh, voxel_ball()) <= 0.5 + 1e-12);
    CHECK(furthest(mesh, voxel_ball()) > 0.3);
    for (const MotionDirection& direction :
         {MotionDirection{MotionDirection::Kind::Normal}, {MotionDirection::Kind::Vector, Point(1.0, 0.3, 0.0)}}) {
        options.motion.direction = direction;
        CHECK_THROWS_AS(denoise_in_place(mesh, options), OptionError);
        PolygonMesh found = voxel_ball();
        DenoiseOptions without_steps;
        without_steps.motion.direction = direction;
        CHECK_FALSE(denoise_in_place(found, without_steps).rounding);
    }
}

TEST_CASE("rounded coordinates: heights for missing data stay, and do not hide the others")
{
    PolygonMesh mesh = heights_with_a_gap();
    const PolygonMesh before = mesh;
    const DenoiseReport report = denoise_in_place(mesh);
    REQUIRE(report.rounding);
    CHECK(names(report.remarks, "spikes"));
    CHECK(same_bits(mesh.vertices.row(1225), before.vertices.row(1225)));
    CHECK(furthest(mesh, before) <= 0.5 + 1e-12);
    CHECK(std::abs(mesh.vertices(1226, 2) - before.vertices(1226, 2)) < 0.4);
}

TEST_CASE("rounded coordinates: blocks of missing data stay, and what is beside them is smoothed as at a boundary")
{
    const auto hills = [](double x, double y) { return 6.0 * std::sin(x / 13.0) * std::cos(y / 17.0); };
    for (const double spacing : {1.0, 30.0}) {
        CAPTURE(spacing);
        PolygonMesh truth = test::height_grid(60, hills);
        truth.vertices.leftCols<2>() *= spacing;
        PolygonMesh mesh = test::rounded(truth, Point(0.0, 0.0, 1.0));
        std::vector<Index> missing;
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if ((v % 60 > 20 && v % 60 < 30 && v / 60 > 15 && v / 60 < 45) || v % 60 < 2)
                missing.push_back(v);
        for (const Index v : missing)
            mesh.vertices(v, 2) = -9999.0;
        const PolygonMesh before = mesh;
        const DenoiseReport report = denoise_in_place(mesh);
        REQUIRE(report.rounding);
        CHECK(report.rounding->steps == Point(0.0, 0.0, 1.0));
        CHECK(mesh.vertices.leftCols<2>() == before.vertices.leftCols<2>());
        for (const Index v : missing)
            CHECK(mesh.vertices(v, 2) == -9999.0);
        for (const Index v : missing)
            mesh.vertices(v, 2) = truth.vertices(v, 2);
        CHECK(furthest(mesh, before) > 1000.0);
        CHECK(std::sqrt((mesh.vertices - truth.vertices).squaredNorm() / mesh.n_vertices()) < 0.08);
    }
}

TEST_CASE("rounded coordinates: two values for missing data hide nothing, and what is beside them alone is a boundary")
{
    const PolygonMesh truth =
        test::height_grid(60, [](double x, double y) { return 6.0 * std::sin(x / 13.0) * std::cos(y / 17.0); });
    PolygonMesh mesh = test::rounded(truth, Point(0.0, 0.0, 1.0));
    const auto is_missing = [](Index v) { return v % 60 > 20 && v % 60 < 40 && v / 60 > 15 && v / 60 < 45; };
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (is_missing(v))
            mesh.vertices(v, 2) = v % 60 < 30 ? -9999.0 : -32768.0;
    const PolygonMesh before = mesh;
    const DenoiseReport report = denoise_in_place(mesh);
    REQUIRE(report.rounding);
    CHECK(report.rounding->steps == Point(0.0, 0.0, 1.0));
    double of_rim = 0.0;
    double n_rim = 0.0;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        if (is_missing(v)) {
            CHECK(same_bits(mesh.vertices.row(v), before.vertices.row(v)));
        } else if (is_missing(v + 1) || is_missing(v - 1) || is_missing(v + 60) || is_missing(v - 60)) {
            of_rim += std::pow(mesh.vertices(v, 2) - truth.vertices(v, 2), 2.0);
            n_rim += 1.0;
        }
    }
    CHECK(n_rim > 90.0);
    // 0.29 before, and 0.17 is measured.
    CHECK(std::sqrt(of_rim / n_rim) < 0.2);
}

TEST_CASE("rounded coordinates: the largest distance does not depend on vertices without faces")
{
    const PolygonMesh before = voxel_ball();
    PolygonMesh mesh = before;
    DenoiseOptions options;
    options.motion.within = 0.3;
    REQUIRE(denoise_in_place(mesh, options).rounding);
    PolygonMesh with_one = before;
    with_one.vertices.conservativeResize(before.n_vertices() + 1, 3);
    with_one.vertices.bottomRows<1>() = Point::Constant(1e30);
    REQUIRE(denoise_in_place(with_one, options).rounding);
    CHECK(furthest(mesh, before) > 0.25);
    CHECK((with_one.vertices.topRows(before.n_vertices()) - mesh.vertices).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("what is said of heights for missing data is said after resumption, too, of rounded heights and of noise")
{
    PolygonMesh noisy = heights_with_a_gap();
    RandomNumbers random(5);
    for (Index v = 0; v < noisy.n_vertices(); ++v)
        noisy.vertices(v, 2) += 2.0 * random.symmetric();
    for (const PolygonMesh& mesh : {heights_with_a_gap(), noisy}) {
        DenoiseOptions options;
        options.steps = 2;
        PolygonMesh whole = mesh;
        std::shared_ptr<const FlowState> after_first;
        const DenoiseReport report = denoise(whole, options, [&](const StepState& state) {
            if (state.step == 1)
                after_first = state.capture();
        });
        PolygonMesh resumed = mesh;
        const DenoiseReport again = denoise(resumed, options, {}, {.resume = after_first});
        CHECK(names(again.remarks, "spikes"));
        CHECK(again.remarks == report.remarks);
        CHECK(same_bits(resumed.vertices, whole.vertices));
    }
}

TEST_CASE("parts rounded to fractions of their edges, at any angle, lose that; clean ones stay, and noise is noise")
{
    Eigen::Matrix3d turn;
    turn = Eigen::AngleAxisd(0.35, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(0.52, Eigen::Vector3d::UnitZ());
    PolygonMesh truth = make_box(6000);
    const double edge = mean_edge_length(truth);
    truth.vertices = truth.vertices / edge * turn.transpose();
    const auto result_of = [&](const PolygonMesh& mesh) {
        PolygonMesh result = mesh;
        const DenoiseReport report = denoise_in_place(result);
        return std::pair(std::move(result), report);
    };
    for (const double step : {0.2, 0.3, 0.4}) {
        CAPTURE(step);
        const PolygonMesh mesh = test::rounded(truth, Point::Constant(step));
        const std::pair<PolygonMesh, DenoiseReport> found = result_of(mesh);
        REQUIRE(found.second.rounding);
        CHECK(found.second.rounding->steps.minCoeff() > 0.0);
        CHECK(furthest(found.first, mesh) <= 0.5 * step + 1e-12);
        CHECK(test::angle_to_truth(truth, found.first) < 0.2 * test::angle_to_truth(truth, mesh));
        CHECK(test::angle_to_truth(truth, found.first) < 1.5);
        // Noise of two thirds of a step goes further than half a step.
        const PolygonMesh noisy = test::rounded(test::with_gaussian_noise(truth, step, 5), Point::Constant(step));
        const std::pair<PolygonMesh, DenoiseReport> of_noisy = result_of(noisy);
        CHECK_FALSE(of_noisy.second.rounding);
        CHECK(of_noisy.second.noise->part > 0.9);
    }
    PolygonMesh clean = make_box(6000);
    clean.vertices *= 5.0 / edge;
    clean = test::rounded(clean, Point::Constant(1.0));
    const std::pair<PolygonMesh, DenoiseReport> of_clean = result_of(clean);
    CHECK(same_bits(of_clean.first.vertices, clean.vertices));
}
