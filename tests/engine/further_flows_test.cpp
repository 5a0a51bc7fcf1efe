#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/vector_area.h"
#include "samples/meshes/meshes.h"
#include "solvers/laplacian/geometry.h"
#include "tests/support/flows.h"
#include "tests/support/matrices.h"
#include "tests/support/reference_data.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// One of the flows beyond the paper's.
struct FurtherFlow {
    std::string name;
    FlowOptions options;
};

/// For meshes in the unit square.
std::vector<FurtherFlow> further_flows(Laplacian laplacian)
{
    FlowOptions plain;
    plain.laplacian = laplacian;
    plain.time_step = 0.002;
    plain.steps = 3;
    plain.cut.subdomains = 6;
    std::vector<FurtherFlow> flows;
    const auto add = [&](const std::string& name, auto change) {
        flows.push_back({std::string(name_of(laplacian)) + " " + name, plain});
        change(flows.back().options);
    };
    add("conformalized", [](FlowOptions& o) { o.flow = FlowEquation::Conformalized; });
    add("attached", [](FlowOptions& o) { o.motion.attachment = 150.0; });
    add("conformalized and attached",
        [](FlowOptions& o) { o.flow = FlowEquation::Conformalized, o.motion.attachment = 150.0; });
    add("low-pass", [](FlowOptions& o) { o.filter = Filter::LowPass; });
    add("low-pass, conformalized and attached", [](FlowOptions& o) {
        o.filter = Filter::LowPass, o.flow = FlowEquation::Conformalized, o.motion.attachment = 150.0;
    });
    add("linear", [](FlowOptions& o) { o.flow = FlowEquation::Linear; });
    add("low-pass, linear and attached",
        [](FlowOptions& o) { o.filter = Filter::LowPass, o.flow = FlowEquation::Linear, o.motion.attachment = 150.0; });
    return flows;
}

std::vector<FurtherFlow> all_further_flows()
{
    std::vector<FurtherFlow> all;
    for (const Laplacian laplacian : symmetric_laplacians)
        for (FurtherFlow& flow : further_flows(laplacian)) {
            if (flow.options.flow != FlowEquation::Linear) {
                all.push_back(flow);
                all.back().name += ", by sweeps";
                all.back().options.accuracy.approach = Approach::Sweep;
            }
            flow.name += ", converged";
            flow.options.accuracy.tolerance = 1e-11;
            all.push_back(std::move(flow));
        }
    return all;
}

double mean_distance(const Points& a, const Points& b)
{
    return (a - b).rowwise().norm().mean();
}

/// The least distance from the axis, by the length along it.
double neck_of(const Points& dumbbell)
{
    const double half_length = dumbbell.col(2).cwiseAbs().maxCoeff();
    double neck = half_length;
    for (const auto row : dumbbell.rowwise())
        if (std::abs(row.z()) < 0.2 * half_length)
            neck = std::min(neck, std::hypot(row.x(), row.y()));
    return neck / half_length;
}

FlowOptions undecomposed(FlowOptions options)
{
    options.cut.subdomains = 0;
    options.accuracy.tolerance.reset();
    options.accuracy.approach = Approach::Undecomposed;
    return options;
}

/// @returns how many there are.
int check_against_references(Index subdomains, std::optional<double> tolerance)
{
    int n = 0;
    for (const auto& file : reference_files("beyond")) {
        ReferenceFlow reference = read_further_flow(file);
        CAPTURE(file.filename().string());
        CAPTURE(subdomains);
        reference.options.cut.subdomains = subdomains;
        reference.options.accuracy.tolerance = tolerance;
        const double unit = tolerance ? 1e-6 * mean_edge_length(reference.mesh, reference.mesh.vertices) : 1e-9;
        mean_curvature_flow(reference.mesh, reference.options, [&](const StepState& state) {
            CAPTURE(state.step);
            CHECK(largest_difference(state.positions, reference.positions_after_step.at(usize(state.step - 1))) <=
                  unit);
            ++n;
        });
    }
    return n;
}

}  // namespace

TEST_CASE("flows beyond the paper's are those of the reference, undecomposed and converged in sub-meshes")
{
    const int n = check_against_references(1, {});
    CHECK(n == 108);
    for (const Index subdomains : {8, 64})
        CHECK(check_against_references(subdomains, 1e-10) == n);
}

