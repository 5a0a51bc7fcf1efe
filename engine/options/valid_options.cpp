#include "engine/options/valid_options.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "partition/errors.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

template <class Value>
void require(bool holds, const char* field, Value value, const char* limits)
{
    if (holds)
        return;
    constexpr const char* text =
        std::is_same_v<Value, double> ? "{} is {:.17g}, but must be {}" : "{} is {}, but must be {}";
    throw OptionError(fmt::format(fmt::runtime(text), field, value, limits));
}

bool positive_and_finite(double value)
{
    return value > 0.0 && std::isfinite(value);
}

void require_valid_amount(const FlowOptions& options)
{
    if (!options.radius) {
        require(positive_and_finite(options.time_step), "time_step", options.time_step,
                "positive and finite (length²)");
        return;
    }
    require(positive_and_finite(options.radius->value), "radius", options.radius->value,
            "positive and finite (a length, or a part of the bounding box's diagonal)");
    if (options.time_step != 0.0)
        throw OptionError("time_step and radius both say how much is smoothed: leave one of them out");
}

void require_valid_schwarz(const FlowOptions& options)
{
    if (options.interface.sweep == Sweep::Alternating)
        throw OptionError("sweep is alternating, but with the Schwarz conditions sub-meshes overlap for one order of "
                          "solving only: leave the sweep fixed");
    if (options.interface.p)
        throw OptionError("p is given, but the Schwarz conditions have no Robin parameter");
}

void require_valid_copies(const FlowOptions& options)
{
    if (is_classical(options.interface.conditions) && options.interface.correction == Correction::Centroid)
        throw OptionError(
            "correction is centroid, but with the classical conditions every sub-mesh has an interface of "
            "its own: leave it uncorrected");
    if (!options.report.keep_gaps)
        return;
    if (!is_classical(options.interface.conditions))
        throw OptionError(
            "keep_gaps is for the classical Robin and Ventcell conditions; with others there are no gaps");
    if (options.scheme == Scheme::ExplicitEuler)
        throw OptionError("keep_gaps is for backward Euler steps; explicit ones are taken undecomposed, without gaps");
}

void require_valid_tolerance(const FlowOptions& options)
{
    require(options.accuracy.converge_iterations >= 0, "converge_iterations", options.accuracy.converge_iterations,
            "at least 0");
    const bool asks_for_convergence = options.accuracy.tolerance || options.accuracy.approach == Approach::Converged;
    if (asks_for_convergence &&
        (options.interface.conditions != Conditions::AdaptedRobin || options.scheme == Scheme::ExplicitEuler))
        throw OptionError(std::string(options.accuracy.tolerance ? "tolerance is given" : "approach is converged") +
                          ", which leaves no room for other conditions or an explicit scheme");
    if (!options.accuracy.tolerance)
        return;
    require(positive_and_finite(*options.accuracy.tolerance) && *options.accuracy.tolerance < 1.0, "tolerance",
            *options.accuracy.tolerance, "positive and below 1 (residual against that at the beginning of a step)");
}

/// Without a tolerance converged steps are not chosen (see choose_tolerance).
void require_valid_factorisation(const FlowOptions& options)
{
    if (is_foreign(options.resources.factorisation) && is_symmetric(options.laplacian) &&
        (options.accuracy.tolerance || options.accuracy.approach == Approach::Converged))
        throw OptionError(
            "factorisation is that of another library, but converged steps of symmetric Laplacians need the "
            "Schur complements that the library's own gives: take sweeps (Approach::Sweep), or leave the factorisation "
            "automatic");
}

void require_valid_approach(const FlowOptions& options)
{
    if (!takes_whole_mesh(options.accuracy.approach))
        return;
    const std::string approach = fmt::format("approach is {}", option_name(options.accuracy.approach));
    if (options.interface != InterfaceOptions{} || options.scheme == Scheme::ExplicitEuler)
        throw OptionError(approach + ", which leaves no room for options of sweeps or an explicit scheme");
    if (options.cut.subdomains > 1 || !options.cut.labels.empty())
        throw OptionError(approach + ", which takes the whole mesh: leave out the sub-meshes");
    if (options.accuracy.approach == Approach::Undecomposed)
        return;
    if (!is_symmetric(options.laplacian))
        throw OptionError(fmt::format("approach is by conjugate gradients, but the Laplacian {} is not symmetric: use "
                                      "{}, or leave the approach automatic",
                                      name_of(options.laplacian), names_of_symmetric_laplacians()));
    if (options.resources.memory_limit || options.resources.factorisation != Factorisation::Automatic ||
        options.resources.precision != Precision::Automatic)
        throw OptionError("approach is by conjugate gradients, which factorise nothing: leave out the memory limit, "
                          "the factorisation and its precision");
}

