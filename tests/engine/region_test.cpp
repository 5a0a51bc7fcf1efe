#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/state/flow_state.h"
#include "partition/errors.h"
#include "partition/metrics/feathered.h"
#include "partition/metrics/flipped_faces.h"
#include "partition/metrics/vertex_normals.h"
#include "partition/with_faces.h"
#include "samples/meshes/meshes.h"
#include "samples/meshes/random_numbers.h"
#include "tests/support/flows.h"
#include "tests/support/matrices.h"
#include "tests/support/messages.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Random strengths, among them 0 and 1.
std::vector<double> some_strengths(const PolygonMesh& mesh)
{
    RandomNumbers random(7);
    std::vector<double> strength;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        strength.push_back(std::clamp(0.5 + 0.8 * random.symmetric(), 0.0, 1.0));
    return strength;
}

/// 1 within a distance of the middle of the unit square, 0 elsewhere.
std::vector<double> disc(const PolygonMesh& mesh, double radius)
{
    std::vector<double> strength;
    for (const auto& row : mesh.vertices.rowwise())
        strength.push_back(std::hypot(row.x() - 0.5, row.y() - 0.5) < radius ? 1.0 : 0.0);
    return strength;
}

/// (1 / s + dt Δ + dt w) V' = V / s + dt w V⁰ where s is not 0, by a dense matrix.
Points dense_region_step(const PolygonMesh& mesh, const AllOptions& options, const Points& first)
{
    const Topology topology = make_topology(mesh);
    const std::vector<double>& strength = options.motion.strength;
    const double w = options.motion.attachment;
    Eigen::MatrixXd matrix = options.time_step * dense_laplacian(options.laplacian, mesh, topology);
    Eigen::MatrixXd right = mesh.vertices;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        if (!topology.moves(v) || strength[v] == 0.0) {
            matrix.row(v).setZero();
            matrix(v, v) = 1.0;
            continue;
        }
        matrix(v, v) += 1.0 / strength[v] + options.time_step * w;
        right.row(v) = mesh.vertices.row(v) / strength[v] + options.time_step * w * first.row(v);
    }
    return matrix.partialPivLu().solve(right);
}

/// Two steps, each with the Laplacian of the surface before it.
Points dense_region_flow(PolygonMesh mesh, const AllOptions& options)
{
    const Points first = mesh.vertices;
    for (int i = 0; i < options.steps; ++i)
        mesh.vertices = dense_region_step(mesh, options, first);
    return mesh.vertices;
}

AllOptions region_options(const PolygonMesh& mesh, Laplacian laplacian)
{
    const double edge = mean_edge_length(mesh, mesh.vertices);
    AllOptions options = FlowOptions{.laplacian = laplacian, .time_step = 4.0 * edge * edge, .steps = 2};
    options.uniform_edge = edge;
    options.motion.strength = some_strengths(mesh);
    return options;
}

AllOptions in_four_sub_meshes(AllOptions options)
{
    options.cut.subdomains = 4;
    options.accuracy.tolerance = 1e-12;
    return options;
}

AllOptions by_gradients(AllOptions options)
{
    options.accuracy.approach = Approach::ConjugateGradients;
    options.accuracy.tolerance = 1e-12;
    return options;
}

AllOptions in_one_factor(AllOptions options)
{
    options.accuracy.approach = Approach::Undecomposed;
    return options;
}

std::vector<AllOptions> all_ways(const AllOptions& options)
{
    std::vector<AllOptions> ways{in_one_factor(options), in_four_sub_meshes(options)};
    if (is_symmetric(options.laplacian))
        ways.push_back(by_gradients(options));
    return ways;
}

/// The largest second difference of heights between two steps of a grid of n by n vertices, over the grid's rows.
double sharpest_bend(const Points& heights, Index n)
{
    double sharpest = 0.0;
    for (Index row = 0; row < n; ++row)
        for (Index i = 1; i + 1 < n; ++i) {
            const Index v = row * n + i;
            sharpest = std::max(sharpest, std::abs(heights(v - 1, 2) - 2.0 * heights(v, 2) + heights(v + 1, 2)));
        }
    return sharpest;
}

}  // namespace

