#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/measure/surface_measures.h"
#include "engine/setup/presets.h"
#include "engine/setup/smoothed_radius.h"
#include "engine/tasks/parallel_loop.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/metrics/vertex_normals.h"
#include "samples/common/meshes.h"
#include "tests/support/denoising.h"
#include "tests/support/flows.h"
#include "tests/support/random_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

struct Case {
    PolygonMesh truth;
    PolygonMesh noisy;
};

Case bumpy_sphere(double noise, Index vertices = 4000)
{
    const PolygonMesh truth = make_noisy_sphere(vertices, {.amplitude = 0.1, .noise = 0.0});
    return {truth, with_gaussian_noise(truth, noise, 7)};
}

/// Of the offsets along the true normals, root mean square.
double distance(const PolygonMesh& truth, const Points& positions)
{
    const Topology topology = make_topology(truth);
    const VertexNormals normals(truth, topology);
    double total = 0.0;
    for (Index v = 0; v < truth.n_vertices(); ++v) {
        const double offset = (positions.row(v) - truth.vertices.row(v)).dot(normals(v, truth.vertices));
        total += offset * offset;
    }
    return std::sqrt(total / truth.n_vertices());
}

PolygonMesh smoothed(PolygonMesh mesh, Preset preset)
{
    mean_curvature_flow(mesh, options_for(preset, mesh).options);
    return mesh;
}

/// Parts without noise: few faces, many, all alike, slivers, polygons.
std::vector<PolygonMesh> clean_parts()
{
    std::vector<PolygonMesh> parts;
    for (const Index n : {5, 6, 48}) {
        // A prism on a regular n-gon, and a pyramid.
        PolygonMesh prism = cylinder(n, 1);
        std::vector<Index> low;
        std::vector<Index> high;
        for (Index v = 0; v < prism.n_vertices(); ++v)
            (prism.vertices(v, 2) < prism.vertices.col(2).mean() ? low : high).push_back(v);
        prism.add_face(low);
        prism.add_face(high);
        parts.push_back(prism);
    }
    for (const Index n : {400, 3000}) {
        parts.push_back(make_box(n));
        parts.push_back(make_gear(n));
        parts.push_back(make_stepped_cylinder(n));
        parts.push_back(make_chamfered_plate(n));
    }
    parts.push_back(quad_torus(12, 7));
    parts.push_back(triangle_torus(60, 40));
    parts.push_back(quad_grid(30, 30));
    PolygonMesh slivers = triangle_grid(40, 3);
    slivers.vertices.col(0) *= 1e-3;
    parts.push_back(slivers);
    return parts;
}

}  // namespace

TEST_CASE("the scan preset comes nearer to the truth than ten passes of Taubin's filter, in distance and in normals")
{
    for (const double noise : {0.05, 0.1, 0.2, 0.3}) {
        CAPTURE(noise);
        const Case c = bumpy_sphere(noise);
        const PolygonMesh result = smoothed(c.noisy, Preset::Scan);
        const PolygonMesh taubin = taubin_smoothed(c.noisy, 10);
        CHECK(distance(c.truth, result.vertices) < distance(c.truth, taubin.vertices));
        CHECK(angle_to_truth(c.truth, result) < angle_to_truth(c.truth, taubin));
        CHECK(distance(c.truth, result.vertices) < 0.5 * distance(c.truth, c.noisy.vertices));
    }
}

TEST_CASE("what has no noise is not smoothed by presets that go by it, and one sentence says so")
{
    for (const PolygonMesh& mesh : clean_parts())
        for (const Preset preset : {Preset::Scan, Preset::Terrain}) {
            CAPTURE(mesh.n_vertices());
            const PresetChoice choice = options_for(preset, mesh);
            CHECK(choice.noise == 0.0);
            CHECK(choice.options.steps == 0);
            CHECK(choice.remark.find("nothing is smoothed") != std::string::npos);
            CHECK(choice.remark.find("--radius") != std::string::npos);
            CHECK(choice.remark.find("--preset cad") != std::string::npos);
            PolygonMesh moved = mesh;
            mean_curvature_flow(moved, choice.options);
            CHECK(same_bits(moved.vertices, mesh.vertices));
        }
}

TEST_CASE("clean parts are fixed points where edges are kept, whatever the amount")
{
    for (const PolygonMesh& mesh : clean_parts()) {
        CAPTURE(mesh.n_vertices());
        // Neither flat nor round along its quads.
        if (mesh.n_vertices() == 12 * 7)
            continue;
        const double edge = mean_edge_length(mesh, mesh.vertices);
        const auto check = [&](const FlowOptions& options) {
            const Points moved = flowed(mesh, options);
            CHECK((moved - mesh.vertices).rowwise().norm().maxCoeff() <= 1e-6 * extent_of(mesh.vertices));
        };
        check(options_for(Preset::Cad, mesh).options);
        for (const double edges : {1e-12, 1.0, 1000.0}) {
            FlowOptions options;
            options.keep_edges = 30.0;
            options.time_step = edges * edge * edge;
            check(options);
        }
    }
}

