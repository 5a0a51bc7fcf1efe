#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "engine/denoise.h"
#include "engine/mean_curvature_flow.h"
#include "engine/setup/presets.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/metrics/volume.h"
#include "samples/meshes/meshes.h"
#include "samples/meshes/random_numbers.h"
#include "solvers/laplacian/geometry.h"
#include "tests/support/denoising.h"
#include "tests/support/flows.h"
#include "tests/support/junction_meshes.h"
#include "tests/support/messages.h"
#include "tests/support/preset_choices.h"
#include "tests/support/random_meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::largest_difference;
using test::same_bits;

namespace {

struct DenoisedMesh {
    Points positions;
    DenoiseReport report;
};

DenoisedMesh denoised(PolygonMesh mesh, const DenoiseOptions& options = {})
{
    DenoiseReport report = denoise(mesh, options);
    return {std::move(mesh.vertices), std::move(report)};
}

Points denoised_positions(const PolygonMesh& mesh, const DenoiseOptions& options)
{
    return denoised(mesh, options).positions;
}

DenoiseOptions with_motion(const std::function<void(MotionOptions&)>& change)
{
    DenoiseOptions options;
    change(options.motion);
    return options;
}

PolygonMesh with(PolygonMesh mesh, Points positions)
{
    mesh.vertices = std::move(positions);
    return mesh;
}

double mean_edge(const PolygonMesh& mesh)
{
    return mean_edge_length(mesh, mesh.vertices);
}

PolygonMesh bumpy_sphere(Index vertices = 4000)
{
    return make_noisy_sphere(vertices, {.amplitude = 0.1, .noise = 0.0});
}

/// Faces that point away from those of the true surface.
int count_turned(const PolygonMesh& truth, const Points& positions)
{
    int n = 0;
    for (Index f = 0; f < truth.n_faces(); ++f)
        n += vector_area(truth.face(f), positions).dot(vector_area(truth.face(f), truth.vertices)) < 0.0 ? 1 : 0;
    return n;
}

/// Root mean square.
double difference(const Points& a, const Points& b)
{
    return std::sqrt((a - b).rowwise().squaredNorm().mean());
}

}  // namespace

TEST_CASE("noise of any size goes, on round and on sharp shapes, better than by filters that know the truth")
{
    const test::BilateralGrid filters{{0.25, 0.35}, {10, 30}, {20}};
    std::vector<PolygonMesh> truths{bumpy_sphere(), test::triangle_torus(80, 40)};
    for (const char* kind : {"gear", "box", "chamfered-plate"})
        truths.push_back(make_mesh(kind, 8000));
    for (std::size_t i = 0; i < truths.size(); ++i)
        for (const double noise : {0.1, 0.3, 0.6}) {
            CAPTURE(i);
            CAPTURE(noise);
            const PolygonMesh noisy = test::with_gaussian_noise(truths[i], noise, 3);
            const DenoisedMesh outcome = denoised(noisy);
            const PolygonMesh result = with(noisy, outcome.positions);
            const double left = test::angle_to_truth(truths[i], result);
            CHECK(left < 0.35 * test::angle_to_truth(truths[i], noisy));
            // With little noise, many rounds of a filter that knows how many are better.
            if (noise > 0.1) {
                CHECK(left <
                      test::angle_to_truth(truths[i], test::best_of_bilateral_filters(truths[i], noisy, filters)));
                CHECK(left < test::angle_to_truth(truths[i], test::taubin_smoothed(noisy, 15)));
            }
            CHECK(count_turned(truths[i], outcome.positions) <= count_turned(truths[i], noisy.vertices));
            // Its part along random directions is a third of the variance.
            CHECK(outcome.report.noise->deviation > 0.3 * noise);
            CHECK(outcome.report.noise->deviation < 1.3 * noise);
            CHECK(outcome.report.noise->part > 0.9);
        }
}

