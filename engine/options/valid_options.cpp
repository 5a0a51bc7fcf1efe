#include "engine/options/valid_options.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "engine/options/option_table.h"
#include "partition/errors.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

template <class Value>
requires std::is_arithmetic_v<Value>
void require_within(const OptionTraits& row, Value value)
{
    if (row.limits.hold(static_cast<double>(value)))
        return;
    constexpr const char* text =
        std::is_same_v<Value, double> ? "{} is {:.17g}, but must be {}" : "{} is {}, but must be {}";
    throw OptionError(fmt::format(fmt::runtime(text), row.field, value, row.limits.text));
}

void require_within(const OptionTraits& row, LengthOnMesh length)
{
    require_within(row, length.value);
}

template <class Value>
void require_within(const OptionTraits& row, const std::optional<Value>& value)
{
    if (value)
        require_within(row, *value);
}

/// Checks all numbers.
void require_limits(const FlowOptions& options)
{
    if (options.radius && options.time_step != 0.0)
        throw OptionError("time_step and radius both say how much is smoothed: leave one of them out");
    for_each_option(options, [&](const auto& row) {
        const bool is_open = row.field == "time_step" && (options.radius || options.denoise);
        if constexpr (requires { require_within(row, *row.value); })
            if (!row.limits.text.empty() && !is_open)
                require_within(row, *row.value);
    });
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
    const bool asks_for_convergence = options.accuracy.tolerance || options.accuracy.approach == Approach::Converged;
    if (asks_for_convergence &&
        (options.interface.conditions != Conditions::AdaptedRobin || options.scheme == Scheme::ExplicitEuler))
        throw OptionError(std::string(options.accuracy.tolerance ? "tolerance is given" : "approach is converged") +
                          ", which rules out other conditions and an explicit scheme");
}

/// Without a tolerance converged steps are not chosen (see choose_tolerance).
void require_valid_factorisation(const FlowOptions& options)
{
    const Factorisation factorisation = options.resources.factorisation;
    const bool needs_own = is_foreign(factorisation) && is_symmetric(options.laplacian);
    if (needs_own && options.flow == FlowEquation::Linear)
        throw OptionError("factorisation is by another library, but only this library's own keeps the factors that the "
                          "linear flow needs: leave the factorisation automatic");
    if (needs_own && (options.accuracy.tolerance || options.accuracy.approach == Approach::Converged))
        throw OptionError("factorisation is by another library, but converged steps of symmetric Laplacians need the "
                          "Schur complements that this library's own provides: use sweeps (Approach::Sweep), or leave "
                          "the factorisation automatic");
    if (!is_available(factorisation))
        throw OptionError(fmt::format("factorisation is {}, but this build has no libraries under the GPL "
                                      "(SEAMFLOW_GPL=OFF): leave the factorisation automatic",
                                      option_name(factorisation)));
}

void require_valid_approach(const FlowOptions& options)
{
    if (!takes_whole_mesh(options.accuracy.approach))
        return;
    const std::string approach = fmt::format("approach is {}", option_name(options.accuracy.approach));
    if (const std::string_view other = first_set(options, concern::sweeps | concern::method); !other.empty())
        throw OptionError(fmt::format("{}, which rules out {}: leave one of them out", approach, other));
    if (options.cut.subdomains > 1 || !options.cut.labels.empty())
        throw OptionError(approach + ", which takes the whole mesh: leave out the sub-meshes");
    if (options.accuracy.approach == Approach::Undecomposed)
        return;
    if (!is_symmetric(options.laplacian))
        throw OptionError(fmt::format("approach is by conjugate gradients, but the Laplacian {} is not symmetric: use "
                                      "{}, or leave the approach automatic",
                                      name_of(options.laplacian), names_of_symmetric_laplacians()));
    if (const std::string_view other = first_set(options, concern::factors); !other.empty())
        throw OptionError(fmt::format("{}, but conjugate gradients factorise nothing: leave {} out", approach, other));
}

