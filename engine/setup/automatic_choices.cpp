#include "engine/setup/automatic_choices.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/options/option_table.h"
#include "engine/setup/moving_rim.h"
#include "solvers/laplacian/laplacian.h"
#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

const SubdomainNeeds& needs_of(Laplacian laplacian, bool converged)
{
    if (!is_symmetric(laplacian))
        return needs_of_unsymmetric_sweeps;
    return converged ? needs_of_converged_steps : needs_of_sweeps;
}

SubdomainChoice choose_subdomains(const MeshSize& size, double time_step, const SubdomainNeeds& needs)
{
    const double width = needs.width * std::sqrt(time_step);
    const double most_by_width = std::floor(size.area / (width * width));
    const double most_by_cost = std::floor(size.vertices / static_cast<double>(needs.vertices));
    SubdomainChoice choice;
    choice.count = static_cast<Index>(std::max(1.0, std::min(most_by_width, most_by_cost)));
    choice.reason = choice.count == 1 ? "One sub-mesh: " : fmt::format("Cut into {} sub-meshes: ", choice.count);
    if (most_by_width < most_by_cost)
        choice.reason +=
            fmt::format("more would be too narrow for so much smoothing (less than {:.0f} √dt)", needs.width);
    else
        choice.reason += fmt::format("about {} vertices each are fastest", needs.vertices);
    return choice;
}

double width_in_diffusion_lengths(double area, Index k, double time_step)
{
    return std::sqrt(area / k / time_step);
}

namespace {

/// The tolerance that leaves a few hundredths of a mean edge length on most meshes. It took one to seven iterations
/// with Δ_F, up to 19 with Δ_A on a scan with slivers (measured: see engine/accuracy.md).
constexpr double loose_tolerance = 1e-2;
/// The tolerance of linear flows, whose steps cost little more than their iterations.
constexpr double tolerance_of_linear_flow = 1e-4;
/// The longest step of sweeps, in squared mean edge lengths: with longer steps, the error of a sweep approaches a mean
/// edge length.
constexpr double longest_step_of_sweeps = 16.0;
/// The tolerance of conjugate gradients, whose residual is that of all vertices. It leaves no larger error than sweeps,
/// and with long steps none larger than loosely converged sub-meshes, by the largest distance and by the mean distance
/// (measured: see engine/accuracy.md).
constexpr double tolerance_of_gradients = 3e-3;
constexpr double tolerance_of_gradients_if_long = 1e-4;

/// The number of iterations may exceed the predicted number by this factor.
constexpr double safety_of_prediction = 2.0;

bool is_long(const FlowOptions& options, const MeshSize& size)
{
    return options.time_step > longest_step_of_sweeps * size.mean_edge * size.mean_edge;
}

double tolerance_by_gradients(const FlowOptions& options, const MeshSize& size)
{
    return is_long(options, size) ? tolerance_of_gradients_if_long : tolerance_of_gradients;
}

/// Whether an option is set that has no meaning without sub-meshes.
bool speaks_of_sub_meshes(const FlowOptions& options)
{
    return !first_set(options, concern::sub_meshes | concern::sweeps | concern::factors).empty();
}

/// Whether an option is set that has no meaning for converged steps.
bool speaks_of_sweeps(const FlowOptions& options)
{
    return options.accuracy.approach == Approach::Sweep ||
           !first_set(options, concern::sweeps | concern::method).empty() ||
           is_foreign(options.resources.factorisation);
}

bool may_be_cut(const FlowOptions& options)
{
    return options.cut.subdomains != 1 || !options.cut.labels.empty();
}

/// Whether sweeps would have at most two sub-meshes.
bool has_few_sub_meshes(const MeshSize& size, const FlowOptions& options)
{
    if (!options.cut.labels.empty())
        return false;
    return options.cut.subdomains > 0 ? options.cut.subdomains <= 2 : size.vertices < 3 * needs_of_sweeps.vertices;
}

/// Whether a face has at least a tenth of the vertices of a sub-mesh. With a Laplacian that reaches two rings, all
/// vertices of such a face are coupled with each other.
bool has_long_faces(const PolygonMesh& mesh)
{
    const Index most = needs_of_unsymmetric_sweeps.vertices / 10;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (mesh.face_offsets[f + 1] - mesh.face_offsets[f] >= most)
            return true;
    return false;
}

/// Whether the rows couple all corners of a face, and the faces with so many corners that factorisations give them
/// auxiliary unknowns would have more than 16 entries of the rows for each corner of the mesh.
bool has_dense_rows(const PolygonMesh& mesh, Laplacian laplacian)
{
    constexpr double most_entries_by_corners = 16.0;
    double n_entries = 0.0;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (const std::size_t n = mesh.face(f).size(); n > most_corners_without_auxiliary)
            n_entries += static_cast<double>(n) * static_cast<double>(n);
    return traits_of(laplacian).reach == Reach::Faces && n_entries > most_entries_by_corners * mesh.n_corners();
}

}  // namespace