TEST_CASE("with more sub-meshes further flows are the same converged, and near by sweeps")
{
    for (const PolygonMesh& mesh : height_fields())
        for (const FurtherFlow& flow : all_further_flows()) {
            CAPTURE(flow.name);
            const double edge = mean_edge_length(mesh, mesh.vertices);
            const Points expected = flowed(mesh, undecomposed(flow.options));
            FlowOptions plain = undecomposed(flow.options);
            plain.flow = FlowEquation::MeanCurvature;
            plain.filter = Filter::Diffusion;
            plain.motion.attachment = 0.0;
            const Points result = flowed(mesh, flow.options);
            if (flow.options.accuracy.tolerance)
                CHECK(largest_difference(result, expected) <= 1e-7 * edge);
            else
                CHECK(mean_distance(result, expected) <= 0.25 * mean_distance(mesh.vertices, flowed(mesh, plain)));
        }
}

TEST_CASE("every step of the linear flow has the matrix of the first surface")
{
    for (const PolygonMesh& mesh : {make_mixed_polygons(300), make_noisy_sphere(300)})
        for (const Laplacian laplacian : symmetric_laplacians) {
            CAPTURE(name_of(laplacian));
            FlowOptions options;
            options.laplacian = laplacian;
            options.time_step = 0.01;
            options.steps = 4;
            options.flow = FlowEquation::Linear;
            options.uniform_edge = 1.0;
            const Topology topology = make_topology(mesh);
            const Index n = mesh.n_vertices();
            Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
            const Eigen::MatrixXd delta = dense_laplacian(laplacian, mesh, topology);
            for (Index v = 0; v < n; ++v)
                if (topology.moves(v))
                    matrix.row(v) += options.time_step * delta.row(v);
            const Eigen::PartialPivLU<Eigen::MatrixXd> factor(matrix);
            Points expected = mesh.vertices;
            std::vector<Points> after{expected};
            for (int step = 0; step < options.steps; ++step)
                after.emplace_back(expected = factor.solve(expected));
            for (const bool is_cut : {false, true}) {
                FlowOptions own = is_cut ? options : undecomposed(options);
                if (is_cut)
                    own.cut.subdomains = 7, own.accuracy.tolerance = 1e-12;
                own.report.reference = true;
                PolygonMesh flowing = mesh;
                const FlowReport report = mean_curvature_flow(flowing, own, [&](const StepState& state) {
                    CHECK(largest_difference(state.positions, after[usize(state.step)]) <= 1e-10);
                });
                CHECK(report.convergence.steps_short_of_tolerance == 0);
                for (const StepReport& step : report.steps)
                    CHECK(step.distance->max <= 1e-10);
            }
        }
}

TEST_CASE("an attached flow ends where (Δ + w) V = w V⁰, and vertices stay the nearer the larger their w is")
{
    PolygonMesh mesh = make_hexagons(400);
    const Topology topology = make_topology(mesh);
    FlowOptions options;
    options.laplacian = Laplacian::VirtualRefinement;
    options.time_step = 1e6;
    options.motion.attachment_weights.assign(usize(mesh.n_vertices()), 100.0);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        options.motion.attachment_weights[v] = mesh.vertices(v, 0) < 0.5 ? 1e9 : 100.0;
    const Points end = flowed(mesh, options);
    const Eigen::VectorXd distances = (end - mesh.vertices).rowwise().norm();
    const Eigen::MatrixXd laplacian = dense_laplacian(options.laplacian, mesh, topology);
    const Points curvature = laplacian * end;
    double most_of_free = 0.0;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        if (!topology.moves(v))
            continue;
        const double w = options.motion.attachment_weights[v];
        CHECK((curvature.row(v) + w * (end.row(v) - mesh.vertices.row(v))).norm() < 1e-4 * w * distances.maxCoeff());
        if (w > 1e6)
            CHECK(distances(v) < 1e-5);
        else
            most_of_free = std::max(most_of_free, distances(v));
    }
    CHECK(most_of_free > 1e-3);
}

TEST_CASE("w for each vertex is the same as one for all, where they are equal, and 0 is none")
{
    const PolygonMesh mesh = make_mixed_polygons(400);
    for (FurtherFlow& flow : all_further_flows()) {
        CAPTURE(flow.name);
        const Points expected = flowed(mesh, flow.options);
        MotionOptions& motion = flow.options.motion;
        motion.attachment_weights.assign(usize(mesh.n_vertices()), motion.attachment);
        motion.attachment = 0.0;
        CHECK(largest_difference(flowed(mesh, flow.options), expected) <= 1e-12);
    }
}