void require_valid_constraints(const FlowOptions& options)
{
    if (options.motion.boundary == Boundary::Free && !is_symmetric(options.laplacian))
        throw OptionError(fmt::format("boundary is free, but the Laplacian {} has no natural boundary conditions (its "
                                      "rows there are one-sided and unstable): use {}, or leave the boundary fixed",
                                      name_of(options.laplacian), names_of_symmetric_laplacians()));
    if (options.report.keep_gaps &&
        (options.motion.rescale != Rescale::None || options.motion.within || options.motion.limits.exist()))
        throw OptionError(
            "rescale, within and limits are for results whose sub-meshes are joined; keep_gaps leaves them "
            "separate");
    if (!options.motion.feature_edges.empty()) {
        if (!smooths_normals(options) || smooths_rims(options))
            throw OptionError(
                "feature_edges are kept only with keep_edges or denoise: give the angle of edges as well");
        if (options.motion.rescale != Rescale::None || options.motion.within)
            throw OptionError("rescale and within move vertices off feature_edges: leave them out");
    }
    if (options.motion.rescale != Rescale::None && !options.motion.fixed_vertices.empty())
        throw OptionError("rescale moves every vertex, but fixed_vertices are to stay: leave rescale out; "
                          "Filter::LowPass, which hardly shrinks large features, lets them stay");
}

bool is_weight(double weight)
{
    return weight >= 0.0 && std::isfinite(weight);
}

void require_valid_attachment(const MotionOptions& motion)
{
    const auto wrong = std::ranges::find_if_not(motion.attachment_weights, is_weight);
    if (wrong != motion.attachment_weights.end())
        throw InputError(fmt::format("the attachment weight of vertex {} is {:.17g}, but must be at least 0 and finite "
                                     "(1/length²)",
                                     wrong - motion.attachment_weights.begin(), *wrong));
    if (motion.attachment > 0.0 && !motion.attachment_weights.empty())
        throw OptionError(
            "attachment and attachment_weights both say how vertices are attached: leave one of them out");
}

/// A region: not for sweeps, whose conditions on Γ know one dt only.
void require_valid_strength(const FlowOptions& options)
{
    const std::vector<double>& strength = options.motion.strength;
    const auto wrong = std::ranges::find_if_not(strength, [](double s) { return s >= 0.0 && s <= 1.0; });
    if (wrong != strength.end())
        throw InputError(fmt::format("the strength of vertex {} is {:.17g}, but must be from 0 to 1",
                                     wrong - strength.begin(), *wrong));
    if (strength.empty())
        return;
    if (options.motion.rescale != Rescale::None)
        throw OptionError(
            "rescale moves every vertex, but those with a strength of 0 are to stay: leave one of them out");
    std::string_view other = first_set(options, concern::sweeps);
    if (other.empty() && options.accuracy.approach == Approach::Sweep && !options.accuracy.tolerance)
        other = "the approach";
    if (!other.empty())
        throw OptionError(fmt::format("strength is given, whose steps are converged or undecomposed, but {} is for "
                                      "sweeps: leave one of them out",
                                      other));
    if (is_foreign(options.resources.factorisation) && is_symmetric(options.laplacian) &&
        options.accuracy.approach != Approach::Undecomposed)
        throw OptionError("strength is given, whose steps in sub-meshes need this library's own factorisation: leave "
                          "the factorisation automatic, or take undecomposed steps");
}

void require_valid_direction(const FlowOptions& options)
{
    const MotionDirection& direction = options.motion.direction;
    if (direction.kind == MotionDirection::Kind::Any)
        return;
    if (direction.kind == MotionDirection::Kind::Vector &&
        !(direction.vector.allFinite() && direction.vector.norm() > 0.0 && std::isfinite(direction.vector.norm())))
        throw OptionError("direction must be a finite vector other than 0, like 0,0,1");
    if (options.motion.rescale != Rescale::None || !options.motion.feature_edges.empty())
        throw OptionError("direction lets vertices move along lines alone, which rescale and feature_edges do not: "
                          "leave one of them out");
    if (is_classical(options.interface.conditions) || options.interface.conditions == Conditions::Schwarz)
        throw OptionError("direction is for flows with one copy of each vertex, but with the classical and the Schwarz "
                          "conditions every sub-mesh has its own: use other conditions");
}

