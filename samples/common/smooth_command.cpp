#include "samples/common/smooth_command.h"

#include <limits>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "partition/io/input_file.h"
#include "samples/common/command_line.h"
#include "samples/common/flow_choices.h"
#include "samples/common/output_files.h"
#include "samples/common/presets.h"
#include "samples/common/settled_options.h"
#include "samples/page/page_html.h"

namespace seamflow {

namespace {

/// Options that only mean something for the derivatives of the paper, and so ask for them.
void add_parameters(CLI::App& app, FlowOptions& options)
{
    std::vector<CLI::Option*> of_derivatives;
    of_derivatives.push_back(
        add_real(app, "--p", options.interface.p, positive(), "Robin parameter, in 1/length [p* of each sub-mesh]"));
    of_derivatives.push_back(add_choice(app, "--p-rule", options.interface.p_rule, "η in p*: 1 or 1/dt [paper]"));
    of_derivatives.push_back(
        add_choice(app, "--p-edge", options.interface.p_edge,
                   "edge in p*: the shortest, the 5th percentile, or the mean; auto: the shortest unless it is a "
                   "sliver's, then the percentile [auto; with --plain min]"));
    add_real(app, "--q", options.interface.q, {0.0, std::numeric_limits<double>::max()},
             "Ventcell parameter, for adapted-ventcell and ventcell");
    app.callback([of_derivatives, &app, &options] {
        for (const CLI::Option* option : of_derivatives) {
            if (option->count() == 0)
                continue;
            if (app.count("--transmission") > 0 && options.interface.transmission == Transmission::Predicted)
                throw OptionError(option->get_name() +
                                  " is for the derivatives of the paper; --transmission predicted has none");
            options.interface.transmission = Transmission::Derivative;
        }
    });
}

void add_amount(CLI::App& app, SmoothingRequest& amount)
{
    auto* group = app.add_option_group("Amount of smoothing", "in one of these ways");
    add_real(*group, "--time-step", amount.time_step, positive(), "of each step, in length²");
    add_real(*group, "--time-step-edges", amount.time_step_edges, positive(),
             "of each step, in squared mean edge lengths");
    add_length(*group, "--radius", amount.radius,
               "bumps of this radius and smaller lose half their height or more over all steps; in units of length, or "
               "in % of the bounding box's diagonal");
}

/// "scan: what it is for (--steps 3); cad: …".
std::string describe_presets()
{
    std::string text;
    for (const PresetTraits& preset : all_presets()) {
        text += fmt::format("{}{}: {} (", text.empty() ? "" : "; ", preset.name, preset.purpose);
        for (const PresetOption& option : options_of(preset))
            text += fmt::format("{} {} ", option.name, option.value);
        text += preset.measures_noise() ? "and what the noise asks for" : amount_of(preset);
        text += ")";
    }
    return text;
}

void add_weld(CLI::App& app, SmoothCommand& command)
{
    const auto parse = [](const std::string& text) -> std::optional<LengthOnMesh> {
        try {
            return text == "never" ? std::nullopt : std::optional(parse_length(text));
        } catch (const OptionError& error) {
            throw OptionError(std::string(error.what()) + ", nor never");
        }
    };
    add_parsed(
        app, "--weld", command.weld, parse, "never|LENGTH",
        "vertices so near to each other move as one where edges of one face each lie on each other, as along "
        "seams of a texture; in units of length, or in % of the bounding box's diagonal [those at equal places]");
}

void add_flow_options(CLI::App& app, SmoothCommand& command)
{
    FlowOptions& options = command.options;
    // Options take effect in the order in which they are added here: --plain first, so that the others refine it.
    app.add_flag_callback(
        "--plain", [&options] { options = FlowOptions::plain(); },
        "the paper's method for any number of sub-meshes: a fixed sweep, derivatives at the old positions");
    std::vector<std::string> names;
    for (const PresetTraits& preset : all_presets())
        names.emplace_back(preset.name);
    app.add_option("--preset", command.preset,
                   "options that suit a kind of mesh; those that are given go before them. " + describe_presets() +
                       " [scan if no amount is given; cad with --keep-edges or --edges]")
        ->check(CLI::IsMember(names).description(""))
        ->type_name("scan|cad|terrain|fair");
    add_length(app, "--noise", command.noise,
               "how far vertices are off the surface, as standard deviation along its normals, where that is known; in "
               "units of length, or in % of the bounding box's diagonal [measured]");
    add_choice(app, "--laplacian", options.laplacian, laplacian_choices(), "discrete Laplacian [fujiwara]");
    add_choice(app, "--flow", options.flow,
               "conformalized: the weights of the Laplacian stay those of the input; necks do not pinch, and closed "
               "surfaces without handles go to a sphere [mean-curvature]");
    add_choice(app, "--filter", options.filter,
               "diffusion leaves 1/(1 + λᵏ) of what has λ, dt times its eigenvalue, low-pass 1 - (λ/(1 + λ))ᵐ: what is "
               "large hardly shrinks [diffusion]");
    add_integer(app, "--order", options.order, 1,
                "k of the filter diffusion, 1 to 3, or m of low-pass, 2 to 8: the higher, the less is taken of what is "
                "large; takes 8 solutions a step for k = 2, 11 for k = 3, m for m [1, low-pass 2]");
    add_amount(app, command.amount);
    add_choice(app, "--boundary", options.motion.boundary,
               "whether the rims of an open surface stay where they are or draw in freely [fixed]");
    auto* fix = app.add_option("--fix", command.fix,
                               "vertices that stay: their numbers from 0, one a line, or a .ply with as many vertices "
                               "and a property that is not 0 where they stay")
                    ->type_name("FILE");
    app.add_option("--fix-property", command.fix_property, "the name of that property [fixed]")
        ->needs(fix)
        ->type_name("NAME");
    auto* attach = add_length(app, "--attach", command.attach,
                              "pull every vertex back to where it was: what is larger than this stays; in units of "
                              "length, or in % of the bounding box's diagonal");
    auto* weights = app.add_option("--attach-weights", command.attach_weights,
                                   "how strongly each vertex is pulled back, in 1/length²: a number a line, or a .ply "
                                   "with as many vertices and a property that says it")
                        ->excludes(attach)
                        ->type_name("FILE");
    app.add_option("--attach-property", command.attach_property, "the name of that property [weight]")
        ->needs(weights)
        ->type_name("NAME");
    add_length(
        app, "--within", command.within,
        "no vertex ends further than this from where it was: those that would are held there, and the others give "
        "way smoothly; in units of length, or in % of the bounding box's diagonal");
    add_weld(app, command);
    app.add_flag("--strict", options.motion.strict,
                 "refuse meshes that are not manifold, or have edges or faces of size 0 where the Laplacian divides, "
                 "instead of holding "
                 "such vertices fixed");
    add_choice(
        app, "--rescale", options.motion.rescale,
        "scale the result to the area or volume of the input, its centroid kept; where no vertex is held, so of open "
        "surfaces with --boundary free [none]");
    add_choice(app, "--scheme", options.scheme,
               "how a step is taken: backward Euler, or explicit Euler, which is undecomposed and stable for "
               "small time steps only [implicit]");
    add_real(app, "--keep-edges", options.keep_edges, {0.0, 180.0, true},
             "smooth what lies between edges sharper than this angle between faces, in degrees, and keep these and "
             "their corners; 20 to 40 are good, with --time-step-edges 16 or so; on the whole mesh");
    auto* edges =
        app.add_option("--edges", command.edges,
                       "edges that are kept, too, however little they bend: two numbers of vertices a line, from 0, or "
                       "an .obj with polylines or .ply with edges; with --keep-edges or --preset cad")
            ->type_name("FILE");
    app.add_flag("--edges-from-file", command.edges_from_file,
                 "the same by the polylines (.obj) or edges (.ply) of INPUT")
        ->excludes(edges);
    add_integer(app, "--steps", options.steps, 0, "number of steps [1]");
    auto* subdomains = add_integer(app, "--subdomains", options.cut.subdomains, 0,
                                   "number of sub-meshes; 1: undecomposed, 0: chosen [0]");
    app.add_option("--labels", command.labels, "file with the sub-mesh of every face, one a line")
        ->excludes(subdomains)
        ->type_name("FILE");
    add_choice(app, "--coloring", options.interface.colouring,
               "how sub-meshes are coloured, which sets the order in which they solve [greedy]");
    add_choice(app, "--conditions", options.interface.conditions, "what holds between sub-meshes [adapted-robin]");
    add_choice(app, "--transmission", options.interface.transmission,
               "how the first sub-mesh at the interface learns of the others [predicted]");
    add_parameters(app, options);
    add_integer(app, "--overlap", options.interface.overlap, 1,
                "layers of faces by which sub-meshes overlap with schwarz [1]");
    app.add_flag_callback(
        "--no-correction", [&options] { options.interface.correction = Correction::None; },
        "leave the vertices of the interface where the step puts them");
    app.add_flag("--keep-gaps", options.report.keep_gaps,
                 "write the sub-meshes as they are, each with its own copy of the interface; for robin and ventcell");
    add_choice(app, "--sweep", options.interface.sweep,
               "order of the colours from step to step [fixed for two sub-meshes, else alternating]");
    add_converge(
        app, options,
        "the undecomposed step itself, to this relative residual; never: one sweep each step; auto: loosely, where "
        "--approach needs a tolerance or sweeps would stray, unless another option speaks of sweeps [auto]");
    add_choice(
        app, "--approach", options.accuracy.approach,
        "how a step is taken; sweep: one sweep over the sub-meshes; converged: these converge to the undecomposed "
        "step; decomposed: one of both; cg: the whole mesh by conjugate gradients, which need hardly any set-up; "
        "undecomposed: the whole mesh by one factorisation; auto: the fastest, in sub-meshes where another option "
        "speaks of them [auto]");
    add_integer(app, "--converge-iterations", options.accuracy.converge_iterations, 0,
                "most iterations of a converged step [1000]");
    add_choice(app, "--factorisation", options.resources.factorisation,
               "whose factorisation solves the equations of sub-meshes; cholmod: UMFPACK where they are "
               "not symmetric; both keep symmetric Laplacians to sweeps [auto: the fastest]");
    add_choice(
        app, "--precision", options.resources.precision,
        "of the factorisations of converged steps, which are refined to the tolerance in any; auto: single where "
        "that loses few digits [auto]");
    add_integer(app, "--threads", options.resources.threads, 0,
                "number of threads, at most 1024; 0: as many as there are cores, and as the control group allows [0]");
    add_bytes(
        app, "--memory-limit", options.resources.memory_limit,
        "most that the factorisations of sub-meshes may take at once, in bytes or with K, M, G, T, KiB, MiB, GiB, TiB; "
        "asks for sub-meshes, and does not change their result; converged steps make again what they cannot keep "
        "[sweeps: as little as keeps all threads busy; converged steps: no limit]");
    app.add_flag("--self-intersections", command.self_intersections,
                 "count the pairs of faces that cross each other, before and after; --report does so, too");
    app.add_flag("--reference", options.report.reference, "also run the undecomposed flow and give the distance to it");
}

void add_files(CLI::App& app, SmoothCommand& command, std::string& every_step)
{
    app.add_option("INPUT", command.input, "mesh: " + extensions_of() + ", .gz behind it or not; - for standard input")
        ->required()
        ->type_name("");
    app.add_option("OUTPUT", command.output, "smoothed mesh; - for standard output")->required()->type_name("");
    app.add_option("--every-step", every_step, "also write the mesh after every step; %d is its number")
        ->type_name("PATTERN");
    app.add_option("--parts", command.parts, "write the cut: faces with colours and labels")->type_name("PARTS.ply");
    app.add_option("--report", command.report,
                   "write times, sizes and distances, or why it failed; - for standard output")
        ->type_name("REPORT.json");
    app.add_option("--trace", command.trace, "write which task ran when in which thread, for ui.perfetto.dev")
        ->type_name("TRACE.json");
    app.add_option("--task-graph", command.task_graph,
                   "write the tasks of a step and what each waits for, for Graphviz")
        ->type_name("GRAPH.dot");
    app.add_option("--html", command.html, "write a page that shows the surface step by step, and plots, in a browser")
        ->type_name("PAGE.html");
}

/// What matters if the flow takes long.
void add_long_run(CLI::App& app, SmoothCommand& command)
{
    auto* checkpoint =
        app.add_option("--checkpoint", command.checkpoint,
                       "keep in that folder what the run needs to go on after the last complete step: the same "
                       "command does so then, with the same result; it stays there at the end, from where more --steps "
                       "go on")
            ->type_name("FOLDER");
    add_parsed(app, "--checkpoint-every", command.checkpoint_period, parse_checkpoint_period, "STEPS|TIME",
               "how often, in steps (10) or time (30s, 5min, 1h), and at the end [1]")
        ->needs(checkpoint);
    auto* quiet = app.add_flag("--quiet", command.quiet, "print nothing but errors");
    app.add_flag("--verbose", command.verbose, "also print what each step did, the cut, and the time in tasks")
        ->excludes(quiet);
}

/// Results in formats that there are.
void require_usable_results(const SmoothCommand& command)
{
    if (!command.html.empty())
        require_page();
    kind_for_writing(command.output, FileKind{});
    if (command.every_step)
        kind_for_writing(command.every_step->path(1), FileKind{});
    if (!command.parts.empty() && kind_for_writing(command.parts, FileKind{}).format != FileFormat::Ply)
        throw OptionError("--parts " + command.parts.string() + ": the cut is written as .ply only");
}

/// The most that --every-step may write.
constexpr int most_files = 100'000;

/// Also keeps every result but OUTPUT from replacing one of the inputs.
void require_usable_files(const SmoothCommand& command)
{
    if (command.every_step && command.options.steps > most_files)
        throw OptionError(
            fmt::format("--every-step would write {} files; {} are the most", command.options.steps, most_files));
    std::vector<std::filesystem::path> results;
    for (int step = 1; command.every_step && step <= command.options.steps; ++step)
        results.push_back(command.every_step->path(step));
    for (const auto& path : {command.parts, command.trace, command.task_graph, command.html})
        if (!path.empty())
            results.push_back(path);
    require_files(results);
    if (is_standard_stream(command.report) && is_standard_stream(command.output))
        throw OptionError("OUTPUT and --report are both -: name a file for one of them");
    if (!command.report.empty() && !is_standard_stream(command.report))
        results.push_back(command.report);
    if (command.edges_from_file && is_input_stream(command.input))
        throw OptionError("--edges-from-file reads INPUT a second time: name a file instead of -");
    require_files({command.labels, command.fix, command.edges, command.attach_weights});
    for (const auto& input : {command.input, command.labels, command.fix, command.edges, command.attach_weights}) {
        std::vector<std::filesystem::path> files = results;
        if (!input.empty())
            files.push_back(input);
        require_different(files);
    }
    results.push_back(command.output);
    std::vector<std::filesystem::path> all = results;
    if (!command.checkpoint.empty())
        all.insert(all.end(), {command.checkpoint, Checkpoints(command.checkpoint, {}).file()});
    require_different(all);
    for (const auto& path : results)
        require_writable(path);
}

/// --help does not speak of what a program has not.
void hide(CLI::App& app, const SmoothProgram& program)
{
    for (const SmoothProgram::Lack& lack : program.lacks)
        app.get_option(lack.option)->group("");
}

void require_known(const CLI::App& app, const SmoothProgram& program)
{
    for (const SmoothProgram::Lack& lack : program.lacks)
        if (app.count(lack.option) > 0)
            throw OptionError(fmt::format("{} has no {}: {}", program.name, lack.option, lack.reason));
}

}  // namespace

std::optional<ExitStatus> parse_smooth_command(int argc, char** argv, SmoothCommand& command,
                                               const SmoothProgram& program)
{
    CLI::App app(program.description, program.name);
    std::string every_step;
    add_files(app, command, every_step);
    add_flow_options(app, command);
    add_long_run(app, command);
    if (program.add_own)
        program.add_own(app);
    hide(app, program);
    if (const auto end = parse_command_line(app, argc, argv))
        return end;
    require_known(app, program);
    command.arguments.assign(argv + 1, argv + argc);
    settle(app, command);
    // Nobody would see it.
    command.options.report.measures =
        command.verbose || !command.report.empty() || !command.html.empty() || !command.checkpoint.empty();
    command.self_intersections = command.self_intersections || !command.report.empty();
    command.options.report.record_schedule = !command.trace.empty() || !command.task_graph.empty();
    if (!every_step.empty())
        command.every_step.emplace(every_step);
    require_usable_results(command);
    if (program.checks_files)
        require_usable_files(command);
    return std::nullopt;
}

std::vector<FlowOptionText> flow_options()
{
    CLI::App app;
    app.set_help_flag();
    SmoothCommand command;
    add_flow_options(app, command);
    std::vector<CLI::App*> groups = app.get_subcommands({});
    groups.insert(groups.begin(), &app);
    std::vector<FlowOptionText> list;
    for (const CLI::App* group : groups)
        for (const CLI::Option* option : group->get_options({}))
            list.push_back({.name = option->get_lnames().front(),
                            .type = option->get_type_name(),
                            .description = option->get_description(),
                            .is_flag = option->get_items_expected_max() == 0});
    return list;
}

SmoothCommand parse_flow_options(const std::vector<std::string>& words)
{
    CLI::App app;
    app.set_help_flag();
    SmoothCommand command;
    add_flow_options(app, command);
    // CLI11 takes them last first.
    std::vector<std::string> reversed(words.rbegin(), words.rend());
    try {
        app.parse(std::move(reversed));
    } catch (const CLI::ParseError& error) {
        throw OptionError(error.what());
    }
    command.arguments = words;
    settle(app, command);
    return command;
}

int steps_failed(const SmoothCommand& command, const ConvergenceReport& report)
{
    if (!command.options.accuracy.tolerance)
        return 0;
    return command.limits_iterations ? report.steps_stagnated : report.steps_short_of_tolerance;
}

}  // namespace seamflow
