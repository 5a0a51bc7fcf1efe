#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/tasks/parallel_loop.h"
#include "partition/metrics/displacement.h"
#include "partition/metrics/noise.h"
#include "samples/common/meshes.h"
#include "samples/common/noise_removal.h"
#include "samples/common/smoothing_request.h"
#include "tests/support/denoising.h"
#include "tests/support/flows.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// The median of the absolute values of normally distributed numbers of deviation 1.
constexpr double normal_median = 0.6745;

double noise_of(const PolygonMesh& mesh)
{
    return estimate_noise(mesh, make_topology(mesh), run_in_parallel);
}

/// What --preset scan takes before it looks at details.
FlowOptions scan_options(const PolygonMesh& mesh, double noise)
{
    const double edge = mean_edge_length(mesh, mesh.vertices);
    FlowOptions options;
    options.laplacian = Laplacian::VirtualRefinement;
    options.filter = Filter::LowPass;
    options.steps = 3;
    options.time_step = edge * edge * time_step_edges_for_noise(noise / edge, 0.5, true, options.steps);
    return options;
}

/// A sphere with bumps a few edges wide.
PolygonMesh detailed_sphere(Index vertices, int waves)
{
    return make_noisy_sphere(vertices, {.amplitude = 0.02, .waves = waves, .noise = 0.0});
}

/// The median length of the moves along the normals.
double median_move(const PolygonMesh& mesh, const Points& after)
{
    std::vector<double> moves = displacement_field(mesh, mesh.vertices, after).normal;
    for (double& move : moves)
        move = std::abs(move);
    std::ranges::nth_element(moves, moves.begin() + static_cast<std::ptrdiff_t>(moves.size() / 2));
    return moves[moves.size() / 2];
}

}  // namespace

TEST_CASE("noise on a smooth surface is removed at once, and what is left is nearer to the surface than by Taubin")
{
    for (const double deviation : {0.05, 0.1})
        for (const double amplitude : {0.0, 0.1}) {
            CAPTURE(deviation);
            CAPTURE(amplitude);
            const PolygonMesh truth = make_noisy_sphere(8000, {.amplitude = amplitude, .noise = 0.0});
            const PolygonMesh noisy = with_gaussian_noise(truth, deviation, 1);
            const double noise = noise_of(noisy);
            const FlowOptions options = scan_options(noisy, noise);
            CHECK(time_step_within_noise(noisy, noise, options, run_in_parallel) == options.time_step);
            PolygonMesh result = noisy;
            mean_curvature_flow(result, options);
            // As many passes as leave no more noise.
            PolygonMesh taubin = taubin_smoothed(noisy, 1);
            while (noise_of(taubin) > noise_of(result))
                taubin = taubin_smoothed(taubin, 1);
            const Denoised left = compare_with_truth(truth, result);
            const Denoised left_by_taubin = compare_with_truth(truth, taubin);
            CHECK(left.distance < 0.95 * left_by_taubin.distance);
            CHECK(std::abs(left.volume) < 0.5 * std::abs(left_by_taubin.volume));
        }
}

TEST_CASE("where details look like noise, no more is taken off than that, on large meshes as well, which are tried in "
          "patches")
{
    for (const Index n : {8000, 110'000}) {
        CAPTURE(n);
        const PolygonMesh mesh = detailed_sphere(n, n > 100'000 ? 80 : 20);
        const double noise = noise_of(mesh);
        FlowOptions options = scan_options(mesh, noise);
        CHECK(median_move(mesh, flowed(mesh, options)) > 1.4 * normal_median * noise);
        options.time_step = time_step_within_noise(mesh, noise, options, run_in_parallel);
        const double moved = median_move(mesh, flowed(mesh, options));
        CHECK(moved < 1.2 * normal_median * noise);
        CHECK(moved > 0.6 * normal_median * noise);
    }
}

TEST_CASE("without noise, and where no flow can be taken, the time step stays")
{
    const PolygonMesh mesh = detailed_sphere(2000, 20);
    const double noise = noise_of(mesh);
    FlowOptions options = scan_options(mesh, noise);
    CHECK(time_step_within_noise(mesh, 0.1 * noise, options) < options.time_step);
    CHECK(time_step_within_noise(mesh, 0.0, options) == options.time_step);
    options.motion.fixed_vertices = {mesh.n_vertices()};
    CHECK(time_step_within_noise(mesh, 0.1 * noise, options) == options.time_step);
    options.motion.fixed_vertices.clear();
    options.steps = 0;
    CHECK(time_step_within_noise(mesh, 0.1 * noise, options) == options.time_step);
}