TEST_CASE("steps of a region are those of the dense equations with M / s, attached or not, however they are solved")
{
    for (const Laplacian laplacian : geometric_laplacians)
        for (const PolygonMesh& mesh : height_fields(120)) {
            CAPTURE(name_of(laplacian));
            CAPTURE(mesh.n_vertices());
            // Of Δ_P longer steps are indefinite.
            AllOptions options = region_options(mesh, laplacian);
            options.time_step *= is_symmetric(laplacian) ? 1.0 : 0.1;
            for (const double attachment : {0.0, is_symmetric(laplacian) ? 1.0 / options.time_step : 0.0}) {
                options.motion.attachment = attachment;
                const Points expected = dense_region_flow(mesh, options);
                CHECK(largest_difference(expected, mesh.vertices) > 1e-3);
                for (const AllOptions& way : all_ways(options))
                    CHECK(largest_difference(flowed(mesh, way), expected) < 1e-10);
            }
        }
}

TEST_CASE("a mask is the flow with all other vertices fixed, of which the faces elsewhere are left out")
{
    for (const Laplacian laplacian : all_laplacians)
        for (const PolygonMesh& mesh : height_fields(1600)) {
            CAPTURE(name_of(laplacian));
            CAPTURE(mesh.n_faces());
            AllOptions options = region_options(mesh, laplacian);
            options.time_step *= is_symmetric(laplacian) ? 1.0 : 0.1;
            options.motion.strength = disc(mesh, 0.2);
            AllOptions fixed = in_one_factor(options);
            fixed.motion.strength = {};
            for (Index v = 0; v < mesh.n_vertices(); ++v)
                if (options.motion.strength[v] == 0.0)
                    fixed.motion.fixed_vertices.push_back(v);
            const Points expected = flowed(mesh, fixed);
            for (const AllOptions& way : all_ways(options)) {
                PolygonMesh flowing = mesh;
                const FlowReport report = mean_curvature_flow(flowing, way);
                CHECK(largest_difference(flowing.vertices, expected) < 1e-9);
                CHECK(report.mesh.faces == mesh.n_faces());
                CHECK(std::ssize(report.cut.labels) == mesh.n_faces());
                Index n_in_sub_meshes = 0;
                for (const auto& sub_mesh : report.cut.sub_meshes)
                    n_in_sub_meshes += sub_mesh.faces;
                if (is_symmetric(laplacian))
                    CHECK(n_in_sub_meshes < mesh.n_faces() / 3);
                for (Index v = 0; v < mesh.n_vertices(); ++v)
                    if (options.motion.strength[v] == 0.0)
                        CHECK(same_bits(flowing.vertices.row(v), mesh.vertices.row(v)));
            }
        }
}

TEST_CASE("explicit steps of a region scale dt, and steps that keep edges scale displacements")
{
    const PolygonMesh mesh = make_triangles(400);
    AllOptions options = region_options(mesh, Laplacian::Fujiwara);
    options.steps = 1;
    // Edges are kept by fits to normals, which notice vertices that are held.
    for (double& s : options.motion.strength)
        s = std::max(s, 0.1);
    for (const bool keeps_edges : {false, true}) {
        options.time_step = keeps_edges ? options.time_step : 1e-6;
        options.scheme = keeps_edges ? Scheme::BackwardEuler : Scheme::ExplicitEuler;
        if (keeps_edges)
            options.keep_edges = 40.0;
        AllOptions everywhere = options;
        everywhere.motion.strength.clear();
        const Points part = flowed(mesh, options) - mesh.vertices;
        const Points whole = flowed(mesh, everywhere) - mesh.vertices;
        CHECK(whole.cwiseAbs().maxCoeff() > 1e-7);
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            CHECK((part.row(v) - options.motion.strength[v] * whole.row(v)).norm() < 1e-12);
    }
}

TEST_CASE("a strength of 1 everywhere is none, bit for bit")
{
    for (const PolygonMesh& mesh : height_fields(900)) {
        AllOptions options = region_options(mesh, Laplacian::AlexaWardetzky);
        AllOptions without = options;
        options.motion.strength.assign(usize(mesh.n_vertices()), 1.0);
        without.motion.strength.clear();
        CHECK(same_bits(flowed(mesh, options), flowed(mesh, without)));
    }
}

TEST_CASE("strengths too small to move anything are none, bit for bit")
{
    const PolygonMesh mesh = make_triangles(900);
    AllOptions options = region_options(mesh, Laplacian::Fujiwara);
    options.motion.strength = disc(mesh, 0.3);
    // So that faces elsewhere are not left out.
    options.motion.boundary = Boundary::Free;
    const AllOptions masked = options;
    for (double& strength : options.motion.strength)
        strength = std::max(strength, 0.5 * MotionOptions::least_strength);
    for (std::size_t way = 0; way < 3; ++way)
        CHECK(same_bits(flowed(mesh, all_ways(options)[way]), flowed(mesh, all_ways(masked)[way])));
}