TEST_CASE("surfaces without noise stay bit for bit")
{
    std::vector<PolygonMesh> clean{bumpy_sphere(), test::triangle_torus(60, 30), test::quad_torus(60, 30),
                                   test::cylinder(80, 40), test::triangle_grid(40, 40)};
    for (const char* kind : {"gear", "box", "stepped-cylinder", "chamfered-plate", "gear-quads"})
        clean.push_back(make_mesh(kind, 6000));
    for (std::size_t i = 0; i < clean.size(); ++i) {
        CAPTURE(i);
        const DenoisedMesh outcome = denoised(clean[i]);
        CHECK(outcome.positions.cwiseEqual(clean[i].vertices).all());
        CHECK(outcome.report.noise->part == 0.0);
        CHECK(test::count_with(outcome.report.remarks, "No noise was found") == 1);
    }
}

TEST_CASE("a component decides for itself, whatever its size and wherever the others are")
{
    const PolygonMesh noisy = test::with_gaussian_noise(bumpy_sphere(3000), 0.3, 5);
    PolygonMesh far = bumpy_sphere(2000);
    far.vertices = (100.0 * far.vertices).rowwise() + Point(1e4, 0, 0);
    const PolygonMesh both = test::together({noisy, far});
    const Points together = denoised(both).positions;
    CHECK(together.bottomRows(far.n_vertices()).cwiseEqual(far.vertices).all());
    const Points alone = denoised(noisy).positions;
    CHECK(difference(together.topRows(noisy.n_vertices()), alone) < 1e-3 * mean_edge(noisy));
}

TEST_CASE("the result hardly depends on numbers, size, place and direction")
{
    const PolygonMesh mesh = test::with_gaussian_noise(make_mesh("gear", 4000), 0.3, 2);
    const Points result = denoised(mesh).positions;
    const double little = 0.04 * mean_edge(mesh);  // ties among patches go either way

    const test::ShuffledMesh shuffled = test::shuffled(mesh, 9);
    CHECK(difference(denoised(shuffled.mesh).positions(shuffled.new_vertex, Eigen::all), result) < little);

    for (const double size : {1e3, std::ldexp(1.0, -20)})
        CHECK(difference(denoised(with(mesh, size * mesh.vertices)).positions / size, result) < little);
    const Point far(1e6, -2e6, 3e5);
    const Points moved = denoised(with(mesh, mesh.vertices.rowwise() + far)).positions.rowwise() - far;
    CHECK(difference(moved, result) < little);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    CHECK(difference(denoised(with(mesh, mesh.vertices * turn)).positions * turn.transpose(), result) < little);
    CHECK(difference(denoised(test::with_faces_flipped(mesh, 4)).positions, result) < little);
}

TEST_CASE("a few spikes do not keep the rest from being smoothed")
{
    const PolygonMesh truth = bumpy_sphere();
    PolygonMesh noisy = test::with_gaussian_noise(truth, 0.2, 1);
    for (Index v = 17; v < noisy.n_vertices(); v += 400)
        noisy.vertices.row(v) *= 1.0 + 5.0 * mean_edge(truth);
    const PolygonMesh result = with(noisy, denoised(noisy).positions);
    CHECK(test::angle_to_truth(truth, result) < 0.4 * test::angle_to_truth(truth, noisy));
}

TEST_CASE("a vertex that stands for missing data stays, is named, and does not keep the others from being smoothed")
{
    const PolygonMesh truth = test::triangle_grid(45, 45);
    PolygonMesh noisy = test::with_gaussian_noise(truth, 0.15, 1);
    const double before = test::angle_to_truth(truth, noisy);
    const Index spike = 1000;
    const double height = noisy.vertices(spike, 2);
    noisy.vertices(spike, 2) = -9999.0;
    const DenoisedMesh outcome = denoised(noisy);
    CHECK(outcome.positions(spike, 2) == -9999.0);
    CHECK(test::count_with(outcome.report.remarks, "Vertex 1000 (numbered from 0) is ") == 1);
    PolygonMesh result = with(noisy, outcome.positions);
    result.vertices(spike, 2) = height;
    CHECK(test::angle_to_truth(truth, result) < 0.3 * before);
}

