// Which options of a request go together, and what follows from them.

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "engine/options/option_rules.h"
#include "engine/setup/presets.h"
#include "partition/errors.h"
#include "samples/options/smooth_request.h"
#include "samples/process/cpu_quota.h"
#include "samples/process/option_words.h"

namespace seamflow {

namespace {

using Asked = AskedOptions;
using RequestRule = OptionRule<SmoothRequest>;

bool has_amount(const Asked& asked)
{
    return !asked.first(concern::amount).empty();
}

bool shows_tasks(const Asked& asked)
{
    return asked.has("--trace") || asked.has("--task-graph");
}

/// Whether fields diffuse on a surface that stays, whose amounts are checked with them.
bool is_for_fields(const Asked& asked)
{
    return asked.has("--fields") || asked.has("--from");
}

/// Rules of the command line alone (see require_compatible) that hold before a preset has chosen anything.
constexpr RequestRule rules_of_amounts[]{
    {[](const SmoothRequest& c, const Asked& asked) { return !is_for_fields(asked) && c.noise; }, concern::amount,
     "--noise sets how much a preset smooths, and <{other}> does so too: give one of them"},
    {[](const SmoothRequest& c, const Asked& asked) {
         return !is_for_fields(asked) && c.preset == nullptr && !has_amount(asked);
     },
     concern::method,
     "<{other}> cannot be combined with a preset: say how much to smooth with --time-step, --time-step-edges or "
     "--radius"},
    {[](const SmoothRequest& c, const Asked& asked) { return !is_for_fields(asked) && c.preset != nullptr; },
     concern::method,
     "<{other}> and --preset exclude each other: say how much to smooth with --time-step, --time-step-edges or "
     "--radius, and leave the preset out"},
    {[](const SmoothRequest& c, const Asked& asked) {
         return asked.has("--transmission") && c.options.interface.transmission == Transmission::Predicted &&
                (asked.has("--p") || asked.has("--p-rule") || asked.has("--p-edge"));
     },
     0, "--p, --p-rule and --p-edge are for the derivatives of the paper; --transmission predicted has none"},
};

/// The others: mostly options that would have no effect, which are a mistake of the user's.
constexpr RequestRule rules_of_effects[]{
    {[](const SmoothRequest& c, const Asked& asked) {
         const AllOptions& o = c.options;
         const bool is_whole = o.takes_whole_mesh() || takes_whole_mesh(o.accuracy.approach);
         return (is_whole && (asked.has("--parts") || shows_tasks(asked))) ||
                (o.scheme != Scheme::BackwardEuler && shows_tasks(asked));
     },
     0,
     "--parts shows the sub-meshes, --trace and --task-graph show their tasks, but steps of the whole mesh have none: "
     "leave them out"},
    {[](const SmoothRequest& c, const Asked&) { return c.options.accuracy.tolerance.has_value(); }, concern::sweeps,
     "<{other}> is about sweeps, but --converge takes converged steps: leave one of them out"},
    {[](const SmoothRequest& c, const Asked& asked) {
         return asked.has("--approach") && c.options.accuracy.approach == Approach::Sweep &&
                c.options.accuracy.tolerance;
     },
     0, "--converge takes converged steps, but --approach sweep takes sweeps: leave one of them out"},
    {[](const SmoothRequest& c, const Asked&) { return c.options.accuracy.approach == Approach::Converged; },
     concern::sweeps, "<{other}> is about sweeps, but --approach converged takes none: leave one of them out"},
    {[](const SmoothRequest& c, const Asked& asked) {
         return asked.has("--converge") && c.options.accuracy.approach == Approach::Sweep;
     },
     concern::converged_steps, "<{other}> is for converged steps, but --converge never takes none"},
    {[](const SmoothRequest&, const Asked& asked) {
         return asked.has("--p") && (asked.has("--p-rule") || asked.has("--p-edge"));
     },
     0, "--p-rule and --p-edge are about p*, but --p sets p itself: leave one of them out"},
    {[](const SmoothRequest& c, const Asked& asked) {
         return asked.has("--overlap") && c.options.interface.conditions != Conditions::Schwarz;
     },
     0, "--overlap is for --conditions schwarz; other sub-meshes do not overlap"},
    {[](const SmoothRequest& c, const Asked& asked) {
         return asked.has("--transmission") && c.options.interface.conditions != Conditions::AdaptedRobin;
     },
     0, "--transmission is for --conditions adapted-robin; others have one way only"},
    {[](const SmoothRequest& c, const Asked& asked) {
         return asked.has("--paper") && c.options.interface.sweep != FlowOptions::plain().interface.sweep;
     },
     0, "--paper sweeps in the same order in every step; --sweep alternating contradicts it"},
    {[](const SmoothRequest& c, const Asked& asked) {
         return asked.has("--paper") && c.options.interface.transmission != FlowOptions::plain().interface.transmission;
     },
     0, "--paper keeps to the derivatives of the paper; --transmission predicted contradicts it"},
    {[](const SmoothRequest& c, const Asked& asked) {
         return asked.has("--factorisation") && c.options.scheme != Scheme::BackwardEuler &&
                !c.options.report.reference;
     },
     0, "--factorisation is for backward Euler steps; --scheme explicit solves no equations"},
};

/// Rules of what takes the whole mesh without equations.
constexpr RequestRule rules_of_whole_mesh[]{
    {[](const SmoothRequest& c, const Asked& asked) {
         return asked.has("feature_edges") && (!c.options.takes_whole_mesh() || c.options.smooth_rims);
     },
     0, "<feature_edges> names edges to keep: give <preset cad>, or <keep_edges> with an angle, as well"},
    {[](const SmoothRequest& c, const Asked& asked) { return asked.has("rounded") && !c.options.denoise; }, 0,
     "<rounded> bounds the smoothest surface, which is looked for without an amount, sub-meshes or an equation: leave "
     "out <rounded>, or the options that choose these"},
    {[](const SmoothRequest& c, const Asked&) {
         return c.options.smooth_rims && (c.options.denoise || c.options.keep_edges);
     },
     0,
     "<boundary> is smooth, so that it alone moves: give a radius or a time step, and leave out <keep_edges> and "
     "<denoise>"},
    {[](const SmoothRequest& c, const Asked& asked) {
         return c.options.takes_whole_mesh() && (c.options.cut.subdomains > 1 || asked.has("labels"));
     },
     0,
     "{whole} is given, which takes the whole mesh without equations and rules out sub-meshes: leave one of them out"},
    {[](const SmoothRequest& c, const Asked& asked) {
         return c.options.takes_whole_mesh() &&
                (!is_plain_flow(c.options) || asked.has("attachment") || asked.has("attachment_weights"));
     },
     0,
     "{whole} is given, which takes the whole mesh without equations and rules out another flow, a filter or an "
     "attachment: leave one of them out"},
    {[](const SmoothRequest& c, const Asked& asked) { return c.options.takes_whole_mesh() && asked.has("laplacian"); },
     0,
     "{whole} is given, which takes the whole mesh without equations and rules out <laplacian>: leave one of them out"},
    {[](const SmoothRequest& c, const Asked&) { return c.options.takes_whole_mesh(); },
     concern::equations & ~concern::sub_meshes,
     "{whole} is given, which takes the whole mesh without equations and rules out <{other}>: leave one of them out"},
};

/// Checks the rules of the library, too, and names options as they were given.
void require_consistent(const SmoothRequest& request)
{
    const AskedOptions asked = asked_options(request);
    require_none_broken<SmoothRequest>(rules_of_effects, request, asked, filling(request.options));
    try {
        require_compatible(request.options, asked);
        require_none_broken<SmoothRequest>(rules_of_whole_mesh, request, asked, filling(request.options));
    } catch (const OptionError& error) {
        throw OptionError(sentence(error.wording(), [&](std::string_view option, std::string_view value) {
            if (option == "denoise" && request.preset != nullptr)
                return fmt::format("--preset {}", request.preset->name);
            if (option == "feature_edges" && is_given(request, "--edges-from-file"))
                return std::string("--edges-from-file");
            const bool is_implied = option == "approach" && value == "sweep" && !is_given(request, "--approach");
            return is_implied ? std::string("--converge never") : option_of_program(option, value);
        }));
    }
}

/// "--steps 3 --order 2", each followed by `behind`.
std::string in_words(std::span<const PresetSetting> settings, std::string_view behind)
{
    std::string text;
    for (const PresetSetting& one : settings)
        text.append(option_of_program(one.option, one.value)).append(behind);
    return text;
}

/// Takes options that were not given from the preset that was, or that is the default without an amount.
void take_preset(SmoothRequest& request)
{
    const AskedOptions asked = asked_options(request);
    if (is_for_fields(asked) || (request.preset == nullptr && has_amount(asked)))
        return;
    if (request.preset == nullptr)
        request.preset = &default_preset(asked);
    const PresetTraits& preset = *request.preset;
    if (request.noise && !preset.measures_noise())
        throw OptionError(fmt::format("--noise is for --preset scan, terrain and automatic; {} {}", preset.name,
                                      preset.denoise ? "finds out itself how much there is at each place"
                                                     : "smooths as much whatever the noise"));
    PresetSettings settings = apply_preset(preset, request.options, asked);
    if (!settings.left_out.empty()) {
        std::string left_out = in_words(settings.left_out, ", ");
        left_out.resize(left_out.size() - 2);
        request.remarks.push_back(fmt::format("--preset {} leaves out {}, which --laplacian {} does not support.",
                                              preset.name, left_out, name_of(request.options.laplacian)));
    }
    static_cast<FlowOptions&>(request.options) = std::move(settings.options);
    request.options.denoise = settings.denoise;
    if (settings.keep_edges)
        request.options.keep_edges = settings.keep_edges;
    request.chosen = in_words(settings.chosen, " ");
    if (settings.amount)
        request.chosen_amount = option_of_program(settings.amount->option, settings.amount->value);
    request.chooses_amount = settings.chooses_amount;
}

/// How steps are taken, where options imply it.
void take_approach(SmoothRequest& request)
{
    Approach& approach = request.options.accuracy.approach;
    if (!is_given(request, "--approach") && !first_given(request, concern::implies_sweeps).empty())
        approach = Approach::Sweep;
    if (approach == Approach::Automatic && !request.options.takes_whole_mesh() &&
        !first_given(request, concern::sub_meshes).empty())
        approach = Approach::Decomposed;
}

}  // namespace

void settle(SmoothRequest& request)
{
    AllOptions& options = request.options;
    options.smooth_rims = request.boundary == BoundaryWord::Smooth;
    options.motion.boundary = request.boundary == BoundaryWord::Fixed ? Boundary::Fixed : Boundary::Free;
    require_none_broken<SmoothRequest>(rules_of_amounts, request, asked_options(request), filling(options));
    // Options for the derivatives of the paper alone select these.
    if (is_given(request, "--p") || is_given(request, "--p-rule") || is_given(request, "--p-edge"))
        options.interface.transmission = Transmission::Derivative;
    request.chooses_threads = options.resources.threads == 0;
    if (request.chooses_threads)
        options.resources.threads = threads_within_quota();
    take_preset(request);
    request.gives_radius = options.radius.has_value();
    request.limits_iterations = is_given(request, "--converge-iterations");
    take_approach(request);
    require_consistent(request);
    if (is_given(request, "--conditions") && !is_given(request, "--paper") &&
        options.interface.conditions == Conditions::AdaptedRobin)
        request.remarks.emplace_back(
            "--conditions adapted-robin alone is not the paper's own method, which takes --paper as well: a fixed "
            "sweep, and derivatives at the old positions.");
}

}  // namespace seamflow