/// The option that asks for more than plain mean curvature flow.
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
    const auto [least, most] = orders_of(options.filter);
    const int order = filter_of(options).order;
    if (order < least || order > most)
        throw OptionError(fmt::format("order is {}, but must be {} to {} with the filter {}", order, least, most,
                                      option_name(options.filter)));
}

void require_valid_flow(const FlowOptions& options)
{
    require_valid_filter(options);
    require_valid_attachment(options.motion);
    if (options.weights != Weights::OfLaplacian && options.flow != FlowEquation::Linear)
        throw OptionError("weights of at least 0 are for data that diffuse on a surface that stays: ask for a linear "
                          "flow, or leave weights out");
    if (is_plain_flow(options))
        return;
    const std::string asked = further_flow(options);
    if (!is_symmetric(options.laplacian))
        throw OptionError(fmt::format("{}, but the Laplacian {} is not symmetric: use {}", asked,
                                      name_of(options.laplacian), names_of_symmetric_laplacians()));
    if (options.scheme == Scheme::ExplicitEuler)
        throw OptionError(asked + ", which is for backward Euler steps: leave out the explicit scheme");
    if (options.accuracy.approach == Approach::ConjugateGradients && options.flow == FlowEquation::Conformalized)
        throw OptionError(asked + ", but approach is by conjugate gradients, which support only mean curvature and "
                                  "linear flows: leave the approach automatic");
    if (options.flow == FlowEquation::Linear)
        if (const std::string_view set = first_set(options, concern::sweeps);
            !set.empty() || (options.accuracy.approach == Approach::Sweep && !options.accuracy.tolerance))
            throw OptionError(fmt::format("{}, whose steps are converged or undecomposed, but {} is for sweeps: leave "
                                          "that out",
                                          asked, set.empty() ? "the approach" : set));
    if (!filter_of(options).is_plain() && !predicts(options))
        throw OptionError(asked + ", which sweeps support only with adapted Robin conditions and predicted "
                                  "transmission: leave out other conditions, the derivatives, and p");
}

/// Steps that keep edges take the whole mesh.
void require_valid_edges(const FlowOptions& options)
{
    if (!smooths_normals(options))
        return;
    if (smooths_rims(options) && (options.denoise || options.keep_edges))
        throw OptionError("boundary is smooth, so that it alone moves: give a radius or a time step, and leave out "
                          "keep_edges and denoise");
    std::string_view other = first_set(options, concern::equations & ~concern::sub_meshes);
    if (options.cut.subdomains > 1 || !options.cut.labels.empty())
        other = "sub-meshes";
    else if (!is_plain_flow(options))
        other = "another flow, a filter or an attachment";
    if (!other.empty())
        throw OptionError(fmt::format(
            "{} is given, which takes the whole mesh without equations and rules out {}: leave one of them out",
            options.keep_edges      ? "keep_edges"
            : smooths_rims(options) ? "a smooth boundary"
                                    : "denoise",
            other));
}

}  // namespace

void require_threads(int threads)
{
    require_within(*std::ranges::find(all_options(), "threads", &OptionTraits::field), threads);
}

void require_valid(const FlowOptions& options)
{
    require_limits(options);
    if (options.interface.q.has_value() != has_tangential_derivative(options.interface.conditions))
        throw OptionError(options.interface.q ? "q is given, but belongs only to the Ventcell conditions"
                                              : "q must be given with the Ventcell conditions");
    if (options.interface.conditions == Conditions::Schwarz)
        require_valid_schwarz(options);
    require_valid_copies(options);
    require_valid_constraints(options);
    require_valid_strength(options);
    require_valid_direction(options);
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