ToleranceChoice choose_tolerance(const PolygonMesh& mesh, const MeshSize& size, const FlowOptions& options,
                                 bool rim_moves)
{
    if (options.accuracy.tolerance)
        return {options.accuracy.tolerance, ""};
    if (options.flow == FlowEquation::Linear && options.accuracy.approach != Approach::Undecomposed)
        return {tolerance_of_linear_flow, "its matrix is factorised once"};
    if (options.accuracy.approach == Approach::ConjugateGradients)
        return {tolerance_by_gradients(options, size), ""};
    if (options.accuracy.approach == Approach::Converged)
        return {loose_tolerance, ""};
    if (options.accuracy.approach == Approach::Undecomposed)
        return {};
    if (!options.motion.strength.empty() && options.scheme == Scheme::BackwardEuler && mesh.n_faces() > 0)
        return {loose_tolerance, "in a region steps differ from vertex to vertex, which single sweeps do not support"};
    if (rim_moves && !speaks_of_sweeps(options) && may_be_cut(options))
        return {loose_tolerance, options.motion.boundary == Boundary::Free
                                     ? "sub-meshes that share a free boundary need it"
                                     : "sub-meshes that share lines where sheets meet need it"};
    if (speaks_of_sweeps(options) || mesh.n_faces() == 0)
        return {};
    if (traits_of(options.laplacian).reach == Reach::TwoRings && has_long_faces(mesh) && options.cut.subdomains != 1)
        return {loose_tolerance, "faces of so many sides reach from one sub-mesh into others"};
    if (!is_symmetric(options.laplacian) || has_few_sub_meshes(size, options))
        return {};
    if (options.accuracy.approach == Approach::Automatic && !is_plain_flow(options) && !speaks_of_sub_meshes(options))
        return {loose_tolerance, "single sweeps would be less accurate"};
    if (is_long(options, size))
        return {loose_tolerance, "steps as long as these would drift in single sweeps"};
    if (options.cut.subdomains > 0 &&
        width_in_diffusion_lengths(size.area, options.cut.subdomains, options.time_step) < needs_of_sweeps.width)
        return {loose_tolerance, "in sub-meshes as narrow as these, single sweeps would drift"};
    if (traits_of(options.laplacian).reach == Reach::Faces && mesh.n_corners() != 3 * mesh.n_faces())
        return {loose_tolerance, "on polygons it costs no more than single sweeps"};
    return {};
}

std::string_view need_of_junctions(const FlowOptions& options)
{
    if (options.motion.junctions == Junctions::Hold)
        return {};
    if (!is_symmetric(options.laplacian))
        return "With a symmetric Laplacian";
    // Vertices at junctions have no normal.
    if (options.motion.direction.kind == MotionDirection::Kind::Normal)
        return "In any direction but normals";
    const bool is_whole = options.scheme != Scheme::BackwardEuler || takes_whole_mesh(options.accuracy.approach);
    const bool converges = options.accuracy.tolerance || options.accuracy.approach == Approach::Converged ||
                           options.flow == FlowEquation::Linear;
    return !is_whole && !converges && may_be_cut(options) && speaks_of_sweeps(options) ? "In converged steps" : "";
}

namespace {

/// The choice of steps in sub-meshes.
/// @param otherwise the reason, if the choice has none.
ApproachChoice in_sub_meshes(const ToleranceChoice& choice, std::string_view otherwise = {})
{
    const std::string_view why = choice.reason.empty() ? otherwise : choice.reason;
    ApproachChoice taken{.approach = choice.tolerance ? Approach::Converged : Approach::Sweep,
                         .tolerance = choice.tolerance};
    if (!why.empty())
        taken.reason = fmt::format("Sub-meshes are solved {}: {}.",
                                   choice.tolerance ? "until they agree" : "in single sweeps", why);
    return taken;
}

std::string reason_for(const PredictedCost& cost)
{
    switch (cost.approach) {
    case Approach::ConjugateGradients:
        return fmt::format("The whole mesh is solved at once by conjugate gradients, to {:g} of the residual: that is "
                           "fastest for steps as short and few as these.",
                           *cost.tolerance);
    case Approach::Undecomposed:
        return "The whole mesh is solved at once by one factorisation: that is fastest for a mesh of this size.";
    default:
        return {};
    }
}

}  // namespace