TEST_CASE("terrains keep x and y, and walls; planes stay planes, and noise goes")
{
    PolygonMesh truth = make_triangles(2500);
    RandomNumbers random(3);
    const double edge = mean_edge(truth);
    for (Index v = 0; v < truth.n_vertices(); ++v) {
        const double x = truth.vertices(v, 0) + 0.2 * edge * random.symmetric();
        const double y = truth.vertices(v, 1) + 0.2 * edge * random.symmetric();
        truth.vertices.row(v) = Point(x, y, 0.4 * x - 0.2 * y + (x > 0.3 && x < 0.7 && y > 0.3 ? 6.0 * edge : 0.0));
    }
    const auto flow = [](PolygonMesh mesh) {
        mesh.vertices = test::moved_by(options_for(Preset::Terrain, mesh), mesh);
        return mesh;
    };
    CHECK(flow(truth).vertices.cwiseEqual(truth.vertices).all());
    PolygonMesh noisy = truth;
    for (Index v = 0; v < noisy.n_vertices(); ++v)
        noisy.vertices(v, 2) += 0.35 * edge * random.symmetric();
    const PolygonMesh result = flow(noisy);
    CHECK(result.vertices.leftCols<2>().cwiseEqual(noisy.vertices.leftCols<2>()).all());
    CHECK((result.vertices - truth.vertices).norm() < 0.6 * (noisy.vertices - truth.vertices).norm());
    CHECK(test::angle_to_truth(truth, result) < 0.4 * test::angle_to_truth(truth, noisy));
}

TEST_CASE("a call without options removes noise")
{
    const PolygonMesh noisy = test::with_gaussian_noise(bumpy_sphere(2000), 0.2, 5);
    PolygonMesh mesh = noisy;
    CHECK(denoise(mesh).noise->part > 0.9);
    CHECK(mesh.vertices.cwiseEqual(denoised(noisy).positions).all());
}

TEST_CASE("where a part of a surface has no noise it stays")
{
    const PolygonMesh truth = test::triangle_grid(90, 60);
    const PolygonMesh all = test::with_gaussian_noise(truth, 0.3, 1);
    PolygonMesh mesh = truth;
    for (Index v = 0; v < truth.n_vertices(); ++v)
        if (truth.vertices(v, 0) < 60.0)
            mesh.vertices.row(v) = all.vertices.row(v);
    const DenoisedMesh outcome = denoised(mesh);
    for (Index v = 0; v < truth.n_vertices(); ++v)
        if (truth.vertices(v, 0) > 75.0)
            CHECK((outcome.positions.row(v) - mesh.vertices.row(v)).norm() < 1e-3);
    CHECK(test::angle_to_truth(truth, with(mesh, outcome.positions)) < 0.15 * test::angle_to_truth(truth, mesh));
}

TEST_CASE("vertices that are held stay, and strengths scale motions")
{
    const PolygonMesh mesh = test::with_gaussian_noise(bumpy_sphere(2000), 0.3, 6);
    const Points free = denoised(mesh).positions;
    const Points held = denoised(mesh, with_motion([](MotionOptions& motion) {
                                     motion.fixed_vertices = {5, 700};
                                 }))
                            .positions;
    for (const Index v : {5, 700})
        CHECK(held.row(v).cwiseEqual(mesh.vertices.row(v)).all());
    CHECK(largest_difference(free, held) > 0.0);
    std::vector<double> strength(usize(mesh.n_vertices()), 1.0);
    std::fill(strength.begin(), strength.begin() + 1000, 0.0);
    const Points part =
        denoised(mesh, with_motion([&](MotionOptions& motion) { motion.strength = strength; })).positions;
    CHECK(part.topRows(1000).cwiseEqual(mesh.vertices.topRows(1000)).all());
    CHECK(largest_difference(part, mesh.vertices) > 0.0);
}

