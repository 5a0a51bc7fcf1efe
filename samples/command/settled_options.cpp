#include "samples/command/settled_options.h"

#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "samples/command/presets.h"
#include "samples/command/smooth_options.h"
#include "samples/process/cpu_quota.h"

namespace seamflow {

namespace {

/// Refuses options that mean nothing to steps that keep edges.
void require_room_for_edges(const CLI::App& app, const SmoothCommand& command)
{
    const std::string other = first_given(app, concern::equations);
    if (smooths_normals(command.options) && !other.empty())
        throw OptionError(fmt::format("{} is about the equations of mean curvature flow, but {} smooths face normals "
                                      "on the whole mesh: leave one of them out",
                                      other, command.options.denoise ? "--preset " + command.preset : "--keep-edges"));
}

/// @param of_sweeps an option for sweeps; may be empty.
void require_consistent_approach(const CLI::App& app, const SmoothCommand& command, const std::string& of_sweeps)
{
    const Approach approach = command.options.accuracy.approach;
    if (app.count("--approach") == 0 || approach == Approach::Automatic || approach == Approach::Decomposed)
        return;
    const std::string name = fmt::format("--approach {}", option_name(approach));
    if (approach == Approach::Sweep && command.options.accuracy.tolerance)
        throw OptionError("--converge takes converged steps, but " + name + " takes sweeps: leave one of them out");
    if (approach != Approach::Sweep && !of_sweeps.empty())
        throw OptionError(of_sweeps + " is about sweeps, but " + name + " takes none: leave one of them out");
    const std::string of_sub_meshes = first_given(
        app, approach == Approach::ConjugateGradients ? concern::sub_meshes | concern::factors : concern::sub_meshes);
    if (takes_whole_mesh(approach) && !of_sub_meshes.empty())
        throw OptionError(of_sub_meshes + " is about sub-meshes, but " + name +
                          " takes the whole mesh: leave one of them out");
}

/// What takes sweeps: an option that is about them, or the approach; empty if nothing does.
/// @param of_sweeps see require_consistent_approach.
std::string reason_for_sweeps(const CLI::App& app, const SmoothCommand& command, const std::string& of_sweeps)
{
    const AccuracyOptions& accuracy = command.options.accuracy;
    if (!of_sweeps.empty() || accuracy.approach != Approach::Sweep || accuracy.tolerance)
        return of_sweeps;
    return app.count("--approach") > 0 ? "--approach sweep" : "--converge never";
}

/// Options that would have no effect are a mistake of the user's.
void require_effective(const CLI::App& app, const SmoothCommand& command)
{
    const std::string of_sweeps = first_given(app, concern::sweeps);
    if (command.options.accuracy.tolerance && !of_sweeps.empty())
        throw OptionError(of_sweeps + " is about sweeps, but --converge takes converged steps: leave one of them out");
    const std::string sweeps = reason_for_sweeps(app, command, of_sweeps);
    if (command.options.flow == FlowEquation::Linear && !sweeps.empty())
        throw OptionError(sweeps + " is about sweeps, but --flow linear takes none: leave one of them out");
    if (!command.region.empty() && !sweeps.empty())
        throw OptionError(fmt::format("--region is given, whose steps are converged or undecomposed, but {} is for "
                                      "sweeps: leave one of them out",
                                      sweeps));
    require_consistent_approach(app, command, of_sweeps);
    if (app.count("--converge") > 0 && command.options.accuracy.approach == Approach::Sweep)
        if (const std::string of_converged = first_given(app, concern::converged_steps); !of_converged.empty())
            throw OptionError(of_converged + " is for converged steps, but --converge never takes none");
    if (app.count("--p") > 0)
        if (const std::string rule = first_given(app, {"--p-rule", "--p-edge"}); !rule.empty())
            throw OptionError(rule + " is about p*, but --p sets p itself: leave one of them out");
    if (app.count("--fix-property") > 0 && format_of(command.fix) != FileFormat::Ply)
        throw OptionError("--fix-property is for a .ply file; " + command.fix.string() + " has vertex numbers");
    if (app.count("--region-property") > 0 && format_of(command.region) != FileFormat::Ply)
        throw OptionError("--region-property is for a .ply file; " + command.region.string() +
                          " has vertex numbers, or is a property itself");
    if (app.count("--attach-property") > 0 && format_of(command.attach_weights) != FileFormat::Ply)
        throw OptionError("--attach-property is for a .ply file; " + command.attach_weights.string() +
                          " has one number per line");
}

bool names_edges(const CLI::App& app)
{
    return app.count("--edges") + app.count("--edges-from-file") > 0;
}

bool keeps_edges(const CLI::App& app)
{
    return app.count("--keep-edges") > 0 || names_edges(app);
}

/// Whether an option of a preset was given, or does not fit those that were.
bool is_said(const CLI::App& app, const SmoothCommand& command, std::string_view option)
{
    if (option.empty())
        return false;
    if (app.count(std::string(option)) > 0)
        return true;
    const bool is_further = option == "--flow" || option == "--filter" || option == "--order" || option == "--attach";
    if (option == "--direction" &&
        (app.count("--rescale") > 0 || names_edges(app) || is_classical(command.options.interface.conditions) ||
         command.options.interface.conditions == Conditions::Schwarz))
        return true;
    if (app.count("--laplacian") > 0 && !is_symmetric(command.options.laplacian))
        return is_further;
    if (option == "--flow")
        return command.options.accuracy.approach == Approach::ConjugateGradients;
    return (option == "--attach" && app.count("--attach-weights") > 0) ||
           (option == "--order" && app.count("--filter") > 0);
}

/// Whether options are about the equation of a flow.
bool wants_equation(const CLI::App& app)
{
    return !first_given(app, concern::equations | concern::equation).empty();
}

/// The preset without an amount.
std::string_view default_preset(const CLI::App& app)
{
    if (keeps_edges(app))
        return "cad";
    return wants_equation(app) ? "scan" : all_presets().front().name;
}

/// Takes options that were not given from the preset that was, or that is the default without an amount.
void apply_preset(const CLI::App& app, SmoothCommand& command)
{
    // Amounts of fields are checked with them.
    if (command.fields.exists())
        return;
    const std::string amount = first_given(app, concern::amount);
    const bool has_amount = !amount.empty();
    if (app.count("--time-step") + app.count("--time-step-edges") + app.count("--radius") > 1)
        throw OptionError("--time-step, --time-step-edges and --radius all say how much to smooth: give one of them");
    if (has_amount && command.noise)
        throw OptionError("--noise sets how much a preset smooths, and " + amount + " does so too: give one of them");
    if (command.preset.empty() && has_amount)
        return;
    if (const std::string other = first_given(app, concern::method); !other.empty())
        throw OptionError(
            fmt::format("{} {}: say how much to smooth with --time-step, --time-step-edges or --radius{}", other,
                        command.preset.empty() ? "cannot be combined with a preset" : "and --preset exclude each other",
                        command.preset.empty() ? "" : ", and leave the preset out"));
    if (command.preset.empty())
        command.preset = default_preset(app);
    const PresetTraits& preset = preset_of(command.preset);
    if (command.noise && !preset.measures_noise())
        throw OptionError("--noise is for --preset scan, terrain and automatic; " + command.preset +
                          (preset.denoise ? " finds out itself how much there is at each place"
                                          : " smooths as much whatever the noise"));
    std::string left_out;
    const bool denoise = preset.denoise && !has_amount && (preset.keep_edges || !wants_equation(app));
    for (const PresetOption& option : options_of(preset, denoise)) {
        if (is_said(app, command, option.name)) {
            if (app.count(std::string(option.name)) == 0 && !is_symmetric(command.options.laplacian))
                left_out += fmt::format("{}{} {}", left_out.empty() ? "" : ", ", option.name, option.value);
            continue;
        }
        option.set(command.options, command.attach);
        if (!option.name.empty())
            command.chosen += fmt::format("{} {} ", option.name, option.value);
    }
    if (!left_out.empty())
        command.remarks.push_back(fmt::format("--preset {} leaves out {}, which --laplacian {} does not support.",
                                              command.preset, left_out, name_of(command.options.laplacian)));
    command.chooses_amount = !has_amount;
}

/// Options for the derivatives of the paper alone select these.
void take_derivatives(const CLI::App& app, InterfaceOptions& interface)
{
    const std::string option = first_given(app, {"--p", "--p-rule", "--p-edge"});
    if (option.empty())
        return;
    if (app.count("--transmission") > 0 && interface.transmission == Transmission::Predicted)
        throw OptionError(option + " is for the derivatives of the paper; --transmission predicted has none");
    interface.transmission = Transmission::Derivative;
}

void require_consistent(const CLI::App& app, const SmoothCommand& command)
{
    require_room_for_edges(app, command);
    require_effective(app, command);
    if (app.count("--overlap") > 0 && command.options.interface.conditions != Conditions::Schwarz)
        throw OptionError("--overlap is for --conditions schwarz; other sub-meshes do not overlap");
    if (command.options.interface.conditions == Conditions::Schwarz &&
        command.options.interface.sweep == Sweep::Alternating)
        throw OptionError(
            "--conditions schwarz sweeps in the same order in every step; --sweep alternating contradicts "
            "it");
    if (command.options.interface.conditions == Conditions::Schwarz && command.options.interface.p)
        throw OptionError("--p is for the Robin and Ventcell conditions; schwarz has no Robin parameter");
    if (has_tangential_derivative(command.options.interface.conditions) && !command.options.interface.q)
        throw OptionError("--conditions " + std::string(option_name(command.options.interface.conditions)) +
                          " needs --q, the Ventcell parameter (see (20) to (25) of the paper)");
    if (app.count("--transmission") > 0 && command.options.interface.conditions != Conditions::AdaptedRobin)
        throw OptionError("--transmission is for --conditions adapted-robin; others have one way only");
    if (app.count("--paper") > 0 && command.options.interface.sweep != FlowOptions::plain().interface.sweep)
        throw OptionError("--paper sweeps in the same order in every step; --sweep alternating contradicts it");
    if (app.count("--paper") > 0 &&
        command.options.interface.transmission != FlowOptions::plain().interface.transmission)
        throw OptionError("--paper keeps to the derivatives of the paper; --transmission predicted contradicts it");
    if (command.options.motion.rescale != Rescale::None && !command.fix.empty())
        throw OptionError("--rescale moves every vertex, but --fix holds some: leave --rescale out; --filter low-pass, "
                          "which hardly shrinks large features, lets them stay");
    for (const auto& [option, path] : {std::pair{"--trace", command.trace}, {"--task-graph", command.task_graph}})
        if (!path.empty() && command.options.scheme == Scheme::ExplicitEuler)
            throw OptionError(
                std::string(option).append(" shows the tasks of the sub-meshes; --scheme explicit has none"));
    if (app.count("--factorisation") > 0 && command.options.scheme == Scheme::ExplicitEuler &&
        !command.options.report.reference)
        throw OptionError("--factorisation is for backward Euler steps; --scheme explicit solves no equations");
}

}  // namespace

void settle(const CLI::App& app, SmoothCommand& command)
{
    take_derivatives(app, command.options.interface);
    command.chooses_threads = command.options.resources.threads == 0;
    if (command.chooses_threads)
        command.options.resources.threads = threads_within_quota();
    apply_preset(app, command);
    if (names_edges(app) && !smooths_normals(command.options))
        throw OptionError(first_given(app, {"--edges", "--edges-from-file"}) +
                          " names edges to keep: give --preset cad, or --keep-edges with an angle, as well");
    command.limits_iterations = app.count("--converge-iterations") > 0;
    if (app.count("--approach") == 0 && !first_given(app, concern::implies_sweeps).empty())
        command.options.accuracy.approach = Approach::Sweep;
    if (command.options.accuracy.approach == Approach::Automatic && !first_given(app, concern::sub_meshes).empty())
        command.options.accuracy.approach = Approach::Decomposed;
    require_consistent(app, command);
    if (app.count("--conditions") > 0 && app.count("--paper") == 0 &&
        command.options.interface.conditions == Conditions::AdaptedRobin)
        command.remarks.emplace_back(
            "--conditions adapted-robin alone is not the paper's own method, which takes --paper as well: a fixed "
            "sweep, and derivatives at the old positions.");
}

}  // namespace seamflow