TEST_CASE("filters and further flows of a region are those of one factor in sub-meshes")
{
    const PolygonMesh mesh = make_quads(900);
    const AllOptions plain = region_options(mesh, Laplacian::VirtualRefinement);
    AllOptions low_pass = plain;
    low_pass.filter = Filter::LowPass;
    AllOptions conformalized = plain;
    conformalized.flow = FlowEquation::Conformalized;
    AllOptions linear = plain;
    linear.flow = FlowEquation::Linear;
    for (const AllOptions& options : {low_pass, conformalized, linear})
        CHECK(largest_difference(flowed(mesh, in_four_sub_meshes(options)), flowed(mesh, in_one_factor(options))) <
              1e-9);
}

TEST_CASE("in an empty region nothing moves, and a remark says so")
{
    PolygonMesh mesh = make_triangles(400);
    const Points before = mesh.vertices;
    AllOptions options = region_options(mesh, Laplacian::Fujiwara);
    options.motion.strength.assign(usize(mesh.n_vertices()), 0.0);
    const FlowReport report = mean_curvature_flow(mesh, options);
    CHECK(same_bits(mesh.vertices, before));
    CHECK(sentences(report.remarks) ==
          std::vector<std::string>{"The region is empty: no vertex has a strength above 0, and nothing moves."});
}

TEST_CASE("a region with a feather has no crease at its rim")
{
    constexpr Index n = 61;
    PolygonMesh mesh = triangle_grid(n - 1, n - 1);
    // A bump over the whole sheet, of which one half is smoothed.
    for (auto row : mesh.vertices.rowwise())
        row.z() = 2.0 * std::sin(0.1 * row.x()) * std::sin(0.1 * row.y());
    AllOptions options = FlowOptions{.time_step = 100.0, .steps = 3};
    for (const auto& row : mesh.vertices.rowwise())
        options.motion.strength.push_back(row.x() > 24.5 ? 1.0 : 0.0);
    const double sharp = sharpest_bend(flowed(mesh, options), n);
    options.motion.strength = feathered(mesh, options.motion.strength, 30.0);
    const double soft = sharpest_bend(flowed(mesh, options), n);
    const double before = sharpest_bend(mesh.vertices, n);
    CHECK(sharp > 3.0 * before);
    CHECK(soft < 1.05 * before);
}

TEST_CASE("motion along an axis leaves the other coordinates bit for bit, however steps are taken")
{
    PolygonMesh mesh = make_triangles(900);
    const Index middle = mesh.n_vertices() / 2 + 15;
    mesh.vertices.col(0).array() -= double{mesh.vertices(middle, 0)};
    mesh.vertices(middle, 0) = -0.0;
    AllOptions options = region_options(mesh, Laplacian::Fujiwara);
    options.motion.strength.clear();
    options.motion.direction = {.kind = MotionDirection::Kind::Vector, .vector = {0.0, 0.0, 5.0}};
    std::vector<AllOptions> ways = all_ways(options);
    ways.push_back(options);
    ways.back().cut.subdomains = 6;
    ways.back().accuracy.approach = Approach::Sweep;
    ways.push_back(options);
    ways.back().scheme = Scheme::ExplicitEuler;
    ways.back().time_step = 1e-6;
    ways.push_back(options);
    ways.back().keep_edges = 60.0;
    ways.push_back(options);
    ways.back().motion.within = 1e-3;
    ways.push_back(options);
    ways.back().motion.limits.slide = 1e-4;
    // Up and down: one of the two would add 0 to -0, and not -0.
    for (const double sense : {1.0, -1.0})
        for (AllOptions way : ways) {
            way.motion.direction.vector[2] *= sense;
            const Points after = flowed(mesh, way);
            Points flat = after;
            flat.col(2) = mesh.vertices.col(2);
            CHECK(same_bits(flat, mesh.vertices));
            CHECK((after - mesh.vertices).col(2).cwiseAbs().maxCoeff() > 1e-6);
        }
}

