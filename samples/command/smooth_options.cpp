#include "samples/command/smooth_options.h"

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "samples/command/command_help.h"
#include "samples/command/command_line.h"
#include "samples/command/flow_choices.h"
#include "samples/command/presets.h"

namespace seamflow {

namespace {

/// "scan: what it is for (--steps 3)", one preset per line.
std::string describe_presets()
{
    std::string text;
    for (const PresetTraits& preset : all_presets()) {
        text += fmt::format("\n{}: {} (", preset.name, preset.purpose);
        for (const PresetOption& option : options_of(preset, preset.denoise))
            text += option.name.empty() ? "" : fmt::format("{} {} ", option.name, option.value);
        text += (preset.denoise            ? "and what the noise of each place asks for"
                 : preset.measures_noise() ? "and what the noise asks for"
                                           : amount_of(preset)) +
                ")";
    }
    return text;
}

void add_amount(CLI::App& app, SmoothCommand& command)
{
    app.option_defaults()->group(option_group::amount);
    FlowOptions& options = command.options;
    add_length(app, "--noise", command.noise,
               "noise of the vertices, if it is known [measured]\n"
               "The standard deviation along the normals. A preset derives the amount from it.");
    add_length(app, "--radius", command.amount.radius,
               "bumps of this radius lose half their height, smaller ones more, over all steps together");
    add_real(app, "--time-step", command.amount.time_step, positive(), "time step, in length²");
    add_real(app, "--time-step-edges", command.amount.time_step_edges, positive(),
             "time step, in squared mean edge lengths");
    add_field(app, options, "--steps", "number of steps [1]");
    add_length(app, "--within", command.within,
               "no vertex ends further than this from where it was\n"
               "Vertices beyond it are moved back to it, and their neighbours follow smoothly.");
    add_field(app, options, "--rescale",
              "scale the result to the area or volume of the input [none]\n"
              "The centroid stays. Not with fixed vertices; open surfaces therefore need --boundary free.");
}

void add_kind(CLI::App& app, SmoothCommand& command)
{
    app.option_defaults()->group(option_group::kind);
    FlowOptions& options = command.options;
    std::vector<std::string> names;
    for (const PresetTraits& preset : all_presets())
        names.emplace_back(preset.name);
    app.add_option(
           "--preset", command.preset,
           "options for a kind of mesh [automatic if no amount is given]\n"
           "Without an amount, options about equations choose scan, and edges choose cad. Options on the command "
           "line override those of the preset." +
               describe_presets())
        ->check(CLI::IsMember(names).description(""))
        ->type_name("automatic|scan|cad|terrain|fair");
    add_field(app, options, "--laplacian", "discrete Laplacian [fujiwara; of fields virtual-refinement]");
    add_field(app, options, "--flow",
              "conformalized keeps the weights of the Laplacian; necks do not pinch [mean-curvature]\n"
              "It turns closed surfaces without handles into spheres, but not with fujiwara. linear keeps all of the "
              "Laplacian, and so one "
              "factorisation for all steps: the heat equation on the input, applied to its coordinates.");
    add_field(app, options, "--filter",
              "low-pass: large features hardly shrink [diffusion]\n"
              "With λ = dt times an eigenvalue, the factor of diffusion is 1/(1 + λᵏ), that of low-pass "
              "1 - (λ/(1 + λ))ᵐ.");
    add_field(app, options, "--order",
              "order of the filter, diffusion 1 to 3, low-pass 2 to 8: higher orders shrink large features less [1, "
              "low-pass 2]\n"
              "It is k of the filter diffusion and m of low-pass. A step takes 8 solutions for k = 2, 11 for k = 3, "
              "m for low-pass.");
}

void add_feature_edges(CLI::App& app, SmoothCommand& command)
{
    add_field(
        app, command.options, "--keep-edges",
        "keep edges sharper than this angle between faces, in degrees, and their corners; 20 to 40 suit most meshes\n"
        "The surface between them is smoothed; --time-step-edges 32 suits most noise. On the whole mesh.");
    auto* edges =
        app.add_option("--edges", command.edges,
                       "further edges to keep: two vertex numbers per line, from 0, or an .obj or .ply "
                       "with them\n"
                       "They are kept whatever their angle. An .obj has polylines, a .ply elements edge. With "
                       "--keep-edges or --preset cad.")
            ->type_name("FILE");
    app.add_flag("--edges-from-file", command.edges_from_file, "keep the polylines (.obj) or edges (.ply) of INPUT")
        ->excludes(edges);
}

/// Where vertices move, and along which lines.
void add_region(CLI::App& app, SmoothCommand& command)
{
    auto* region =
        app.add_option("--region", command.region,
                       "smooth only there: vertex numbers from 0, one a line, or a .ply that has the strength of each\n"
                       "The strength, from 0 to 1, scales the time step at its vertex; 0 holds it. A name that is no "
                       "file is that of a property of INPUT, a .ply. Not for sweeps.")
            ->type_name("FILE|PROPERTY");
    app.add_option("--region-property", command.region_property,
                   "the name of the property of the .ply with the strength [region]")
        ->needs(region)
        ->type_name("NAME");
    add_length(app, "--feather", command.feather,
               "the strength of the region rises from 0 at its rim over this distance, so that no crease appears\n"
               "The boundary of the surface is no rim.");
    add_parsed(app, "--direction", command.options.motion.direction, parse_direction, "x|y|z|normal|X,Y,Z",
               "vertices move along this direction only; with z, x and y of a terrain stay bit for bit\n"
               "normal is that of each vertex before the step.");
}

void add_what_stays(CLI::App& app, SmoothCommand& command)
{
    app.option_defaults()->group(option_group::kept);
    FlowOptions& options = command.options;
    add_feature_edges(app, command);
    add_field(app, options, "--boundary",
              "boundary conditions: the boundary of an open surface stays, or shrinks freely [fixed]");
    add_field(app, options, "--junctions",
              "edges of three faces or more, where sheets meet: they move with all sheets, or stay [flow]");
    auto* fix = app.add_option("--fix", command.fix,
                               "fixed vertices: their numbers from 0, one a line, or a .ply that marks them\n"
                               "The .ply has as many vertices, and a property that is not 0 at fixed ones.")
                    ->type_name("FILE");
    app.add_option("--fix-property", command.fix_property, "the name of the property that marks them [fixed]")
        ->needs(fix)
        ->type_name("NAME");
    auto* attach = add_length(app, "--attach", command.attach,
                              "pull every vertex towards where it was: features larger than this stay");
    auto* weights =
        app.add_option("--attach-weights", command.attach_weights,
                       "how strongly each vertex is pulled back, in 1/length²: one number per line, or a .ply\n"
                       "The .ply has as many vertices, and a property with the weight.")
            ->excludes(attach)
            ->type_name("FILE");
    app.add_option("--attach-property", command.attach_property, "the name of the property with the weight [weight]")
        ->needs(weights)
        ->type_name("NAME");
    add_region(app, command);
    const auto parse = [](const std::string& text) -> std::optional<LengthOnMesh> {
        try {
            return text == "never" ? std::nullopt : std::optional(parse_length(text));
        } catch (const OptionError& error) {
            throw OptionError(std::string(error.what()) + ", nor never");
        }
    };
    add_parsed(app, "--weld", command.weld, parse, "never|LENGTH",
               "copies of vertices along seams, at most this far apart, move as one [at equal places]\n"
               "A seam is where edges of one face each coincide, for example along those of a texture.");
    add_field(app, options, "--strict",
              "refuse meshes that are not manifold or have edges or faces of size 0\n"
              "Without it, such vertices stay fixed, and unusable faces are left out.");
}

void add_accuracy(CLI::App& app, FlowOptions& options)
{
    app.option_defaults()->group(option_group::accuracy);
    add_converge(app, options,
                 "converge to the undecomposed step, to this relative residual; never: one sweep a step [auto]\n"
                 "auto: to a loose tolerance where --approach needs one or sweeps would drift, unless another option "
                 "concerns sweeps.");
    add_field(app, options, "--converge-iterations", "largest number of iterations of a converged step [1000]");
    add_field(app, options, "--approach",
              "the solver [auto: the fastest]\n"
              "sweep: one sweep over the sub-meshes; converged: sub-meshes converge to the undecomposed step; "
              "decomposed: one of the two; cg: conjugate gradients on the whole mesh, with hardly any set-up; "
              "undecomposed: one factorisation of the whole mesh; auto: the fastest, in sub-meshes if another option "
              "concerns them.");
    add_field(app, options, "--tune-for",
              "the number of cores for which --approach auto is the fastest [2]\n"
              "It is not that of the machine, so that the result is the same on all of them.");
    add_field(app, options, "--precision",
              "precision of the factorisations of converged steps [auto]\n"
              "Steps are refined to the tolerance in any case. auto: single where that loses few digits.");
    add_field(app, options, "--factorisation",
              "the direct solver of sub-meshes [auto: the fastest]\n"
              "cholmod: UMFPACK where they are not symmetric. With either, symmetric Laplacians take sweeps.");
    add_field(app, options, "--scheme",
              "backward or explicit Euler steps [implicit]\n"
              "Explicit steps are undecomposed, and stable for small time steps only.");
}

/// Options only for the derivatives of the paper, which they therefore select.
void add_parameters(CLI::App& app, FlowOptions& options)
{
    std::vector<CLI::Option*> of_derivatives;
    of_derivatives.push_back(add_field(app, options, "--p", "Robin parameter, in 1/length [p* of each sub-mesh]"));
    of_derivatives.push_back(add_field(app, options, "--p-rule", "η in p*: 1 or 1/dt [paper]"));
    of_derivatives.push_back(
        add_field(app, options, "--p-edge",
                  "edge in p*: the shortest, the 5th percentile, or the mean [auto; with --paper min]\n"
                  "auto: the shortest unless it is a sliver's, then the percentile."));
    add_field(app, options, "--q", "Ventcell parameter, for adapted-ventcell and ventcell");
    app.callback([of_derivatives, &app, &interface = options.interface] {
        for (const CLI::Option* option : of_derivatives) {
            if (option->count() == 0)
                continue;
            if (app.count("--transmission") > 0 && interface.transmission == Transmission::Predicted)
                throw OptionError(option->get_name() +
                                  " is for the derivatives of the paper; --transmission predicted has none");
            interface.transmission = Transmission::Derivative;
        }
    });
}

void add_sub_meshes(CLI::App& app, SmoothCommand& command)
{
    app.option_defaults()->group(option_group::sub_meshes);
    FlowOptions& options = command.options;
    auto* subdomains = add_field(app, options, "--subdomains", "number of sub-meshes; 1: undecomposed, 0: chosen [0]");
    app.add_option("--labels", command.labels, "file with the sub-mesh of every face, one a line")
        ->excludes(subdomains)
        ->type_name("FILE");
    add_field(app, options, "--conditions", "conditions between sub-meshes [adapted-robin]");
    add_field(app, options, "--coloring",
              "colouring of the sub-meshes, which sets the order in which they solve [greedy]");
    add_field(app, options, "--sweep",
              "order of the colours from step to step [fixed for two sub-meshes, else alternating]");
    add_field(app, options, "--transmission",
              "how the first sub-mesh at the interface takes account of the others [predicted]");
    add_parameters(app, options);
    add_field(app, options, "--overlap", "layers of faces by which sub-meshes overlap with schwarz [1]");
    app.add_flag_callback(
        "--no-correction", [&options] { options.interface.correction = Correction::None; },
        "do not correct the vertices of the interface after a step");
    add_field(app, options, "--keep-gaps",
              "write the sub-meshes separately, each with its own copy of the interface; for robin and ventcell");
}

void add_machine(CLI::App& app, FlowOptions& options)
{
    app.option_defaults()->group(option_group::machine);
    add_field(app, options, "--threads",
              "number of threads, at most 1024; 0: all cores that the control group allows [0]");
    add_field(
        app, options, "--memory-limit",
        "limit for all factorisations at any time: 500M, 2GiB [as much as is fast]\n"
        "In bytes or with K, M, G, T, KiB, MiB, GiB, TiB. Converged steps recompute the factors that they cannot keep; "
        "what still does not fit is solved by conjugate gradients, which factorise nothing, unless another option asks "
        "for sub-meshes. By default sweeps take as little as keeps all threads busy, and converged steps have no "
        "limit.");
}

void add_what_is_printed(CLI::App& app, SmoothCommand& command)
{
    auto* quiet = app.add_flag("--quiet", command.quiet, "print nothing but errors");
    app.add_flag("--verbose", command.verbose, "also print each step, the cut, and the time in tasks")->excludes(quiet);
}

/// Options for flows that take long.
void add_checkpoints(CLI::App& app, SmoothCommand& command)
{
    auto* checkpoint =
        app.add_option("--checkpoint", command.checkpoint,
                       "save there all that the run needs to resume after its last complete step\n"
                       "The same command then resumes, with the same result. The folder remains at the end, so that "
                       "more --steps can follow.")
            ->type_name("FOLDER");
    add_parsed(app, "--checkpoint-every", command.checkpoint_period, parse_checkpoint_period, "STEPS|TIME",
               "how often, in steps (10) or time (30s, 5min, 1h), and at the end [at most a tenth of the time]")
        ->needs(checkpoint);
}

}  // namespace

void add_flow_options(CLI::App& app, SmoothCommand& command)
{
    FlowOptions& options = command.options;
    // First, so that the others refine it.
    app.option_defaults()->group(option_group::sub_meshes);
    app.add_flag_callback(
        "--paper,--plain", [&options] { options = FlowOptions::plain(); },
        "the paper's method for any number of sub-meshes: a fixed sweep, derivatives at the old positions");
    add_amount(app, command);
    add_kind(app, command);
    add_what_stays(app, command);
    add_sub_meshes(app, command);
    add_accuracy(app, options);
    add_machine(app, options);
    app.option_defaults()->group(option_group::written);
    add_field(app, options, "--reference", "also run the undecomposed flow, and print the distances to it (V_ and H_)");
    app.add_flag("--self-intersections", command.self_intersections,
                 "count the pairs of faces that cross each other, before and after; implied by --report");
}

void add_files(CLI::App& app, SmoothCommand& command, std::string& every_step)
{
    app.option_defaults()->group(option_group::written);
    app.add_option("INPUT", command.input,
                   "mesh: " + extensions_of() + ", optionally followed by .gz; - for standard input")
        ->required()
        ->type_name("");
    app.add_option("OUTPUT", command.output, "smoothed mesh; - for standard output")->required()->type_name("");
    app.add_option("--out-dir", command.out_dir,
                   "several files whose borders coincide are one surface: smooth INPUT… --out-dir FOLDER\n"
                   "One file at a time is in memory. The results have the names of the inputs, and equal borders. "
                   "--weld says how far apart borders may be. The same command resumes where it was stopped.")
        ->type_name("FOLDER");
    app.add_option("--report", command.report,
                   "the report: times, sizes and distances, or the reason of a failure; - for standard output")
        ->type_name("REPORT.json");
    app.add_option("--csv", command.csv, "the values of every step, one step a row")->type_name("STEPS.csv");
    app.add_option("--html", command.html, "a page for the browser with the surface step by step, and plots")
        ->type_name("PAGE.html");
    app.add_option("--every-step", every_step, "also write the mesh after every step; %d is its number")
        ->type_name("PATTERN");
    app.add_option("--parts", command.parts, "the cut: faces with colours and labels")->type_name("PARTS.ply");
    app.add_option("--trace", command.trace, "which task ran when in which thread, for ui.perfetto.dev")
        ->type_name("TRACE.json");
    app.add_option("--task-graph", command.task_graph, "the tasks of a step and their dependencies, for Graphviz")
        ->type_name("GRAPH.dot");
    add_checkpoints(app, command);
    add_what_is_printed(app, command);
}

std::string smooth_examples()
{
    return "smooth scan.obj smooth.obj                             the noise goes, edges and details stay\n"
           "smooth scan.ply smooth.ply --radius 1% --within 0.2    bumps up to 1 % of the size; no vertex goes further "
           "than 0.2\n"
           "smooth part.stl smooth.stl --keep-edges 30             sharp edges and flat faces stay\n";
}

}  // namespace seamflow
