#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <tuple>

#include "engine/options/flow_options.h"
#include "engine/options/motion_option_table.h"

/// The table of all options of a flow. Other statements on options come from here: the limits of numbers, which options
/// exclude others, which determine the result of a flow, and the options of command lines with their texts. A further
/// field of FlowOptions has one row here; the compiler asks for it.
namespace seamflow {

/// @returns a tuple of rows.
/// @param options FlowOptions, const or not; the rows refer to it.
template <class Options>
auto option_table(Options& options)
{
    using namespace concern;
    auto& [laplacian, flow, filter, order, time_step, time_step_edges, radius, uniform_edge, steps, scheme, cut,
           interface, accuracy, motion, resources, report] = options;
    auto& [subdomains, labels] = cut;
    auto& [conditions, transmission, p, p_rule, p_edge, q, overlap, colouring, sweep, correction] = interface;
    auto& [tolerance, approach, converge_iterations, largest_update] = accuracy;
    auto& [threads, tune_for, memory_limit, factorisation, precision] = resources;
    auto& [reference, record_schedule, keep_gaps, measures] = report;
    namespace group = option_group;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const auto at_least = [&](int least, std::string_view text) {
        return Limits{static_cast<double>(least), infinite, false, true, text};
    };
    const std::tuple amounts{
        row(laplacian, {"laplacian", "--laplacian", group::kind, equation,
                        "discrete Laplacian [fujiwara; of fields virtual-refinement]"}),
        row(flow, {"flow", "--flow", group::kind, equation,
                   "conformalized keeps the weights of the Laplacian; necks do not pinch [mean-curvature]\n"
                   "It turns closed surfaces without handles into spheres, but not with fujiwara. linear keeps all "
                   "of the Laplacian, and so one factorisation for all steps: the heat equation on the input, "
                   "applied to its coordinates."}),
        row(filter, {"filter", "--filter", group::kind, equation,
                     "low-pass: large features hardly shrink [diffusion]\n"
                     "With λ = dt times an eigenvalue, the factor of diffusion is 1/(1 + λᵏ), that of low-pass "
                     "1 - (λ/(1 + λ))ᵐ."}),
        row(order, {"order", "--order", group::kind, equation,
                    "order of the filter, diffusion 1 to 3, low-pass 2 to 8: higher orders shrink large features "
                    "less [1, low-pass 2]\n"
                    "It is k of the filter diffusion and m of low-pass. A step takes 8 solutions for k = 2, 11 for "
                    "k = 3, m for low-pass.",
                    at_least(1, "")}),
        row(radius, {"radius", "--radius", group::amount, amount | no_result,
                     "bumps of this radius lose half their height, smaller ones more, over all steps together",
                     limits_of_radius}),
        row(time_step,
            {"time_step", "--time-step", group::amount, amount, "time step, in length²", limits_of_time_step}),
        row(time_step_edges, {"time_step_edges", "--time-step-edges", group::amount, amount | no_result,
                              "time step, in squared mean edge lengths", limits_of_time_step_edges}),
        row(uniform_edge,
            {.field = "uniform_edge",
             .limits = not_negative("at least 0 and finite (a length; 0: the mean edge length of the mesh)")}),
        row(steps, {"steps", "--steps", group::amount, no_result, "number of steps [1]", limits_of_steps})};
    const std::tuple steps_and_report{
        row(subdomains,
            {"subdomains", "--subdomains", group::sub_meshes, sub_meshes,
             "number of sub-meshes; 1: undecomposed, 0: chosen [0]", at_least(0, "at least 0 (0: chosen)")}),
        row(labels, {"labels", "--labels", group::sub_meshes, sub_meshes | numbers,
                     "file with the sub-mesh of every face, one a line"}),
        row(scheme, {"scheme", "--scheme", group::accuracy, method | concern::motion,
                     "backward or explicit Euler steps [implicit]\n"
                     "Explicit steps are undecomposed, and stable for small time steps only."}),
        row(conditions, {"conditions", "--conditions", group::sub_meshes, sweeps | implies_sweeps | method,
                         "conditions between sub-meshes [adapted-robin]"}),
        row(colouring, {"colouring", "--coloring", group::sub_meshes, sweeps | implies_sweeps,
                        "colouring of the sub-meshes, which sets the order in which they solve [greedy]"}),
        row(sweep, {"sweep", "--sweep", group::sub_meshes, sweeps,
                    "order of the colours from step to step [fixed for two sub-meshes, else alternating]"}),
        row(transmission, {"transmission", "--transmission", group::sub_meshes, sweeps | implies_sweeps | method,
                           "how the first sub-mesh at the interface takes account of the others [predicted]"}),
        row(p, {"p", "--p", group::sub_meshes, sweeps | method, "Robin parameter, in 1/length [p* of each sub-mesh]",
                positive("positive and finite (1/length)")}),
        row(p_rule,
            {"p_rule", "--p-rule", group::sub_meshes, sweeps | implies_sweeps | method, "η in p*: 1 or 1/dt [paper]"}),
        row(p_edge, {"p_edge", "--p-edge", group::sub_meshes, sweeps | implies_sweeps | method,
                     "edge in p*: the shortest, the 5th percentile, or the mean [auto; with --paper min]\n"
                     "auto: the shortest unless it is a sliver's, then the percentile."}),
        row(q, {"q", "--q", group::sub_meshes, sweeps | method, "Ventcell parameter, for adapted-ventcell and ventcell",
                not_negative("at least 0 and finite")}),
        row(overlap, {"overlap", "--overlap", group::sub_meshes, sweeps | method,
                      "layers of faces by which sub-meshes overlap with schwarz [1]",
                      at_least(1, "at least 1 (layers of faces)")}),
        row(correction, {"correction", "--no-correction", group::sub_meshes, sweeps | method,
                         "do not correct the vertices of the interface after a step"}),
        row(keep_gaps,
            {"keep_gaps", "--keep-gaps", group::sub_meshes, sweeps | method | no_result | concern::motion | files,
             "write the sub-meshes separately, each with its own copy of the interface; for robin and "
             "ventcell"}),
        row(tolerance,
            {"tolerance", "--converge", group::accuracy, solution,
             "converge to the undecomposed step, to this relative residual; never: one sweep a step [auto]\n"
             "auto: to a loose tolerance where --approach needs one or sweeps would drift, unless another "
             "option concerns sweeps.",
             Limits{0.0, 1.0, true, true, "positive and below 1 (residual against that at the beginning of a step)"}}),
        row(converge_iterations,
            {"converge_iterations", "--converge-iterations", group::accuracy, converged_steps,
             "largest number of iterations of a converged step [1000]", at_least(0, "at least 0")}),
        row(approach, {"approach", "--approach", group::accuracy, solution,
                       "the solver [auto: the fastest]\n"
                       "sweep: one sweep over the sub-meshes; converged: sub-meshes converge to the undecomposed step; "
                       "decomposed: one of the two; cg: conjugate gradients on the whole mesh, with hardly any set-up; "
                       "undecomposed: one factorisation of the whole mesh; auto: the fastest, in sub-meshes if another "
                       "option concerns them."}),
        row(tune_for, {"tune_for", "--tune-for", group::accuracy, solution,
                       "the number of cores for which --approach auto is the fastest [2]\n"
                       "It is not that of the machine, so that the result is the same on all of them.",
                       Limits{1.0, most_threads, false, false, "at least 1 and at most 1024 (cores)"}}),
        row(precision, {"precision", "--precision", group::accuracy, factors | converged_steps,
                        "precision of the factorisations of converged steps [auto]\n"
                        "Steps are refined to the tolerance in any case. auto: single where that loses few digits."}),
        row(factorisation,
            {"factorisation", "--factorisation", group::accuracy, factors,
             "the direct solver of sub-meshes [auto: the fastest]\n"
             "cholmod (UMFPACK where they are not symmetric), umfpack: only in builds with these libraries. With "
             "either, symmetric Laplacians take sweeps."}),
        row(memory_limit,
            {"memory_limit", "--memory-limit", group::machine, no_result,
             "limit for all factorisations at any time: 500M, 2GiB [as much as is fast]\n"
             "In bytes or with K, M, G, T, KiB, MiB, GiB, TiB. Converged steps recompute the factors that they cannot "
             "keep; what still does not fit is solved by conjugate gradients, which factorise nothing, unless another "
             "option asks for sub-meshes. By default sweeps take as little as keeps all threads busy, and converged "
             "steps have no limit.",
             at_least(1, "at least 1 (byte)")}),
        row(threads,
            {"threads", "--threads", group::machine, no_result,
             "number of threads, at most 1024; 0: all cores that the control group allows [0]", limits_of_threads}),
        row(reference, {"reference", "--reference", group::written, solution | concern::motion | whole_surface,
                        "also run the undecomposed flow, and print the distances to it (V_ and H_)"}),
        row(largest_update, {.field = "largest_update",
                             .concerns = no_result,
                             .limits = Limits{0.0, infinite, true, false,
                                              "positive (diagonals of the mesh's bounding box; infinite: no limit)"}}),
        row(measures, {"measures"}),
        row(record_schedule, {.field = "record_schedule", .concerns = no_result})};
    return std::tuple_cat(amounts, motion_table(motion), steps_and_report);
}

/// Calls action with every row of the table.
template <class Options, class Action>
void for_each_option(Options& options, Action&& action)
{
    for_each_row(option_table(options), action);
}

/// Calls action with the rows of two tables, in pairs of the same option.
template <class Action>
void for_each_option(const FlowOptions& one, const FlowOptions& other, Action&& action)
{
    for_each_pair(option_table(one), option_table(other), action);
}

/// All rows without values, in the order of the table.
std::span<const OptionTraits> all_options();

/// The field of the first option that has one of these concerns and differs from its default; empty: there is none.
std::string_view first_set(const FlowOptions& options, unsigned concerns);

}  // namespace seamflow