TEST_CASE("noise that is said is believed, and no more is taken than it")
{
    const Case c = bumpy_sphere(0.1);
    const double edge = mean_edge_length(c.truth, c.truth.vertices);
    const double known = 0.1 * edge / std::sqrt(3.0);
    const PresetChoice choice = options_for(Preset::Scan, c.noisy, {}, LengthOnMesh{known, false});
    CHECK(choice.noise == known);
    CHECK(choice.options.motion.limits.move == known);
    const PresetChoice by_diagonal =
        options_for(Preset::Scan, c.noisy, {}, LengthOnMesh{known / extent_of(c.noisy.vertices), true});
    CHECK(std::abs(by_diagonal.options.time_step / choice.options.time_step - 1.0) < 0.01);
    PolygonMesh result = c.noisy;
    mean_curvature_flow(result, choice.options);
    CHECK(distance(c.noisy, result.vertices) <= known * 1.001);
    // More noise asks for more.
    const PresetChoice more = options_for(Preset::Scan, c.noisy, {}, LengthOnMesh{2.0 * known, false});
    CHECK(more.options.time_step > choice.options.time_step);
}

TEST_CASE("a preset does the same to a mesh that is larger, further away, renumbered or beside another of its kind")
{
    const Case c = bumpy_sphere(0.2);
    const double edge = mean_edge_length(c.noisy, c.noisy.vertices);
    const auto amount = [](const PolygonMesh& mesh) {
        const PresetChoice choice = options_for(Preset::Scan, mesh);
        const double mean_edge = mean_edge_length(mesh, mesh.vertices);
        return choice.options.time_step / (mean_edge * mean_edge);
    };
    const double own = amount(c.noisy);
    CHECK(own > 0.0);
    PolygonMesh scaled = c.noisy;
    scaled.vertices *= 1000.0;
    CHECK(std::abs(amount(scaled) / own - 1.0) < 1e-9);
    const PolygonMesh scaled_result = smoothed(scaled, Preset::Scan);
    const PolygonMesh result = smoothed(c.noisy, Preset::Scan);
    CHECK((scaled_result.vertices / 1000.0 - result.vertices).cwiseAbs().maxCoeff() < 1e-6 * edge);
    PolygonMesh away = c.noisy;
    away.vertices.rowwise() += Point(100.0, -20.0, 3.0);
    CHECK(std::abs(amount(away) / own - 1.0) < 1e-3);
    // Twice as many vertices say a little more of the noise.
    const Points both = smoothed(side_by_side({c.noisy, c.noisy}), Preset::Scan).vertices;
    PolygonMesh first = c.noisy;
    first.vertices = both.topRows(c.noisy.n_vertices());
    const Point offset = first.vertices.colwise().mean() - result.vertices.colwise().mean();
    first.vertices.rowwise() -= offset;
    CHECK(std::abs(distance(c.truth, first.vertices) / distance(c.truth, result.vertices) - 1.0) < 0.1);
}

TEST_CASE("the amount is that of the radius, whatever filter and operator the options have")
{
    const Case c = bumpy_sphere(0.2);
    const PresetChoice own = options_for(Preset::Scan, c.noisy);
    const double radius = smoothed_radius(own.options.time_step, 1, filter_of(own.options));
    const auto check = [&](auto change) {
        PresetChoice other = own;
        change(other.options);
        choose_amount(preset_of("scan"), c.noisy, {}, other);
        CHECK(
            std::abs(smoothed_radius(other.options.time_step, other.options.steps, filter_of(other.options)) / radius -
                     1.0) < 0.01);
    };
    check([](FlowOptions& o) { o.order = 1; });
    check([](FlowOptions& o) { o.order = 2, o.steps = 3; });
    check([](FlowOptions& o) { o.order.reset(), o.filter = Filter::LowPass, o.laplacian = Laplacian::Fujiwara; });
}

TEST_CASE("presets have names, and all of them work on a scan, on any number of threads")
{
    CHECK(all_presets().front().name == "scan");
    CHECK_THROWS_WITH_AS(preset_of("best"), doctest::Contains("there is no preset \"best\""), OptionError);
    const Case c = bumpy_sphere(0.2, 2000);
    for (const PresetTraits& preset : all_presets()) {
        CAPTURE(preset.name);
        CHECK(preset_of(preset.name).preset == preset.preset);
        const PresetChoice choice = options_for(preset.preset, c.noisy, {}, {}, run_in_parallel);
        CHECK(choice.noise.has_value() == preset.measures_noise());
        CHECK(choice.remark.empty());
        CHECK(choice.options.time_step == options_for(preset.preset, c.noisy).options.time_step);
        FlowOptions one = choice.options;
        one.resources.threads = 1;
        CHECK(same_bits(flowed(c.noisy, choice.options), flowed(c.noisy, one)));
        if (preset.measures_noise())
            CHECK(distance(c.truth, flowed(c.noisy, choice.options)) < distance(c.truth, c.noisy.vertices));
    }
    PolygonMesh point = c.noisy;
    point.vertices.setZero();
    CHECK_THROWS_WITH_AS(options_for(Preset::Cad, point), doctest::Contains("has no size"), InputError);
}
