#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <tuple>

#include "engine/options/flow_options.h"

/// The table of all options of a flow. What is said of options elsewhere comes from here: the limits of numbers, which
/// options exclude others, what determines the result of a flow, and the options of
/// command lines. A further field of FlowOptions has one line here; the compiler asks for it.
namespace seamflow {

/// What an option concerns, so that others exclude or imply it.
namespace concern {
constexpr unsigned sub_meshes = 1U;
constexpr unsigned sweeps = 2U;
/// Sweeps are taken because of it.
constexpr unsigned implies_sweeps = 4U;
/// The method: no preset can go with it.
constexpr unsigned method = 8U;
/// Factorisations of sub-meshes.
constexpr unsigned factors = 16U;
constexpr unsigned converged_steps = 32U;
/// How the equations are solved, in any other way.
constexpr unsigned solution = 64U;
/// All these: the equations of a step, which steps that keep edges do not have.
constexpr unsigned equations = (solution << 1U) - 1U;
/// The result of a step does not depend on it.
constexpr unsigned no_result = 128U;
}  // namespace concern

/// The limits of a number.
struct Limits {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    /// Whether the limits themselves are refused.
    bool above_least = false;
    bool below_most = true;
    /// For messages: what a number must be, and its unit. Empty: the limits depend on other options (see
    /// require_valid).
    std::string_view text = {};

