#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include <doctest/doctest.h>

#include "engine/denoise.h"
#include "engine/mean_curvature_flow.h"
#include "engine/measure/smoothed_radius.h"
#include "engine/options/option_rules.h"
#include "engine/setup/presets.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/flipped_faces.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/metrics/vertex_normals.h"
#include "samples/meshes/meshes.h"
#include "tests/support/denoising.h"
#include "tests/support/flows.h"
#include "tests/support/preset_choices.h"
#include "tests/support/random_meshes.h"
#include "tests/support/relative.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

struct NoisySphere {
    PolygonMesh truth;
    PolygonMesh noisy;
};

NoisySphere bumpy_sphere(double noise, Index vertices = 4000)
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
    mesh.vertices = test::moved_by(options_for(preset, mesh), mesh);
    return mesh;
}

PolygonMesh from(const std::vector<Point>& points, const std::vector<std::vector<Index>>& faces)
{
    PolygonMesh mesh;
    mesh.vertices.resize(std::ssize(points), 3);
    for (std::size_t v = 0; v < points.size(); ++v)
        mesh.vertices.row(static_cast<Eigen::Index>(v)) = points[v];
    for (const std::vector<Index>& face : faces)
        mesh.add_face(face);
    return mesh;
}

/// A box of 12 triangles.
PolygonMesh plain_box(double width, double depth, double height)
{
    std::vector<Point> points;
    for (int v = 0; v < 8; ++v)
        points.emplace_back(width * (v % 2), depth * (v / 2 % 2), height * (v / 4));
    return from(points, {{0, 2, 3},
                         {0, 3, 1},
                         {4, 5, 7},
                         {4, 7, 6},
                         {0, 1, 5},
                         {0, 5, 4},
                         {2, 6, 7},
                         {2, 7, 3},
                         {0, 4, 6},
                         {0, 6, 2},
                         {1, 3, 7},
                         {1, 7, 5}});
}

/// Quads between circles of latitude, triangles at the poles.
PolygonMesh globe(Index meridians, Index parallels)
{
    std::vector<Point> points{Point(0, 0, 1)};
    std::vector<std::vector<Index>> faces;
    const auto vertex = [&](Index i, Index k) { return 1 + (i - 1) * meridians + k % meridians; };
    for (Index i = 1; i < parallels; ++i)
        for (Index k = 0; k < meridians; ++k) {
            const double polar = std::numbers::pi * i / parallels;
            const double azimuth = 2.0 * std::numbers::pi * k / meridians;
            points.emplace_back(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                                std::cos(polar));
        }
    const auto south = static_cast<Index>(points.size());
    points.emplace_back(0, 0, -1);
    for (Index k = 0; k < meridians; ++k) {
        faces.push_back({0, vertex(1, k), vertex(1, k + 1)});
        for (Index i = 1; i + 1 < parallels; ++i)
            faces.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
        faces.push_back({south, vertex(parallels - 1, k + 1), vertex(parallels - 1, k)});
    }
    return from(points, faces);
}

/// Parts without noise: few faces, many, all alike, slivers, polygons, sheets thinner than their edges, tips and poles.
std::vector<PolygonMesh> clean_parts()
{
    std::vector<PolygonMesh> parts{plain_box(1, 1, 1), plain_box(10, 10, 1), plain_box(10, 7, 1e-3),
                                   plain_box(1, 1, 50)};
    // Of a pyramid, and of an octahedron.
    const std::vector<Point> tips{Point(1, 0, 0),  Point(0, 1, 0), Point(-1, 0, 0),
                                  Point(0, -1, 0), Point(0, 0, 1), Point(0, 0, -1)};
    const std::vector<std::vector<Index>> upper{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    parts.push_back(from({tips.begin(), tips.end() - 1}, upper));
    parts.back().add_face(std::vector<Index>{0, 3, 2, 1});
    parts.push_back(from(tips, upper));
    for (const Index k : {0, 1, 2, 3})
        parts.back().add_face(std::vector<Index>{(k + 1) % 4, k, 5});
    // A box with two vertices at a corner, apart by the rounding of cos 90°: two faces have no normal that means
    // anything.
    PolygonMesh needle = plain_box(1, 1, 1);
    needle.vertices.col(0).array() -= 1.0;
    needle.vertices.conservativeResize(9, 3);
    needle.vertices.row(8) = needle.vertices.row(7);
    needle.vertices(7, 0) = 6.1e-17;
    needle.vertices(8, 0) = 1.2e-16;
    for (const Index corner : {10, 20, 22})
        needle.face_vertices[corner] = 8;
    needle.add_face(std::vector<Index>{4, 7, 8});
    needle.add_face(std::vector<Index>{7, 3, 8});
    parts.push_back(needle);
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
        const NoisySphere c = bumpy_sphere(noise);
        const PolygonMesh result = smoothed(c.noisy, Preset::Scan);
        const PolygonMesh taubin = taubin_smoothed(c.noisy, 10);
        CHECK(distance(c.truth, result.vertices) < distance(c.truth, taubin.vertices));
        // Of a little noise, the amount that is best for positions leaves a little more in the normals.
        CHECK(angle_to_truth(c.truth, result) < (noise < 0.1 ? 1.04 : 1.0) * angle_to_truth(c.truth, taubin));
        CHECK(distance(c.truth, result.vertices) < 0.5 * distance(c.truth, c.noisy.vertices));
    }
}