TEST_CASE("a step along lines ends on the surface that the step makes, and the flow continues from there")
{
    PolygonMesh mesh = make_quads(400);
    mesh.vertices.col(2) *= 0.5;
    AllOptions options = region_options(mesh, Laplacian::VirtualRefinement);
    options.motion.strength.clear();
    options.steps = 1;
    for (const MotionDirection& direction : {MotionDirection{MotionDirection::Kind::Vector, Point(0.1, -0.1, 3.0)},
                                             MotionDirection{MotionDirection::Kind::Normal, Point(0.0, 0.0, 0.0)}}) {
        PolygonMesh expected = mesh;
        const Topology topology = make_topology(mesh);
        const VertexNormals normals(mesh, topology);
        for (int i = 0; i < 3; ++i) {
            const Points moved = flowed(expected, in_one_factor(options));
            for (Index v = 0; v < mesh.n_vertices(); ++v) {
                const Point n = normals(v, moved);
                const Point way = moved.row(v) - expected.vertices.row(v);
                const Point d =
                    direction.kind == MotionDirection::Kind::Normal ? n : Point(direction.vector.normalized());
                // No face of this mesh is steep, as seen along the lines.
                REQUIRE(std::abs(d.dot(n)) > 0.7);
                expected.vertices.row(v) += way.dot(n) / d.dot(n) * d;
            }
        }
        AllOptions directed = options;
        directed.steps = 3;
        directed.motion.direction = direction;
        for (AllOptions& way : all_ways(directed)) {
            way.report.measures = false;
            CHECK(largest_difference(flowed(mesh, way), expected.vertices) < 1e-9);
        }
    }
}

TEST_CASE(
    "a plane stays a plane along any line, at its rim, too, and where its triangles are uneven, and follows noise")
{
    PolygonMesh mesh = make_triangles(900);
    RandomNumbers random(4);
    Points noise = Points::Zero(mesh.n_vertices(), 3);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        mesh.vertices.row(v) += Point(0.01 * random.unit(), 0.01 * random.unit(), 0.0);
        noise(v, 2) = 0.003 * (random.unit() - 0.5);
    }
    const auto distance = [](const Points& from, const Points& to) { return (from - to).col(2).norm(); };
    for (const double slope : {0.5, 2.0, 10.0}) {
        mesh.vertices.col(2) = slope * (mesh.vertices.col(0) - 0.6 * mesh.vertices.col(1));
        PolygonMesh noisy = mesh;
        noisy.vertices += noise;
        for (const MotionDirection& direction : {MotionDirection{MotionDirection::Kind::Vector, Point::UnitZ()},
                                                 MotionDirection{MotionDirection::Kind::Normal, Point::Zero()}})
            for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::Uniform, Laplacian::VirtualRefinement})
                for (const Boundary boundary : {Boundary::Fixed, Boundary::Free})
                    for (const Filter filter : {Filter::Diffusion, Filter::LowPass}) {
                        AllOptions options =
                            FlowOptions{.laplacian = laplacian, .filter = filter, .time_step = 1e-3, .steps = 3};
                        options.accuracy.approach = Approach::Undecomposed;
                        options.motion.boundary = boundary;
                        const Points free = flowed(mesh, options);
                        // Only virtual refinement leaves vertices in a plane where they are.
                        const bool slides = laplacian != Laplacian::VirtualRefinement || boundary == Boundary::Free;
                        CHECK((largest_difference(free, mesh.vertices) > 1e-3) == slides);
                        options.motion.direction = direction;
                        CHECK(largest_difference(flowed(mesh, options), mesh.vertices) < 1e-12 * slope);
                        if (direction.kind == MotionDirection::Kind::Vector && slope < 5.0)
                            CHECK(distance(flowed(noisy, options), mesh.vertices) < 0.8 * noise.norm());
                    }
    }
}

TEST_CASE(
    "motion along a line folds no sphere, however near its silhouette, and brings a steep dome where the flow does")
{
    PolygonMesh mesh = make_noisy_sphere(2500);
    mesh.vertices.rowwise().normalize();
    AllOptions options = FlowOptions{.laplacian = Laplacian::VirtualRefinement};
    options.accuracy.approach = Approach::Undecomposed;
    options.motion.direction = {.kind = MotionDirection::Kind::Vector, .vector = {0.0, 0.0, 1.0}};
    for (const double dt : {3e-3, 3e-2}) {
        options.time_step = dt;
        CHECK(flipped_faces(mesh, mesh.vertices, flowed(mesh, options)).empty());
    }
    // The part above z = 0.3 is a height field. Inside, where nothing is known of its rim yet, it shrinks as the
    // sphere.
    options.time_step = 1e-3;
    const PolygonMesh dome = with_faces(mesh, [&](Index f) {
        return std::ranges::all_of(mesh.face(f), [&](Index v) { return mesh.vertices(v, 2) > 0.3; });
    });
    const Points after = flowed(dome, options);
    for (Index v = 0; v < dome.n_vertices(); ++v)
        if (const Point p = dome.vertices.row(v); p.z() > 0.5)
            CHECK(after.row(v).norm() == relative(1.0 - 2e-3, 5e-4));
}