void require_valid_constraints(const FlowOptions& options)
{
    if (options.motion.boundary == Boundary::Free && !is_symmetric(options.laplacian))
        throw OptionError(fmt::format("boundary is free, but the Laplacian {} has no natural boundary conditions (its "
                                      "rows there are one-sided and unstable): use {}, or leave the boundary fixed",
                                      name_of(options.laplacian), names_of_symmetric_laplacians()));
    if (options.motion.weld)
        require(*options.motion.weld >= 0.0 && std::isfinite(*options.motion.weld), "weld", *options.motion.weld,
                "at least 0 and finite (a length; empty: never)");
    if (options.motion.within)
        require(*options.motion.within > 0.0 && std::isfinite(*options.motion.within), "within", *options.motion.within,
                "above 0 and finite (a length; empty: no bound)");
    if (options.report.keep_gaps &&
        (options.motion.rescale != Rescale::None || options.motion.within || options.motion.limits.exist()))
        throw OptionError(
            "rescale, within and limits are for results whose sub-meshes are joined; keep_gaps leaves them "
            "separate");
    if (!options.motion.feature_edges.empty()) {
        if (!options.keep_edges)
            throw OptionError("feature_edges are kept where keep_edges says so: give its angle as well");
        if (options.motion.rescale != Rescale::None || options.motion.within)
            throw OptionError("rescale and within move vertices off feature_edges: leave them out");
    }
    if (options.motion.rescale != Rescale::None && !options.motion.fixed_vertices.empty())
        throw OptionError("rescale moves every vertex, but fixed_vertices are to stay: leave rescale "
                          "out; Filter::LowPass, with which what is large hardly shrinks, lets them stay");
}

bool is_weight(double weight)
{
    return weight >= 0.0 && std::isfinite(weight);
}

void require_valid_attachment(const MotionOptions& motion)
{
    require(is_weight(motion.attachment), "attachment", motion.attachment, "at least 0 and finite (1/length²)");
    const auto wrong = std::ranges::find_if_not(motion.attachment_weights, is_weight);
    if (wrong != motion.attachment_weights.end())
        throw InputError(fmt::format("the attachment weight of vertex {} is {:.17g}, but must be at least 0 and finite "
                                     "(1/length²)",
                                     wrong - motion.attachment_weights.begin(), *wrong));
    if (motion.attachment > 0.0 && !motion.attachment_weights.empty())
        throw OptionError(
            "attachment and attachment_weights both say how vertices are attached: leave one of them out");
}

/// What the options ask for beside plain mean curvature flow.
std::string further_flow(const FlowOptions& options)
{
    if (options.flow != FlowEquation::MeanCurvature)
        return fmt::format("flow is {}", option_name(options.flow));
    return !filter_of(options).is_plain()
               ? fmt::format("filter is {}, of order {}", option_name(options.filter), filter_of(options).order)
               : "vertices are attached";
}

void require_valid_filter(const FlowOptions& options)
{
    const int order = filter_of(options).order;
    if (options.filter == Filter::Diffusion)
        require(order >= 1 && order <= 3, "order", order, "1, 2 or 3 with the filter diffusion");
    else
        require(order >= 2 && order <= 8, "order", order, "at least 2 and at most 8 with the filter low-pass");
    require(options.uniform_edge >= 0.0 && std::isfinite(options.uniform_edge), "uniform_edge", options.uniform_edge,
            "at least 0 and finite (a length; 0: the mean edge length of the mesh)");
}