TEST_CASE("conformalized, the neck of a dumbbell grows beside its length")
{
    PolygonMesh mesh = make_noisy_sphere(600, {.amplitude = 0.0, .noise = 0.0});
    for (auto row : mesh.vertices.rowwise())
        row.head<2>() *= 0.25 + 0.75 * std::min(1.0, 4.0 * row.z() * row.z() / row.squaredNorm());
    const double neck = neck_of(mesh.vertices);
    for (const Laplacian laplacian : {Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement}) {
        CAPTURE(name_of(laplacian));
        FlowOptions options;
        options.laplacian = laplacian;
        options.time_step = 0.004;
        options.flow = FlowEquation::Conformalized;
        options.steps = 15;
        CHECK(neck_of(flowed(mesh, options)) > 1.1 * neck);
    }
}

TEST_CASE("a low-pass filter keeps (1 + 2λ) / (1 + λ)² of a mode where diffusion keeps 1 / (1 + λ)")
{
    // A cosine, whose ends are level, as the natural conditions of a free boundary have them.
    PolygonMesh mesh = quad_grid(60, 6);
    mesh.vertices /= 60.0;
    const double wave = 4.0 * std::numbers::pi;
    const double height = 1e-4;
    mesh.vertices.col(2) = height * (wave * mesh.vertices.col(0)).array().cos();
    FlowOptions options;
    options.laplacian = Laplacian::VirtualRefinement;
    options.time_step = 0.5 / (wave * wave);
    options.motion.boundary = Boundary::Free;
    const double lambda = options.time_step * wave * wave;
    const auto kept = [&] { return flowed(mesh, options).col(2).maxCoeff() / height; };
    CHECK(kept() == relative(1.0 / (1.0 + lambda), 0.02));
    options.filter = Filter::LowPass;
    CHECK(kept() == relative((1.0 + 2.0 * lambda) / ((1.0 + lambda) * (1.0 + lambda)), 0.02));
}

TEST_CASE("the residual of a low-pass step is the largest of its solutions': more of them leave no less")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    FlowOptions options;
    options.filter = Filter::LowPass;
    options.time_step = 0.01;
    options.cut.subdomains = 7;
    // So few that each solution leaves something else.
    options.accuracy.converge_iterations = 2;
    for (const Approach approach : {Approach::Converged, Approach::ConjugateGradients}) {
        options.accuracy.approach = approach;
        options.accuracy.tolerance = 1e-12;
        if (approach == Approach::ConjugateGradients)
            options.cut.subdomains = 0;
        std::vector<double> residuals;
        for (int order = 2; order <= 6; ++order) {
            options.order = order;
            PolygonMesh moved = mesh;
            residuals.push_back(mean_curvature_flow(moved, options).steps[0].residual.value());
        }
        CAPTURE(residuals.front());
        CAPTURE(residuals.back());
        CHECK(residuals.front() > 1e-6);
        CHECK(std::ranges::is_sorted(residuals));
    }
}

TEST_CASE("a low-pass filter loses a tenth of the volume that diffusion loses, at equal noise")
{
    const PolygonMesh round = make_noisy_sphere(4000, {.amplitude = 0.0, .noise = 0.0});
    const PolygonMesh noisy = make_noisy_sphere(4000, {.amplitude = 0.0, .noise = 0.3});
    const double edge = mean_edge_length(round, round.vertices);
    const auto volume = [&](const Points& points) {
        double sum = 0.0;
        for (Index f = 0; f < round.n_faces(); ++f)
            sum += vector_area(round.face(f), points).dot(centroid(round.face(f), points)) / 3.0;
        return std::abs(sum);
    };
    const auto noise_of = [](const Points& points) {
        const Eigen::ArrayXd radii = points.rowwise().norm();
        return std::sqrt((radii - radii.mean()).square().mean());
    };
    FlowOptions options;
    options.laplacian = Laplacian::VirtualRefinement;
    options.time_step = edge * edge;
    const Points diffused = flowed(noisy, options);
    options.filter = Filter::LowPass;
    // With the longest step that leaves no more noise.
    Points filtered;
    do {
        options.time_step *= 1.1;
        filtered = flowed(noisy, options);
    } while (noise_of(filtered) > noise_of(diffused));
    const double before = volume(noisy.vertices);
    CHECK(before - volume(filtered) < 0.1 * (before - volume(diffused)));
}
