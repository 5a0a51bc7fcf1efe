#include "samples/command/settled_options.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "engine/options/option_rules.h"
#include "engine/setup/presets.h"
#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "samples/command/smooth_options.h"
#include "samples/process/cpu_quota.h"
#include "samples/process/option_words.h"

namespace seamflow {

namespace {

using Command = SmoothCommand;
using Asked = AskedOptions;
using Rule = OptionRule<SmoothCommand>;

bool has_amount(const Asked& asked)
{
    return !asked.first(concern::amount).empty();
}

/// Properties are those of a .ply file.
void require_ply(const Command& command, const Asked& asked)
{
    const auto require = [&](std::string_view option, const std::filesystem::path& path, std::string_view text) {
        if (asked.has(option) && format_of(path) != FileFormat::Ply)
            seamflow::refuse(filling(command.options)(text, unmarked(path.string()).text));
    };
    require("--fix-property", command.fix, "--fix-property is for a .ply file; {other} has vertex numbers");
    require("--region-property", command.region,
            "--region-property is for a .ply file; {other} has vertex numbers, or is a property itself");
    require("--attach-property", command.attach_weights,
            "--attach-property is for a .ply file; {other} has one number per line");
}

bool shows_tasks(const Command& c)
{
    return !c.trace.empty() || !c.task_graph.empty();
}

/// Rules of the command line alone (see require_compatible) that hold before a preset has chosen anything.
constexpr Rule rules_of_amounts[]{
    {[](const Command& c, const Asked&) { return !c.fields.exists() && c.noise; }, concern::amount,
     "--noise sets how much a preset smooths, and <{other}> does so too: give one of them"},
    {[](const Command& c, const Asked& asked) { return !c.fields.exists() && c.preset.empty() && !has_amount(asked); },
     concern::method,
     "<{other}> cannot be combined with a preset: say how much to smooth with --time-step, --time-step-edges or "
     "--radius"},
    {[](const Command& c, const Asked&) { return !c.fields.exists() && !c.preset.empty(); }, concern::method,
     "<{other}> and --preset exclude each other: say how much to smooth with --time-step, --time-step-edges or "
     "--radius, and leave the preset out"},
    {[](const Command& c, const Asked& asked) {
         return asked.has("--transmission") && c.options.interface.transmission == Transmission::Predicted &&
                (asked.has("--p") || asked.has("--p-rule") || asked.has("--p-edge"));
     },
     0, "--p, --p-rule and --p-edge are for the derivatives of the paper; --transmission predicted has none"},
};

/// The others: mostly options that would have no effect, which are a mistake of the user's.
constexpr Rule rules_of_effects[]{
    {[](const Command& c, const Asked& asked) {
         const AllOptions& o = c.options;
         const bool is_whole = o.takes_whole_mesh() || takes_whole_mesh(o.accuracy.approach);
         return (is_whole && (asked.has("--parts") || shows_tasks(c))) ||
                (o.scheme == Scheme::ExplicitEuler && shows_tasks(c));
     },
     0,
     "--parts shows the sub-meshes, --trace and --task-graph show their tasks, but steps of the whole mesh have none: "
     "leave them out"},
    {[](const Command& c, const Asked&) { return c.options.accuracy.tolerance.has_value(); }, concern::sweeps,
     "<{other}> is about sweeps, but --converge takes converged steps: leave one of them out"},
    {[](const Command& c, const Asked& asked) {
         return asked.has("--approach") && c.options.accuracy.approach == Approach::Sweep &&
                c.options.accuracy.tolerance;
     },
     0, "--converge takes converged steps, but --approach sweep takes sweeps: leave one of them out"},
    {[](const Command& c, const Asked&) { return c.options.accuracy.approach == Approach::Converged; }, concern::sweeps,
     "<{other}> is about sweeps, but --approach converged takes none: leave one of them out"},
    {[](const Command& c, const Asked& asked) {
         return asked.has("--converge") && c.options.accuracy.approach == Approach::Sweep;
     },
     concern::converged_steps, "<{other}> is for converged steps, but --converge never takes none"},
    {[](const Command&, const Asked& asked) {
         return asked.has("--p") && (asked.has("--p-rule") || asked.has("--p-edge"));
     },
     0, "--p-rule and --p-edge are about p*, but --p sets p itself: leave one of them out"},
    {[](const Command& c, const Asked& asked) {
         return asked.has("--overlap") && c.options.interface.conditions != Conditions::Schwarz;
     },
     0, "--overlap is for --conditions schwarz; other sub-meshes do not overlap"},
    {[](const Command& c, const Asked& asked) {
         return asked.has("--transmission") && c.options.interface.conditions != Conditions::AdaptedRobin;
     },
     0, "--transmission is for --conditions adapted-robin; others have one way only"},
    {[](const Command& c, const Asked& asked) {
         return asked.has("--paper") && c.options.interface.sweep != FlowOptions::plain().interface.sweep;
     },
     0, "--paper sweeps in the same order in every step; --sweep alternating contradicts it"},
    {[](const Command& c, const Asked& asked) {
         return asked.has("--paper") && c.options.interface.transmission != FlowOptions::plain().interface.transmission;
     },
     0, "--paper keeps to the derivatives of the paper; --transmission predicted contradicts it"},
    {[](const Command& c, const Asked& asked) {
         return asked.has("--factorisation") && c.options.scheme == Scheme::ExplicitEuler &&
                !c.options.report.reference;
     },
     0, "--factorisation is for backward Euler steps; --scheme explicit solves no equations"},
};

/// Rules of what takes the whole mesh without equations.
constexpr Rule rules_of_whole_mesh[]{
    {[](const Command& c, const Asked& asked) {
         return asked.has("feature_edges") && (!c.options.takes_whole_mesh() || c.options.smooth_rims);
     },
     0, "<feature_edges> names edges to keep: give <preset cad>, or <keep_edges> with an angle, as well"},
    {[](const Command& c, const Asked&) {
         return c.options.smooth_rims && (c.options.denoise || c.options.keep_edges);
     },
     0,
     "<boundary> is smooth, so that it alone moves: give a radius or a time step, and leave out <keep_edges> and "
     "<denoise>"},
    {[](const Command& c, const Asked& asked) {
         return c.options.takes_whole_mesh() && (c.options.cut.subdomains > 1 || asked.has("labels"));
     },
     0,
     "{whole} is given, which takes the whole mesh without equations and rules out sub-meshes: leave one of them out"},
    {[](const Command& c, const Asked& asked) {
         return c.options.takes_whole_mesh() &&
                (!is_plain_flow(c.options) || asked.has("attachment") || asked.has("attachment_weights"));
     },
     0,
     "{whole} is given, which takes the whole mesh without equations and rules out another flow, a filter or an "
     "attachment: leave one of them out"},
    {[](const Command& c, const Asked& asked) { return c.options.takes_whole_mesh() && asked.has("laplacian"); }, 0,
     "{whole} is given, which takes the whole mesh without equations and rules out <laplacian>: leave one of them out"},
    {[](const Command& c, const Asked&) { return c.options.takes_whole_mesh(); },
     concern::equations & ~concern::sub_meshes,
     "{whole} is given, which takes the whole mesh without equations and rules out <{other}>: leave one of them out"},
};

/// Checks the rules of the library, too, and names options as they were given.
void require_consistent(const CLI::App& app, const SmoothCommand& command)
{
    const AskedOptions asked = given_options(app, command);
    require_ply(command, asked);
    require_none_broken<Command>(rules_of_effects, command, asked, filling(command.options));
    try {
        require_compatible(command.options, asked);
        require_none_broken<Command>(rules_of_whole_mesh, command, asked, filling(command.options));
    } catch (const OptionError& error) {
        throw OptionError(sentence(error.wording(), [&](std::string_view option, std::string_view value) {
            if (option == "denoise" && !command.preset.empty())
                return "--preset " + command.preset;
            if (option == "feature_edges" && command.edges_from_file)
                return std::string("--edges-from-file");
            const bool is_implied = option == "approach" && value == "sweep" && app.count("--approach") == 0;
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
void apply_preset(const AskedOptions& asked, SmoothCommand& command)
{
    // Amounts of fields are checked with them.
    if (command.fields.exists() || (command.preset.empty() && has_amount(asked)))
        return;
    const PresetTraits& preset = command.preset.empty() ? default_preset(asked) : preset_of(command.preset);
    command.preset = preset.name;
    if (command.noise && !preset.measures_noise())
        throw OptionError("--noise is for --preset scan, terrain and automatic; " + command.preset +
                          (preset.denoise ? " finds out itself how much there is at each place"
                                          : " smooths as much whatever the noise"));
    PresetSettings settings = apply_preset(preset, command.options, asked);
    if (!settings.left_out.empty()) {
        std::string left_out = in_words(settings.left_out, ", ");
        left_out.resize(left_out.size() - 2);
        command.remarks.push_back(fmt::format("--preset {} leaves out {}, which --laplacian {} does not support.",
                                              command.preset, left_out, name_of(command.options.laplacian)));
    }
    static_cast<FlowOptions&>(command.options) = std::move(settings.options);
    command.options.denoise = settings.denoise;
    if (settings.keep_edges)
        command.options.keep_edges = settings.keep_edges;
    command.chosen = in_words(settings.chosen, " ");
    command.chooses_amount = settings.chooses_amount;
}

/// Options for the derivatives of the paper alone select these.
void take_derivatives(const CLI::App& app, InterfaceOptions& interface)
{
    if (!first_given(app, {"--p", "--p-rule", "--p-edge"}).empty())
        interface.transmission = Transmission::Derivative;
}

}  // namespace

void settle(const CLI::App& app, SmoothCommand& command)
{
    command.options.smooth_rims = command.boundary == BoundaryWord::Smooth;
    command.options.motion.boundary = command.boundary == BoundaryWord::Fixed ? Boundary::Fixed : Boundary::Free;
    require_none_broken<Command>(rules_of_amounts, command, given_options(app, command), filling(command.options));
    take_derivatives(app, command.options.interface);
    command.chooses_threads = command.options.resources.threads == 0;
    if (command.chooses_threads)
        command.options.resources.threads = threads_within_quota();
    apply_preset(given_options(app, command), command);
    command.gives_radius = command.options.radius.has_value();
    command.limits_iterations = app.count("--converge-iterations") > 0;
    if (app.count("--approach") == 0 && !first_given(app, concern::implies_sweeps).empty())
        command.options.accuracy.approach = Approach::Sweep;
    if (command.options.accuracy.approach == Approach::Automatic && !command.options.takes_whole_mesh() &&
        !first_given(app, concern::sub_meshes).empty())
        command.options.accuracy.approach = Approach::Decomposed;
    require_consistent(app, command);
    if (app.count("--conditions") > 0 && app.count("--paper") == 0 &&
        command.options.interface.conditions == Conditions::AdaptedRobin)
        command.remarks.emplace_back(
            "--conditions adapted-robin alone is not the paper's own method, which takes --paper as well: a fixed "
            "sweep, and derivatives at the old positions.");
}

}  // namespace seamflow