TEST_CASE("what has no noise is not smoothed by the preset that goes by it, and one sentence says so")
{
    for (const PolygonMesh& mesh : clean_parts()) {
        CAPTURE(mesh.n_vertices());
        const PresetChoice choice = options_for(Preset::Scan, mesh);
        CHECK(choice.noise == 0.0);
        CHECK(choice.options.steps == 0);
        CHECK(choice.remark.value().kind == "nothing smoothed");
        CHECK(sentence(*choice.remark).find("nothing is smoothed") != std::string::npos);
        CHECK(sentence(*choice.remark).find("Use radius to") != std::string::npos);
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
        const auto check_moved = [&](const Points& moved) {
            CHECK((moved - mesh.vertices).rowwise().norm().maxCoeff() <= 1e-6 * box_of_faces(mesh).diagonal());
            CHECK(folded_faces(mesh, mesh.vertices, moved, flipped_faces(mesh, mesh.vertices, moved)).empty());
        };
        check_moved(test::moved_by(options_for(Preset::Cad, mesh), mesh));
        for (const double edges : {1e-12, 1.0, 1000.0}) {
            AllOptions options;
            options.keep_edges = 30.0;
            options.time_step = edges * edge * edge;
            check_moved(flowed(mesh, options));
        }
    }
}

TEST_CASE("a clean globe keeps its poles and its faces where edges are kept")
{
    for (const PolygonMesh& mesh : {globe(48, 24), globe(24, 12), globe(64, 16)}) {
        CAPTURE(mesh.n_vertices());
        const double edge = mean_edge_length(mesh, mesh.vertices);
        CHECK(same_bits(test::moved_by(options_for(Preset::Cad, mesh), mesh), mesh.vertices));
        for (const double edges : {1e-12, 1.0, 1000.0}) {
            AllOptions options;
            options.keep_edges = 30.0;
            options.time_step = edges * edge * edge;
            CHECK(flipped_faces(mesh, mesh.vertices, flowed(mesh, options)).empty());
        }
    }
}

TEST_CASE("the cad preset takes the noise of each place as its amount, also with edges and with known noise")
{
    const PolygonMesh mesh = make_box(400);
    FlowOptions with_edge;
    with_edge.motion.feature_edges = {{mesh.face_vertices[0], mesh.face_vertices[1]}};
    CHECK(options_for(Preset::Cad, mesh, with_edge).denoise);
    CHECK(options_for(Preset::Cad, mesh, {}, LengthOnMesh{0.01, true}).denoise);
    CHECK(!options_for(Preset::Terrain, mesh, {}, LengthOnMesh{0.01, true}).denoise);
}

TEST_CASE("noise that is said is believed, and no more is taken than it")
{
    const NoisySphere c = bumpy_sphere(0.1);
    const double edge = mean_edge_length(c.truth, c.truth.vertices);
    const double known = 0.1 * edge / std::sqrt(3.0);
    const PresetChoice choice = options_for(Preset::Scan, c.noisy, {}, LengthOnMesh{known, false});
    CHECK(choice.noise == known);
    CHECK(choice.options.motion.limits.move == known);
    CHECK(choice.options.motion.limits.slide == 4.0 * known);
    const PresetChoice by_diagonal =
        options_for(Preset::Scan, c.noisy, {}, LengthOnMesh{known / box_of_faces(c.noisy).diagonal(), true});
    CHECK(std::abs(by_diagonal.options.time_step / choice.options.time_step - 1.0) < 0.01);
    PolygonMesh result = c.noisy;
    mean_curvature_flow(result, choice.options);
    CHECK(distance(c.noisy, result.vertices) <= known * 1.001);
    // More noise asks for more.
    const PresetChoice more = options_for(Preset::Scan, c.noisy, {}, LengthOnMesh{2.0 * known, false});
    CHECK(more.options.time_step > choice.options.time_step);
}

TEST_CASE("one vertex that stands for missing data does not keep a filter from removing noise, measured or known")
{
    const PolygonMesh truth = test::triangle_grid(45, 45);
    const double edge = mean_edge_length(truth);
    const PolygonMesh plain = test::with_gaussian_noise(truth, 0.15, 1);
    const double known = 0.15 * edge / std::sqrt(3.0);
    for (const double height : {30.0, 1e4, 1e7}) {
        PolygonMesh outlier = plain;
        const Index spike = 1000;
        outlier.vertices(spike, 2) -= height * edge;
        CAPTURE(height);
        for (const auto& noise : {std::optional<LengthOnMesh>(), std::optional(LengthOnMesh{known, false})}) {
            const PresetChoice own = options_for(Preset::Scan, plain, {}, noise);
            const PresetChoice choice = options_for(Preset::Scan, outlier, {}, noise);
            CHECK_FALSE(choice.remark);
            CHECK(std::abs(choice.options.time_step / own.options.time_step - 1.0) < 0.1);
            PolygonMesh result = outlier;
            mean_curvature_flow(result, choice.options);
            CHECK(result.vertices(spike, 2) == outlier.vertices(spike, 2));
            result.vertices.row(spike) = plain.vertices.row(spike);
            PolygonMesh expected = plain;
            mean_curvature_flow(expected, own.options);
            CHECK(angle_to_truth(truth, result) < 1.2 * angle_to_truth(truth, expected));
        }
    }
}