ApproachChoice choose_approach(const PolygonMesh& mesh, const Topology& topology, const MeshSize& size,
                               const FlowOptions& options, std::optional<Approach> earlier, Sharing sharing)
{
    const ToleranceChoice tolerance = choose_tolerance(mesh, size, options, !moving_rim(mesh, topology).empty());
    const Approach asked = options.accuracy.approach;
    if (takes_whole_mesh(asked))
        return {.approach = asked, .tolerance = tolerance.tolerance};
    if (tolerance.tolerance && !is_symmetric(options.laplacian) && mesh.n_faces() > 0)
        return {.approach = Approach::Undecomposed,
                .reason = "The whole mesh is solved at once by one factorisation" +
                          (tolerance.reason.empty() ? std::string() : ": " + tolerance.reason) +
                          ". Steps of Laplacians without symmetry converge in no other way."};
    if (asked != Approach::Automatic || speaks_of_sub_meshes(options) || !is_symmetric(options.laplacian) ||
        options.scheme != Scheme::BackwardEuler || mesh.n_faces() == 0)
        return in_sub_meshes(tolerance);
    if (sharing == Sharing::Ranks && !(earlier && takes_whole_mesh(*earlier)))
        return in_sub_meshes(tolerance, "ranks can share such steps");
    const FlowSize flow{.vertices = size.vertices,
                        .rows = average_rows(mesh, topology, laplacian_of(options)),
                        .time_step = options.time_step,
                        .steps = options.steps,
                        .solutions = n_solutions(filter_of(options)),
                        .cores = options.resources.tune_for};
    const ApproachChoice decomposed = in_sub_meshes(tolerance);
    ApproachChoice choice{.size = flow};
    choice.costs = {predict_cost(Approach::Undecomposed, flow, options.accuracy.tolerance)};
    // On Γ between sub-meshes that share such a face are all corners of the face, and the Schur complement has all
    // pairs of these.
    const bool is_dense = has_dense_rows(mesh, options.laplacian);
    const double to_reach = options.accuracy.tolerance.value_or(tolerance_by_gradients(options, size));
    if (options.flow == FlowEquation::MeanCurvature && !attaches(options.motion) && !is_dense &&
        safety_of_prediction * predicted_iterations(flow, to_reach) <= options.accuracy.converge_iterations)
        choice.costs.push_back(predict_cost(Approach::ConjugateGradients, flow, to_reach));
    const SubdomainNeeds& needs = needs_of(options.laplacian, decomposed.tolerance.has_value());
    if ((choose_subdomains(size, options.time_step, needs).count > 1 && !is_dense) || earlier == decomposed.approach)
        choice.costs.push_back(predict_cost(decomposed.approach, flow, decomposed.tolerance));
    std::ranges::stable_sort(choice.costs, {}, [&](const PredictedCost& cost) { return cost.of(options.steps); });
    const auto stays = std::ranges::find(choice.costs, earlier, &PredictedCost::approach);
    const PredictedCost& taken = stays != choice.costs.end() ? *stays : choice.costs.front();
    choice.approach = taken.approach;
    choice.tolerance = taken.tolerance;
    choice.reason = takes_whole_mesh(taken.approach) ? reason_for(taken) : decomposed.reason;
    return choice;
}

std::optional<ApproachChoice> choose_without_factors(const MeshSize& size, const FlowOptions& options)
{
    if (options.accuracy.approach != Approach::Automatic || speaks_of_sub_meshes(options) ||
        !is_symmetric(options.laplacian) || options.flow == FlowEquation::Conformalized)
        return {};
    const double tolerance = options.accuracy.tolerance.value_or(tolerance_by_gradients(options, size));
    return ApproachChoice{
        .approach = Approach::ConjugateGradients,
        .tolerance = tolerance,
        .reason = fmt::format("The whole mesh is solved at once by conjugate gradients, to {:g} of the residual: they "
                              "factorise nothing, and factorisations would exceed the memory limit.",
                              tolerance)};
}

}  // namespace seamflow