TEST_CASE("feature edges stay bit for bit, and what is on one side of them does not matter to the other")
{
    constexpr Index n = 50;
    const PolygonMesh truth = test::triangle_grid(n - 1, n - 1);
    // The middle row.
    DenoiseOptions options;
    std::vector<Index> line;
    for (Index k = 0; k < n; ++k)
        line.push_back(n * (n / 2) + k);
    for (Index k = 0; k + 1 < n; ++k)
        options.motion.feature_edges.push_back({line[k], line[k + 1]});
    const PolygonMesh noisy = test::with_gaussian_noise(truth, 0.4, 3);
    const Points with = denoised_positions(noisy, options);
    CHECK(with != denoised_positions(noisy, DenoiseOptions()));
    PolygonMesh changed = noisy;
    for (Index v = n * (n / 2 + 1); v < n * n; ++v)
        changed.vertices.row(v) = truth.vertices.row(v) + 0.5 * (noisy.vertices.row(v) - truth.vertices.row(v));
    const Points of_changed = denoised_positions(changed, options);
    for (const Index v : line)
        CHECK((with.row(v) == noisy.vertices.row(v)));
    // Of the row beside the line: rounding alone changes results by some thousandths of an edge.
    const auto difference = [&](const Points& a, const Points& b) {
        return (a - b).middleRows(n * (n / 2 - 1), n).norm() / (std::sqrt(n) * mean_edge(truth));
    };
    const DenoiseOptions without;
    CHECK(difference(of_changed, with) <
          0.2 * difference(denoised_positions(changed, without), denoised_positions(noisy, without)));
}

TEST_CASE("lines of three sheets move, also if a feature edge is kept elsewhere")
{
    const std::vector<double> angles{0.0, 2.0, 4.0};
    const PolygonMesh clean = test::plates(angles, 15, 30);
    const PolygonMesh noisy = test::with_gaussian_noise(clean, 0.2, 3);
    const Topology topology = make_topology(noisy);
    DenoiseOptions options;
    const Points without = denoised_positions(noisy, options);
    // At the outer end of the last plate.
    const Index last = noisy.n_vertices() - 1;
    options.motion.feature_edges = {{last - 1, last}};
    const Points with = denoised_positions(noisy, options);
    int n_moved = 0;
    for (Index v = 0; v < noisy.n_vertices(); ++v)
        if (topology.kind[v] == VertexKind::NonManifold && without.row(v) != noisy.vertices.row(v)) {
            ++n_moved;
            CHECK(with.row(v) != noisy.vertices.row(v));
        }
    CHECK(n_moved > 10);
}

TEST_CASE("the angle of edges that stay counts where there is little noise")
{
    const PolygonMesh part = make_chamfered_plate(3000);
    const PolygonMesh noisy = test::with_gaussian_noise(part, 0.05, 3);
    DenoiseOptions options;
    const Points by_default = denoised_positions(noisy, options);
    options.method = RemoveNoise{30.0};
    CHECK(same_bits(denoised_positions(noisy, options), by_default));
    options.method = RemoveNoise{5.0};
    CHECK(!same_bits(denoised_positions(noisy, options), by_default));
}

TEST_CASE("the area of noise is not restored, and a remark says so; volumes are")
{
    const PolygonMesh noisy = make_noisy_sphere(2000, {.amplitude = 0.1, .noise = 0.1});
    const DenoisedMesh plain = denoised(noisy, with_motion([](MotionOptions&) {}));
    const DenoisedMesh of_area = denoised(noisy, with_motion([](MotionOptions& m) { m.rescale = Rescale::Area; }));
    CHECK(same_bits(of_area.positions, plain.positions));
    CHECK(test::names(of_area.report.remarks, "area not restored"));
    CHECK_FALSE(test::names(plain.report.remarks, "area not restored"));
    const DenoisedMesh of_volume = denoised(noisy, with_motion([](MotionOptions& m) { m.rescale = Rescale::Volume; }));
    CHECK_FALSE(same_bits(of_volume.positions, plain.positions));
    const auto volume = [&](const Points& positions) {
        return volume_of_cones(noisy, positions, Point::Zero(), run_serially);
    };
    CHECK(std::abs(volume(of_volume.positions) / volume(noisy.vertices) - 1.0) < 1e-9);
    // Where the amount is given, areas are restored.
    PolygonMesh flowed = noisy;
    FlowOptions options;
    options.time_step_edges = 1.0;
    options.motion.rescale = Rescale::Area;
    const FlowReport report = mean_curvature_flow(flowed, options);
    CHECK_FALSE(test::names(report.remarks, "area not restored"));
}