TEST_CASE("known noise that cannot be removed is not said to be unknown")
{
    const PolygonMesh sphere = make_noisy_sphere(500);
    const PresetChoice choice = options_for(Preset::Scan, sphere, {}, LengthOnMesh{1e3, false});
    CHECK(choice.options.steps == 0);
    CHECK(sentence(choice.remark.value()).starts_with("With noise of 1e+03, no amount is expected"));
}

TEST_CASE("an unused vertex changes no preset, however far it is")
{
    const NoisySphere c = bumpy_sphere(0.1);
    PolygonMesh more = c.noisy;
    more.vertices.conservativeResize(c.noisy.n_vertices() + 1, 3);
    more.vertices.bottomRows(1).setConstant(1e6);
    for (const Preset preset : {Preset::Automatic, Preset::Scan, Preset::Cad, Preset::Terrain, Preset::Fair}) {
        CAPTURE(static_cast<int>(preset));
        CHECK(smoothed(more, preset).vertices.topRows(c.noisy.n_vertices()) == smoothed(c.noisy, preset).vertices);
    }
}

TEST_CASE("the amount is that of the radius, whatever filter and operator the options have")
{
    const NoisySphere c = bumpy_sphere(0.2);
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

TEST_CASE("presets have names, and all of them work on a scan")
{
    CHECK(all_presets().front().name == "automatic");
    CHECK_THROWS_WITH_AS(preset_of("best"), doctest::Contains("there is no preset \"best\""), OptionError);
    const NoisySphere c = bumpy_sphere(0.2, 2000);
    for (const PresetTraits& preset : all_presets()) {
        CAPTURE(preset.name);
        CHECK(preset_of(preset.name).preset == preset.preset);
        const PresetChoice choice = options_for(preset.preset, c.noisy, {}, {}, run_in_parallel);
        CHECK(choice.noise.has_value() == (preset.measures_noise() && !preset.denoise));
        CHECK_FALSE(choice.remark);
        CHECK(choice.options.time_step == options_for(preset.preset, c.noisy).options.time_step);
        if (preset.measures_noise() || preset.denoise)
            CHECK(distance(c.truth, test::moved_by(choice, c.noisy)) < distance(c.truth, c.noisy.vertices));
    }
    PolygonMesh point = c.noisy;
    point.vertices.setZero();
    CHECK_THROWS_WITH_AS(options_for(Preset::Fair, point), doctest::Contains("has no size"), InputError);
}

TEST_CASE("options that a caller asks for replace those of a preset")
{
    const NoisySphere c = bumpy_sphere(0.2, 2000);
    const FlowOptions own = options_for(Preset::Scan, c.noisy).options;
    FlowOptions further;
    further.laplacian = Laplacian::AlexaWardetzky;
    CHECK(options_for(Preset::Scan, c.noisy, further).options.laplacian == Laplacian::AlexaWardetzky);
    CHECK(options_for(Preset::Scan, c.noisy, further).options.order == own.order);
    further.filter = Filter::LowPass;
    CHECK_FALSE(options_for(Preset::Scan, c.noisy, further).options.order);
    // Δ_P has no such flows.
    FlowOptions unsymmetric;
    unsymmetric.laplacian = Laplacian::PtackovaVelho;
    const PresetSettings fair = apply_preset(preset_of("fair"), unsymmetric, changed_options(unsymmetric));
    CHECK(fair.options.flow == FlowEquation::MeanCurvature);
    REQUIRE(fair.left_out.size() == 1);
    CHECK(fair.left_out.front().option == "flow");
    // An amount, or an option of equations, asks for the equation of a preset that removes noise otherwise.
    FlowOptions with_amount;
    with_amount.radius = {0.02, true};
    const PresetChoice terrain = options_for(Preset::Terrain, c.noisy, with_amount);
    CHECK_FALSE(terrain.denoise);
    CHECK(terrain.options.radius == with_amount.radius);
    CHECK(terrain.options.motion.attachment_radius == LengthOnMesh{0.05, true});
    const PresetChoice cad = options_for(Preset::Cad, c.noisy, with_amount);
    REQUIRE(cad.denoise);
    CHECK(std::get<SmoothBetweenEdges>(cad.denoise->method).amount.radius == with_amount.radius);
    FlowOptions in_parts;
    in_parts.cut.subdomains = 4;
    CHECK_FALSE(options_for(Preset::Automatic, c.noisy, in_parts).denoise);
    CHECK(default_preset(changed_options(in_parts)).name == "scan");
    CHECK(default_preset(changed_options({})).name == "automatic");
}