    [[nodiscard]] bool hold(double value) const
    {
        return (above_least ? value > least : value >= least) && (below_most ? value < most : value <= most);
    }
};

struct OptionTraits {
    /// Its name in FlowOptions.
    std::string_view field;
    /// That of programs; empty: they do not have it.
    std::string_view option;
    unsigned concerns = 0;
    Limits limits = {};
};

template <class Value>
struct OptionRow : OptionTraits {
    Value* value;
};

/// @returns a tuple of rows.
/// @param options FlowOptions, const or not; the rows refer to it.
template <class Options>
auto option_table(Options& options)
{
    using namespace concern;
    auto& [laplacian, flow, filter, order, time_step, radius, uniform_edge, weights, steps, scheme, keep_edges, denoise,
           cut, interface, accuracy, motion, resources, report] = options;
    auto& [subdomains, labels] = cut;
    auto& [conditions, transmission, p, p_rule, p_edge, q, overlap, colouring, sweep, correction] = interface;
    auto& [tolerance, approach, converge_iterations, largest_update] = accuracy;
    auto& [weld, boundary, junctions, fixed_vertices, feature_edges, strict, attachment, attachment_weights, strength,
           direction, rescale, within, limits] = motion;
    auto& [volume, move, slide] = limits;
    auto& [threads, tune_for, memory_limit, factorisation, precision] = resources;
    auto& [reference, record_schedule, keep_gaps, measures] = report;
    const auto row = []<class Value>(std::string_view field, std::string_view option, unsigned concerns, Value& value,
                                     const Limits& of_number = {}) {
        return OptionRow<Value>{{field, option, concerns, of_number}, &value};
    };
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const auto positive = [&](std::string_view text) { return Limits{0.0, infinite, true, true, text}; };
    const auto not_negative = [&](std::string_view text) { return Limits{0.0, infinite, false, true, text}; };
    const auto at_least = [&](int least, std::string_view text) {
        return Limits{static_cast<double>(least), infinite, false, true, text};
    };
    return std::tuple{
        row("laplacian", "--laplacian", 0, laplacian),
        row("flow", "--flow", 0, flow),
        row("filter", "--filter", 0, filter),
        row("order", "--order", 0, order, at_least(1, "")),
        row("time_step", "--time-step", 0, time_step, positive("positive and finite (length²)")),
        row("radius", "--radius", no_result, radius,
            positive("positive and finite (a length, or a part of the bounding box's diagonal)")),
        row("uniform_edge", "", 0, uniform_edge,
            not_negative("at least 0 and finite (a length; 0: the mean edge length of the mesh)")),
        row("weights", "", 0, weights),
        row("steps", "--steps", no_result, steps,
            Limits{0.0, FlowOptions::most_steps, false, false, "at least 0 and at most 1000000000"}),
        row("subdomains", "--subdomains", sub_meshes, subdomains, at_least(0, "at least 0 (0: chosen)")),
        row("labels", "--labels", sub_meshes, labels),
        row("scheme", "--scheme", method, scheme),
        row("conditions", "--conditions", sweeps | implies_sweeps | method, conditions),
        row("transmission", "--transmission", sweeps | implies_sweeps | method, transmission),
        row("p", "--p", sweeps | method, p, positive("positive and finite (1/length)")),
        row("p_rule", "--p-rule", sweeps | implies_sweeps | method, p_rule),
        row("p_edge", "--p-edge", sweeps | implies_sweeps | method, p_edge),
        row("q", "--q", sweeps | method, q, not_negative("at least 0 and finite")),
        row("overlap", "--overlap", sweeps | method, overlap, at_least(1, "at least 1 (layers of faces)")),
        row("correction", "--no-correction", sweeps | method, correction),
        row("sweep", "--sweep", sweeps, sweep),
        row("colouring", "--coloring", sweeps | implies_sweeps, colouring),
        row("keep_gaps", "--keep-gaps", sweeps | method | no_result, keep_gaps),
        row("tolerance", "--converge", solution, tolerance,
            Limits{0.0, 1.0, true, true, "positive and below 1 (residual against that at the beginning of a step)"}),
        row("converge_iterations", "--converge-iterations", converged_steps, converge_iterations,
            at_least(0, "at least 0")),
        row("approach", "--approach", solution, approach),
        row("memory_limit", "--memory-limit", no_result, memory_limit, at_least(1, "at least 1 (byte)")),
        row("factorisation", "--factorisation", factors, factorisation),
        row("precision", "--precision", factors | converged_steps, precision),
        row("tune_for", "--tune-for", solution, tune_for,
            Limits{1.0, ResourceOptions::most_threads, false, false, "at least 1 and at most 1024 (cores)"}),
        row("reference", "--reference", solution, reference),
        row("keep_edges", "--keep-edges", 0, keep_edges,
            Limits{0.0, 180.0, true, true, "above 0 and below 180 (degrees)"}),
        row("denoise", "", 0, denoise),
        row("feature_edges", "--edges", 0, feature_edges),
        row("boundary", "--boundary", 0, boundary),
        row("junctions", "--junctions", 0, junctions),
        row("fixed_vertices", "--fix", 0, fixed_vertices),
        row("attachment", "--attach", 0, attachment, not_negative("at least 0 and finite (1/length²)")),
        row("attachment_weights", "--attach-weights", 0, attachment_weights),
        row("strength", "--region", 0, strength),
        row("direction", "--direction", 0, direction),
        row("weld", "--weld", 0, weld, not_negative("at least 0 and finite (a length; empty: never)")),
        row("strict", "--strict", no_result, strict),
        row("rescale", "--rescale", 0, rescale),
        row("within", "--within", 0, within, positive("above 0 and finite (a length; empty: no bound)")),
        row("limit_of_volume", "", 0, volume),
        row("limit_of_move", "", 0, move),
        row("limit_of_slide", "", 0, slide),
        row("largest_update", "", no_result, largest_update,
            Limits{0.0, infinite, true, false, "positive (diagonals of the mesh's bounding box; infinite: no limit)"}),
        row("threads", "--threads", no_result, threads,
            Limits{0.0, ResourceOptions::most_threads, false, false,
                   "at least 0 and at most 1024 (0: as many as the calling TBB arena has)"}),
        row("measures", "", 0, measures),
        row("record_schedule", "", no_result, record_schedule),
    };
}

/// Calls action with every row of the table.
template <class Options, class Action>
void for_each_option(Options& options, Action&& action)
{
    std::apply([&](const auto&... row) { (action(row), ...); }, option_table(options));
}

/// Calls action with the rows of both, in pairs.
template <class Action>
void for_each_option(const FlowOptions& one, const FlowOptions& other, Action&& action)
{
    std::apply(
        [&](const auto&... of_one) {
            std::apply([&](const auto&... of_other) { (action(of_one, of_other), ...); }, option_table(other));
        },
        option_table(one));
}

/// All rows without values, in the order of the table.
std::span<const OptionTraits> all_options();

/// The first option that has one of these concerns and is not as by default: its field; empty: there is none.
std::string_view first_set(const FlowOptions& options, unsigned concerns);

}  // namespace seamflow
