#include "samples/common/noise_removal.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "partition/metrics/displacement.h"
#include "partition/topology.h"

namespace seamflow {

namespace {

/// Larger meshes are tried in patches.
constexpr Index most_vertices = 100'000;
constexpr Index n_patches = 64;
/// Of edges around the middle of a patch, whose boundary stays: with how many it is cut out, and within how many it is
/// measured.
constexpr int patch_rings = 14;
constexpr int measured_rings = 8;

constexpr int most_trials = 4;
/// A trial that comes so near is good.
constexpr double close = 1.1;
/// The time step is divided by the ratio of displacement and noise to this power: the one grows with less than the
/// other.
constexpr double steepness = 1.2;

/// The median of the absolute values of normally distributed numbers of deviation 1.
constexpr double median_of_normal = 0.6745;

/// A part of a mesh, with all its vertices.
struct Sample {
    PolygonMesh mesh;
    std::vector<Index> measured;
};

/// For each vertex, how many edges away the nearest middle of a patch is; -1 beyond patches.
std::vector<int> rings_around_middles(const PolygonMesh& mesh, const Topology& topology)
{
    std::vector<int> rings(at(mesh.n_vertices()), -1);
    std::vector<Index> front;
    for (Index i = 0; i < n_patches; ++i) {
        const auto f = static_cast<Index>((2 * std::int64_t{i} + 1) * mesh.n_faces() / (2 * n_patches));
        const Index v = mesh.face(f).front();
        if (std::exchange(rings[v], 0) < 0)
            front.push_back(v);
    }
    for (int ring = 1; ring <= patch_rings; ++ring) {
        std::vector<Index> next;
        for (const Index v : front)
            for (const Index corner : topology.corners_at(v))
                for (const Index w : mesh.face(topology.face_of[corner]))
                    if (rings[w] < 0) {
                        rings[w] = ring;
                        next.push_back(w);
                    }
        front = std::move(next);
    }
    return rings;
}

Sample take_sample(const PolygonMesh& mesh, const Loop& loop)
{
    const Topology topology = make_topology(mesh, loop);
    const bool is_whole = mesh.n_vertices() <= most_vertices;
    const std::vector<int> rings =
        is_whole ? std::vector<int>(at(mesh.n_vertices()), 0) : rings_around_middles(mesh, topology);
    Sample sample;
    sample.mesh.vertices = mesh.vertices;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (std::ranges::all_of(mesh.face(f), [&](Index v) { return rings[v] >= 0; }))
            sample.mesh.add_face(mesh.face(f));
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (rings[v] >= 0 && rings[v] <= measured_rings && topology.moves(v))
            sample.measured.push_back(v);
    return sample;
}

/// What of the options has to do with the result of a flow on a part of the mesh.
FlowOptions options_of_trial(const FlowOptions& options)
{
    FlowOptions trial;
    trial.laplacian = options.laplacian;
    trial.flow = options.flow;
    trial.filter = options.filter;
    trial.time_step = options.time_step;
    trial.steps = options.steps;
    trial.motion.fixed_vertices = options.motion.fixed_vertices;
    trial.motion.attachment = options.motion.attachment;
    trial.motion.attachment_weights = options.motion.attachment_weights;
    trial.resources.threads = options.resources.threads;
    trial.report.measures = false;
    return trial;
}

/// The deviation of normally distributed numbers of which displacements along the normals would have the same median;
/// empty if the flow fails.
std::optional<double> displacement_of(const Sample& sample, const FlowOptions& options)
{
    PolygonMesh moved = sample.mesh;
    try {
        mean_curvature_flow(moved, options);
    } catch (const ComputationError&) {
        return {};
    } catch (const InputError&) {
        return {};
    } catch (const OptionError&) {
        return {};
    }
    const DisplacementField field = displacement_field(sample.mesh, sample.mesh.vertices, moved.vertices);
    std::vector<double> lengths;
    for (const Index v : sample.measured)
        if (std::isfinite(field.normal[v]))
            lengths.push_back(std::abs(field.normal[v]));
    if (lengths.empty())
        return {};
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle / median_of_normal;
}

}  // namespace

double time_step_within_noise(const PolygonMesh& mesh, double noise, const FlowOptions& options, const Loop& loop)
{
    if (!(noise > 0.0) || options.steps < 1)
        return options.time_step;
    const Sample sample = take_sample(mesh, loop);
    FlowOptions trial = options_of_trial(options);
    for (int i = 0; i < most_trials; ++i) {
        const std::optional<double> displacement = displacement_of(sample, trial);
        if (!displacement)
            return options.time_step;
        if (*displacement <= close * noise)
            break;
        trial.time_step /= std::pow(*displacement / noise, steepness);
    }
    return trial.time_step;
}

}  // namespace seamflow