TEST_CASE("a flow of a region holds and moves vertices between steps")
{
    const PolygonMesh mesh = make_triangles(1600);
    AllOptions options = in_four_sub_meshes(region_options(mesh, Laplacian::Fujiwara));
    options.motion.strength = disc(mesh, 0.3);
    options.motion.direction = {.kind = MotionDirection::Kind::Normal};
    options.steps = 3;
    PolygonMesh changed = mesh;
    Flow flow(changed, options);
    const std::vector<Index> inside{mesh.n_vertices() / 2 + 20};
    REQUIRE(options.motion.strength[usize(inside.front())] == 1.0);
    const std::vector<Index> outside{0};
    flow.hold(inside);
    flow.step();
    CHECK(same_bits(changed.vertices.row(inside.front()), mesh.vertices.row(inside.front())));
    flow.release(inside);
    flow.step();
    CHECK_FALSE(same_bits(changed.vertices.row(inside.front()), mesh.vertices.row(inside.front())));
    CHECK_THROWS_AS(flow.release(outside), OptionError);
    const Points to = mesh.vertices.row(0) + Point(0.0, 0.0, 0.5);
    flow.move(outside, to);
    CHECK(same_bits(changed.vertices.row(0), to));
}

TEST_CASE("copies of a vertex along a seam have the least of their strengths, and move as one")
{
    const PolygonMesh whole = make_triangles(900);
    const PolygonMesh mesh = split(whole, halves(whole));
    REQUIRE(mesh.n_vertices() > whole.n_vertices());
    AllOptions options = in_four_sub_meshes(region_options(mesh, Laplacian::Fujiwara));
    AllOptions of_whole = options;
    of_whole.motion.strength.resize(usize(whole.n_vertices()));
    const std::vector<Index> of = originals(mesh, whole);
    for (Index v = whole.n_vertices(); v < mesh.n_vertices(); ++v) {
        double& strength = of_whole.motion.strength[usize(of[v])];
        strength = std::min(strength, options.motion.strength[usize(v)]);
    }
    const Points expected = flowed(whole, of_whole);
    CHECK(largest_difference(flowed(mesh, options).topRows(whole.n_vertices()), expected) < 1e-9);
}

TEST_CASE("a face that repeats another is in its sub-mesh, also where faces beside a region are left out")
{
    const PolygonMesh mesh = make_triangles(1600);
    const Index repeated = mesh.n_faces() / 2 + 20;
    PolygonMesh with_repeated;
    with_repeated.vertices = mesh.vertices;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (int i = 0; i < (f == repeated ? 2 : 1); ++i)
            with_repeated.add_face(mesh.face(f));
    AllOptions options = in_four_sub_meshes(region_options(mesh, Laplacian::Fujiwara));
    options.motion.strength = disc(mesh, 0.3);
    PolygonMesh flowing = mesh;
    std::vector<Index> expected = mean_curvature_flow(flowing, options).cut.labels;
    CHECK(expected[usize(repeated)] < 4);
    expected.insert(expected.begin() + repeated, expected[usize(repeated)]);
    CHECK(mean_curvature_flow(with_repeated, options).cut.labels == expected);
    CHECK(same_bits(with_repeated.vertices, flowing.vertices));
}

TEST_CASE("the way of taking steps that is chosen for a region is never by sweeps")
{
    PolygonMesh mesh = make_triangles(12'000);
    for (const Laplacian laplacian : all_laplacians)
        for (const int subdomains : {0, 8}) {
            AllOptions options = region_options(mesh, laplacian);
            options.time_step *= 0.1;
            options.cut.subdomains = subdomains;
            options.steps = 1;
            PolygonMesh flowing = mesh;
            CHECK(mean_curvature_flow(flowing, options).convergence.approach != Approach::Sweep);
        }
}