void require_valid_flow(const FlowOptions& options)
{
    require_valid_filter(options);
    require_valid_attachment(options.motion);
    if (is_plain_flow(options))
        return;
    const std::string asked = further_flow(options);
    if (!is_symmetric(options.laplacian))
        throw OptionError(fmt::format("{}, but the Laplacian {} is not symmetric: use {}", asked,
                                      name_of(options.laplacian), names_of_symmetric_laplacians()));
    if (options.scheme == Scheme::ExplicitEuler)
        throw OptionError(asked + ", which is for backward Euler steps: leave out the explicit scheme");
    if (options.accuracy.approach == Approach::ConjugateGradients && options.flow != FlowEquation::MeanCurvature)
        throw OptionError(asked +
                          ", but approach is by conjugate gradients, which take mean curvature flow alone: leave "
                          "the approach automatic");
    if (!filter_of(options).is_plain() && !predicts(options))
        throw OptionError(asked + ", which sweeps take with adapted Robin conditions and predicted transmission alone: "
                                  "leave out other conditions, the derivatives, and p");
}

/// Steps that keep edges take the whole mesh.
void require_valid_edges(const FlowOptions& options)
{
    if (!options.keep_edges)
        return;
    require(*options.keep_edges > 0.0 && *options.keep_edges < 180.0, "keep_edges", *options.keep_edges,
            "above 0 and below 180 (degrees)");
    const FlowOptions defaults;
    const char* other = nullptr;
    if (options.scheme != defaults.scheme)
        other = "an explicit scheme";
    else if (options.cut.subdomains > 1 || !options.cut.labels.empty() || options.resources.memory_limit)
        other = "sub-meshes";
    else if (options.interface != defaults.interface || options.report.keep_gaps)
        other = "an interface";
    else if (options.accuracy.approach != defaults.accuracy.approach || options.accuracy.tolerance ||
             options.resources.factorisation != defaults.resources.factorisation ||
             options.resources.precision != defaults.resources.precision)
        other = "an approach, a tolerance, a factorisation or its precision";
    else if (!is_plain_flow(options))
        other = "another flow, a filter or an attachment";
    else if (options.report.reference)
        other = "an undecomposed flow to compare with";
    if (other != nullptr)
        throw OptionError(fmt::format("keep_edges is given, which smooths normals on the whole mesh and leaves no room "
                                      "for {}: leave one of them out",
                                      other));
}

}  // namespace

void require_threads(int threads)
{
    require(threads >= 0 && threads <= ResourceOptions::most_threads, "threads", threads,
            "at least 0 and at most 1024 (0: as many as the calling TBB arena has)");
}

void require_valid(const FlowOptions& options)
{
    require_valid_amount(options);
    require(options.steps >= 0 && options.steps <= FlowOptions::most_steps, "steps", options.steps,
            "at least 0 and at most 1000000000");
    require(options.cut.subdomains >= 0, "subdomains", options.cut.subdomains, "at least 0 (0: chosen)");
    require_threads(options.resources.threads);
    if (options.interface.p)
        require(positive_and_finite(*options.interface.p), "p", *options.interface.p, "positive and finite (1/length)");
    if (options.interface.q)
        require(*options.interface.q >= 0.0 && std::isfinite(*options.interface.q), "q", *options.interface.q,
                "at least 0 and finite");
    if (options.interface.q.has_value() != has_tangential_derivative(options.interface.conditions))
        throw OptionError(options.interface.q ? "q is given, but belongs to the Ventcell conditions alone"
                                              : "q must be given with the Ventcell conditions");
    require(options.interface.overlap >= 1, "overlap", options.interface.overlap, "at least 1 (layers of faces)");
    if (options.resources.memory_limit)
        require(*options.resources.memory_limit >= 1, "memory_limit", *options.resources.memory_limit,
                "at least 1 (byte)");
    require(options.accuracy.largest_update > 0.0, "largest_update", options.accuracy.largest_update,
            "positive (diagonals of the mesh's bounding box; infinite: no limit)");
    if (options.interface.conditions == Conditions::Schwarz)
        require_valid_schwarz(options);
    require_valid_copies(options);
    require_valid_constraints(options);
    require_valid_flow(options);
    require_valid_tolerance(options);
    require_valid_approach(options);
    require_valid_edges(options);
    require_valid_factorisation(options);
    const auto negative =
        std::find_if(options.cut.labels.begin(), options.cut.labels.end(), [](Index label) { return label < 0; });
    if (negative != options.cut.labels.end())
        throw InputError(fmt::format("the label of face {} is {}, but labels must be at least 0",
                                     negative - options.cut.labels.begin(), *negative));
}

}  // namespace seamflow
