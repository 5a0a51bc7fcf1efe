#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include <doctest/doctest.h>

#include "engine/denoise.h"
#include "engine/mean_curvature_flow.h"
#include "engine/setup/resolved_options.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// A length in both forms.
struct Forms {
    LengthOnMesh of_diagonal;
    LengthOnMesh in_units;
};

Forms forms_of(const PolygonMesh& mesh, double part)
{
    return {{part, true}, part * box_of_faces(mesh).diagonal()};
}

/// Strengths of 1 where x is above 0.
std::vector<double> half_of(const PolygonMesh& mesh)
{
    std::vector<double> strength;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        strength.push_back(mesh.vertices(v, 0) > 0.0 ? 1.0 : 0.0);
    return strength;
}

Points denoised(PolygonMesh mesh, const MotionOptions& motion)
{
    DenoiseOptions options;
    options.motion = motion;
    denoise(mesh, options);
    return mesh.vertices;
}

}  // namespace

TEST_CASE("a part of the diagonal is the same as that length, for every length and at both doors")
{
    const PolygonMesh mesh = make_noisy_sphere(800);
    using Set = std::function<void(MotionOptions&, const LengthOnMesh&)>;
    const auto strength = half_of(mesh);
    const Set within = [](MotionOptions& m, const LengthOnMesh& length) { m.within = length; };
    const Set attachment = [](MotionOptions& m, const LengthOnMesh& length) { m.attachment_radius = length; };
    const Set feather = [&](MotionOptions& m, const LengthOnMesh& length) {
        m.strength = strength, m.feather = length;
    };
    const auto flowed_with = [&](const Set& set, const LengthOnMesh& length) {
        FlowOptions options{.time_step_edges = 2.0};
        set(options.motion, length);
        return flowed(mesh, options);
    };
    const Points plain = flowed(mesh, FlowOptions{.time_step_edges = 2.0});
    for (const Set& set : {within, attachment, feather}) {
        const Forms forms = forms_of(mesh, 0.002);
        CHECK(same_bits(flowed_with(set, forms.of_diagonal), flowed_with(set, forms.in_units)));
        CHECK_FALSE(same_bits(flowed_with(set, forms.of_diagonal), plain));
    }
    for (const Set& set : {within, feather}) {
        const Forms forms = forms_of(mesh, 0.001);
        MotionOptions of_diagonal = DenoiseOptions::default_motion();
        MotionOptions in_units = of_diagonal;
        set(of_diagonal, forms.of_diagonal);
        set(in_units, forms.in_units);
        CHECK(same_bits(denoised(mesh, of_diagonal), denoised(mesh, in_units)));
        CHECK_FALSE(same_bits(denoised(mesh, of_diagonal), denoised(mesh, DenoiseOptions::default_motion())));
    }
}

TEST_CASE("borders are joined within a part of the diagonal")
{
    PolygonMesh mesh = make_noisy_sphere(300);
    // Its last face has corners of its own, a little outside.
    const Index n = mesh.n_vertices();
    const auto last = mesh.face(mesh.n_faces() - 1);
    const auto n_corners = static_cast<Index>(last.size());
    mesh.vertices.conservativeResize(n + n_corners, 3);
    for (Index k = 0; k < n_corners; ++k)
        mesh.vertices.row(n + k) = 1.0001 * mesh.vertices.row(last[usize(k)]);
    for (Index k = 0; k < n_corners; ++k)
        mesh.face_vertices[mesh.face_vertices.size() - usize(n_corners - k)] = n + k;
    const auto n_fixed = [&](const std::optional<LengthOnMesh>& weld) {
        PolygonMesh moved = mesh;
        return mean_curvature_flow(moved, {.time_step_edges = 1.0, .motion = {.weld = weld}}).mesh.fixed_vertices;
    };
    CHECK(n_fixed(std::nullopt) == 2 * n_corners);
    CHECK(n_fixed(LengthOnMesh{0.001, true}) == 0);
    CHECK(n_fixed(LengthOnMesh{0.000001, true}) == 2 * n_corners);
}

TEST_CASE("a time step in squared mean edge lengths is that time step")
{
    const PolygonMesh mesh = make_noisy_sphere(500);
    const double edge = mean_edge_length(mesh);
    CHECK(same_bits(flowed(mesh, FlowOptions{.time_step_edges = 3.0}),
                    flowed(mesh, FlowOptions{.time_step = 3.0 * edge * edge})));
    const auto between = [&](const SmoothingAmount& amount) {
        PolygonMesh moved = mesh;
        denoise(moved, {.method = SmoothBetweenEdges{.amount = amount}});
        return moved.vertices;
    };
    CHECK(same_bits(between({.time_step_edges = 3.0}), between({.time_step = 3.0 * edge * edge})));
}

TEST_CASE("options that are resolved stay as they are")
{
    const PolygonMesh mesh = make_noisy_sphere(500);
    FlowOptions options{.laplacian = Laplacian::Uniform, .time_step_edges = 2.0};
    options.motion.strength = half_of(mesh);
    options.motion.feather = {0.05, true};
    options.motion.attachment_radius = {0.1, true};
    const FlowOptions once = resolved(options, mesh);
    const FlowOptions twice = resolved(once, mesh);
    CHECK(once.time_step > 0.0);
    CHECK(twice.time_step == once.time_step);
    CHECK(twice.uniform_edge == once.uniform_edge);
    CHECK(once.motion.attachment > 0.0);
    CHECK(twice.motion.attachment == once.motion.attachment);
    CHECK(once.motion.strength != options.motion.strength);
    CHECK(twice.motion.strength == once.motion.strength);
}

TEST_CASE("a region less deep than its feather is long is remarked on, at both doors")
{
    const PolygonMesh mesh = make_noisy_sphere(500);
    const auto is_remarked = [](const RunReport& report) {
        return std::ranges::any_of(report.remarks, [](const Remark& one) { return one.kind == "shallow region"; });
    };
    for (const double part : {0.01, 0.9}) {
        FlowOptions options{.time_step_edges = 1.0};
        options.motion.strength = half_of(mesh);
        options.motion.feather = {part, true};
        PolygonMesh moved = mesh;
        CHECK(is_remarked(mean_curvature_flow(moved, options)) == (part > 0.5));
        moved = mesh;
        CHECK(is_remarked(denoise(moved, {.motion = options.motion})) == (part > 0.5));
    }
}
