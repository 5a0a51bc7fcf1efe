#include "samples/command/smooth_options.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/options/option_rules.h"
#include "engine/options/option_table.h"
#include "engine/setup/presets.h"
#include "partition/errors.h"
#include "samples/command/command_line.h"
#include "samples/command/flow_choices.h"
#include "samples/process/option_words.h"

namespace seamflow {

namespace {

using Add = std::function<CLI::Option*(CLI::App& app, const OptionTraits& traits)>;

struct Entry {
    OptionTraits traits;
    Add add;
    /// An option without which it is refused.
    const char* needs = "";
};

/// Pairs that are refused together.
constexpr std::pair<const char*, const char*> exclusions[] = {{"--labels", "--subdomains"},
                                                              {"--edges-from-file", "--edges"},
                                                              {"--attach-weights", "--attach"},
                                                              {"--from", "--fields"},
                                                              {"--verbose", "--quiet"}};

/// "scan: what it is for (--steps 3)", one preset per line.
std::string describe_presets()
{
    std::string text = "options for a kind of mesh [automatic if no amount is given]\n"
                       "Without an amount, options about equations choose scan, and edges choose cad. Options on the "
                       "command line override those of the preset.";
    const FlowOptions defaults;
    for (const PresetTraits& preset : all_presets()) {
        text += fmt::format("\n{}: {} (", preset.name, preset.purpose);
        const PresetSettings settings = apply_preset(preset, defaults, changed_options(defaults));
        for (const PresetSetting& one : settings.chosen)
            text += option_of_program(one.option, one.value) + " ";
        text += (preset.denoise            ? "and what the noise of each place asks for"
                 : preset.measures_noise() ? "and what the noise asks for"
                                           : option_of_program(settings.amount->option, settings.amount->value)) +
                ")";
    }
    return text;
}

/// An option that stores its value.
template <class Value>
Add to(Value& value, std::string type = {})
{
    return [&value, type = std::move(type)](CLI::App& app, const OptionTraits& traits) {
        CLI::Option* const option = add_value(app, traits, value);
        return type.empty() ? option : option->type_name(type);
    };
}

/// One whose text is read by parse(text).
template <class Value, class Parse>
Add to(Value& value, Parse parse, std::string type)
{
    return [&value, parse, type = std::move(type)](CLI::App& app, const OptionTraits& traits) {
        return add_parsed(app, std::string(traits.option), value, parse, type, std::string(traits.text));
    };
}

/// A flag that calls action().
template <class Action>
Add flag(std::string names, Action action)
{
    return [names = std::move(names), action](CLI::App& app, const OptionTraits& traits) {
        return app.add_flag_callback(names, action, std::string(traits.text));
    };
}

std::optional<LengthOnMesh> parse_weld(const std::string& text)
{
    try {
        return text == "never" ? std::nullopt : std::optional(parse_length(text));
    } catch (const OptionError& error) {
        throw OptionError(std::string(error.what()) + ", nor never");
    }
}

/// The fields whose values need more than a text: a mesh, a file, or another field.
std::map<std::string_view, Add> fields_of_command(SmoothCommand& command)
{
    AllOptions& options = command.options;
    const auto converge = [&options](CLI::App& app, const OptionTraits& traits) {
        return add_converge(app, options, std::string(traits.text));
    };
    // Those that this build lacks are refused with the reason, by require_valid.
    const auto factorisation = [&options](CLI::App& app, const OptionTraits& traits) {
        CLI::Option* const option = add_value(app, traits, options.resources.factorisation);
        return gpl_parts().empty() ? option->type_name("auto|own") : option;
    };
    return {{"feature_edges", to(command.edges)},
            {"fixed_vertices", to(command.fix)},
            {"attachment", to(options.motion.attachment_radius)},
            {"attachment_weights", to(command.attach_weights)},
            {"strength", to(command.region, "FILE|PROPERTY")},
            {"direction", to(options.motion.direction, parse_direction, "x|y|z|normal|X,Y,Z")},
            {"boundary", to(command.boundary)},
            {"weld", to(options.motion.weld, parse_weld, "never|LENGTH")},
            {"labels", to(command.labels)},
            {"tolerance", converge},
            {"factorisation", factorisation},
            {"correction", flag("--no-correction", [&options] { options.interface.correction = Correction::None; })}};
}

/// The options of programs, in the order of --help within each group.
class Entries {
  public:
    explicit Entries(SmoothCommand& command)
        : command_(command)
    {
        add_of_flow();
        add_about_flow();
        add_fields();
        add_results();
        add_of_run();
    }

    [[nodiscard]] const std::vector<Entry>& list() const { return list_; }

  private:
    void add(const OptionTraits& traits, Add how, const char* needs = "")
    {
        list_.push_back({traits, std::move(how), needs});
    }

    /// Behind another one.
    void add_behind(std::string_view other, const OptionTraits& traits, Add how, const char* needs = "")
    {
        const auto place = std::ranges::find(list_, other, [](const Entry& entry) { return entry.traits.option; });
        list_.insert(place + 1, {traits, std::move(how), needs});
    }

    void add_of_flow();
    void add_about_flow();
    void add_fields();
    void add_results();
    void add_of_run();

    SmoothCommand& command_;
    std::vector<Entry> list_;
};

void Entries::add_of_flow()
{
    using namespace concern;
    SmoothCommand& c = command_;
    static const std::string presets = describe_presets();
    std::vector<std::pair<std::string, std::string>> names;
    for (const PresetTraits& preset : all_presets())
        names.emplace_back(preset.name, preset.name);
    // First, so that the others refine it.
    add({"", "--paper", option_group::sub_meshes, sweeps | method,
         "the paper's method for any number of sub-meshes: a fixed sweep, derivatives at the old positions"},
        flag("--paper,--plain", [&options = c.options] { options = FlowOptions::plain(); }));
    add({"", "--noise", option_group::amount, motion | equation | whole_surface,
         "noise that is the same everywhere, on rounded shapes: sharp edges lose by it [measured at each place]\n"
         "The standard deviation along the normals. A preset derives the amount of its equation from it."},
        to(c.noise));
    add({"", "--preset", option_group::kind, motion | whole_surface, presets},
        [&preset = c.preset, names](CLI::App& app, const OptionTraits& traits) {
            return add_choice(app, "--preset", preset, names, std::string(traits.text));
        });
    const std::map<std::string_view, Add> other = fields_of_command(c);
    for_each_option(static_cast<FlowOptions&>(c.options), [&](const auto& row) {
        if (row.field == "feature_edges")
            add(row_of_keep_edges, to(c.options.keep_edges));
        if (const auto found = other.find(row.field); found != other.end())
            add(row, found->second);
        else if constexpr (IsReadable<std::remove_reference_t<decltype(*row.value)>>)
            if (!row.option.empty())
                add(row, to(*row.value));
    });
}

void Entries::add_about_flow()
{
    using namespace concern;
    SmoothCommand& c = command_;
    add_behind("--edges",
               {"", "--edges-from-file", option_group::kept, motion | numbers,
                "keep the polylines (.obj) or edges (.ply) of INPUT"},
               to(c.edges_from_file));
    add_behind("--fix",
               {"", "--fix-property", option_group::kept, numbers, "the name of the property that marks them [fixed]"},
               to(c.fix_property), "--fix");
    add_behind(
        "--attach-weights",
        {"", "--attach-property", option_group::kept, numbers, "the name of the property with the weight [weight]"},
        to(c.attach_property), "--attach-weights");
    add_behind("--region",
               {"", "--region-property", option_group::kept, motion | numbers,
                "the name of the property of the .ply with the strength [region]"},
               to(c.region_property), "--region");
    add({"", "--self-intersections", option_group::written, motion | whole_surface,
         "count the pairs of faces that cross each other, before and after; implied by --report"},
        to(c.self_intersections));
}

void Entries::add_fields()
{
    using namespace concern;
    FieldRequest& fields = command_.fields;
    add({"", "--fields", option_group::fields, files,
         "smooth these numbers of the vertices instead of the surface, which stays\n"
         "Properties of PLY files; red, green and blue of OBJ and OFF files; normal, colour. They diffuse by the heat "
         "equation on the surface, with --fwhm, --radius or --time-step. NaN is no data: such vertices take no part."},
        to(fields.names));
    add({"", "--fwhm", option_group::fields, files | amount,
         "full width at half maximum of the smoothing, over all steps together; 10 steps unless told otherwise"},
        to(fields.fwhm), "--fields");
    add({"", "--fill", option_group::fields, files, "give vertices without data the harmonic extension of the others"},
        to(fields.options.fill), "--fields");
    add({"", "--keep-field-edges", option_group::fields, files,
         "differences of fields well above this stay (Perona and Malik)", positive()},
        to(fields.options.keep_edges), "--fields");
    add({"", "--from", option_group::fields, files,
         "write geodesic distances from vertices as the field distance; the surface stays\n"
         "Their numbers from 0, one a line. By the heat method; NaN where the surface does not lead."},
        to(fields.from));
}

void Entries::add_results()
{
    using namespace concern;
    SmoothCommand& c = command_;
    const auto add_result = [&](const char* option, unsigned concerns, const char* text, Add how) {
        add({"", option, option_group::written, files | concerns, text}, std::move(how));
    };
    const auto parse_pattern = [](const std::string& text) { return std::optional(StepPattern(text)); };
    add_result("--out-dir", 0,
               "several files whose borders coincide are one surface: smooth INPUT… --out-dir FOLDER\n"
               "One file at a time is in memory. The results have the names of the inputs, and equal borders. --weld "
               "says how far apart borders may be. The same command resumes where it was stopped.",
               to(c.out_dir, "FOLDER"));
    add_result("--report", one_mesh,
               "the report: times, sizes and distances, or the reason of a failure; - for standard output",
               to(c.report, "REPORT.json"));
    add_result("--csv", motion | one_mesh, "the values of every step, one step a row", to(c.csv, "STEPS.csv"));
    add_result("--html", one_mesh, "a page for the browser with the surface step by step, and plots",
               to(c.html, "PAGE.html"));
    add_result("--every-step", motion | one_mesh, "also write the mesh after every step; %d is its number",
               to(c.every_step, parse_pattern, "PATTERN"));
    add_result("--parts", sub_meshes | motion | one_mesh, "the cut: faces with colours and labels",
               to(c.parts, "PARTS.ply"));
    add_result("--trace", sub_meshes | motion | one_mesh, "which task ran when in which thread, for ui.perfetto.dev",
               to(c.trace, "TRACE.json"));
    add_result("--task-graph", sub_meshes | motion | one_mesh,
               "the tasks of a step and their dependencies, for Graphviz", to(c.task_graph, "GRAPH.dot"));
}

void Entries::add_of_run()
{
    using namespace concern;
    SmoothCommand& c = command_;
    add({"", "--checkpoint", option_group::written, files | motion,
         "save there all that the run needs to resume after its last complete step\n"
         "The same command then resumes, with the same result. The folder remains at the end, so that more --steps can "
         "follow."},
        to(c.checkpoint, "FOLDER"));
    add({"", "--checkpoint-every", option_group::written, files,
         "how often, in steps (10) or time (30s, 5min, 1h), and at the end [at most a tenth of the time]"},
        to(c.checkpoint_period, parse_checkpoint_period, "STEPS|TIME"), "--checkpoint");
    add({"", "--quiet", option_group::written, files, "print nothing but errors"}, to(c.quiet));
    add({"", "--verbose", option_group::written, files, "also print each step, the cut, and the time in tasks"},
        to(c.verbose));
}

}  // namespace

void add_options(CLI::App& app, SmoothCommand& command)
{
    const Entries entries(command);
    for (const Entry& entry : entries.list()) {
        app.option_defaults()->group(std::string(entry.traits.group));
        entry.add(app, entry.traits);
    }
    for (const Entry& entry : entries.list())
        if (*entry.needs != '\0')
            app.get_option(std::string(entry.traits.option))->needs(app.get_option(entry.needs));
    for (const auto& [one, other] : exclusions)
        app.get_option(one)->excludes(app.get_option(other));
}

std::span<const OptionTraits> smooth_options()
{
    static const std::vector<OptionTraits> list = [] {
        SmoothCommand command;
        const Entries entries(command);
        std::vector<OptionTraits> traits;
        for (const Entry& entry : entries.list())
            traits.push_back(entry.traits);
        return traits;
    }();
    return list;
}

std::string first_given(const CLI::App& app, std::initializer_list<std::string_view> names)
{
    for (const std::string_view name : names)
        if (app.count(std::string(name)) > 0)
            return std::string(name);
    return {};
}

std::string first_given(const CLI::App& app, unsigned concerns)
{
    for (const OptionTraits& one : smooth_options())
        if ((one.concerns & concerns) != 0 && app.count(std::string(one.option)) > 0)
            return std::string(one.option);
    return {};
}

AskedOptions given_options(const CLI::App& app, const SmoothCommand& command)
{
    const auto has = [&](std::string_view option) {
        const std::string name = option_of_program(option, "");
        return (app.get_option_no_throw(name) != nullptr && app.count(name) > 0) ||
               (option == "feature_edges" && command.edges_from_file) ||
               (option == "attachment" && command.options.motion.attachment_radius) ||
               changed_options(command.options).has(option);
    };
    const auto first = [&](unsigned concerns) {
        for (const OptionTraits& one : smooth_options())
            if ((one.concerns & concerns) != 0 && app.count(std::string(one.option)) > 0)
                return std::string(one.field.empty() ? one.option : one.field);
        return std::string();
    };
    return {has, first};
}

std::string smooth_examples()
{
    return "smooth scan.obj smooth.obj                             the noise goes, edges and details stay\n"
           "smooth scan.ply smooth.ply --radius 1% --within 0.2    bumps up to 1 % of the size; no vertex goes further "
           "than 0.2\n"
           "smooth part.stl smooth.stl --keep-edges 30             sharp edges and flat faces stay\n";
}

}  // namespace seamflow
