#include "samples/command/smooth_options.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/options/option_table.h"
#include "samples/command/command_line.h"

namespace seamflow {

namespace {

struct Entry {
    RequestOption option;
    /// An option without which it is refused.
    const char* needs = "";
    /// What several words are added to, in place of a reader; null for all options that take one.
    std::vector<std::string>* words = nullptr;
};

/// Pairs that are refused together, besides those of requests.
constexpr std::pair<const char*, const char*> exclusions[] = {
    {"--edges-from-file", "--edges"}, {"--from", "--fields"}, {"--verbose", "--quiet"}};

/// An option that stores its value.
template <class Value>
TextReader to(Value& value, const Limits& limits = {})
{
    return reader_of(value, limits);
}

/// A file or a folder with another placeholder.
TextReader to(std::filesystem::path& value, std::string type)
{
    TextReader reader = reader_of(value, {});
    reader.type = std::move(type);
    return reader;
}

/// A file with data for the mesh.
TextReader to(DataFile& value, std::string type = "FILE")
{
    return reader_by(
        value, [](const std::string& text) { return DataFile(text); }, std::move(type));
}

/// The options of programs, in the order of --help within each group.
class Entries {
  public:
    explicit Entries(SmoothCommand& command)
        : command_(command)
    {
        add_of_request();
        add_about_request();
        add_fields();
        add_results();
        add_of_run();
    }

    [[nodiscard]] const std::vector<Entry>& list() const { return list_; }

  private:
    void add(const OptionTraits& traits, TextReader reader, const char* needs = "")
    {
        list_.push_back({{traits, "", std::move(reader)}, needs});
    }

    /// Behind another one.
    void add_behind(std::string_view other, const OptionTraits& traits, TextReader reader, const char* needs = "")
    {
        list_.insert(find(other) + 1, {{traits, "", std::move(reader)}, needs});
    }

    std::vector<Entry>::iterator find(std::string_view option)
    {
        return std::ranges::find(list_, option, [](const Entry& entry) { return entry.option.traits.option; });
    }

    void add_of_request();
    void add_about_request();
    void add_fields();
    void add_results();
    void add_of_run();

    SmoothCommand& command_;
    std::vector<Entry> list_;
};

/// Numbers of vertices, edges and faces are in files.
void Entries::add_of_request()
{
    SmoothCommand& c = command_;
    for (RequestOption& option : request_options(c))
        list_.push_back({std::move(option)});
    find("--edges")->option.reader = to(c.edges);
    find("--fix")->option.reader = to(c.fix);
    find("--attach-weights")->option.reader = to(c.attach_weights);
    find("--region")->option.reader = to(c.region, "FILE|PROPERTY");
    find("--labels")->option.reader = to(c.labels);
}

void Entries::add_about_request()
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
}

void Entries::add_fields()
{
    using namespace concern;
    FieldRequest& fields = command_.fields;
    add({"", "--fields", option_group::fields, files,
         "smooth these numbers of the vertices instead of the surface, which stays\n"
         "Properties of PLY files; red, green and blue of OBJ and OFF files; normal, colour. They diffuse by the heat "
         "equation on the surface, with --fwhm, --radius or --time-step. NaN is no data: such vertices take no part."},
        {});
    list_.back().words = &fields.names;
    add({"", "--fwhm", option_group::fields, files | amount,
         "full width at half maximum of the smoothing, over all steps together; 10 steps unless told otherwise"},
        to(fields.options.fwhm), "--fields");
    add({"", "--fill", option_group::fields, files, "give vertices without data the harmonic extension of the others"},
        to(fields.options.fill), "--fields");
    add({"", "--keep-field-edges", option_group::fields, files,
         "differences of fields well above this stay (Perona and Malik)"},
        to(fields.options.keep_edges, positive()), "--fields");
    add({"", "--from", option_group::fields, files,
         "write geodesic distances from vertices as the field distance; the surface stays\n"
         "Their numbers from 0, one a line. By the heat method; NaN where the surface does not lead."},
        to(fields.from));
}

void Entries::add_results()
{
    using namespace concern;
    SmoothCommand& c = command_;
    const auto add_result = [&](const char* option, unsigned concerns, const char* text, TextReader reader) {
        add({"", option, option_group::written, files | concerns, text}, std::move(reader));
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
               reader_by(c.every_step, parse_pattern, "PATTERN"));
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
        reader_by(c.checkpoint_period, parse_checkpoint_period, "STEPS|TIME"), "--checkpoint");
    add({"", "--quiet", option_group::written, files, "print nothing but errors"}, to(c.quiet));
    add({"", "--verbose", option_group::written, files, "also print each step, the cut, and the time in tasks"},
        to(c.verbose));
}

}  // namespace

void add_options(CLI::App& app, SmoothCommand& command)
{
    const Entries entries(command);
    for (const Entry& entry : entries.list()) {
        const OptionTraits& traits = entry.option.traits;
        const std::string names = entry.option.names.empty() ? std::string(traits.option) : entry.option.names;
        app.option_defaults()->group(std::string(traits.group));
        if (entry.words != nullptr)
            app.add_option(names, *entry.words, std::string(traits.text))->delimiter(',')->type_name("NAME,…");
        else
            add_reader(app, names, entry.option.reader, std::string(traits.text));
    }
    for (const Entry& entry : entries.list())
        if (*entry.needs != '\0')
            app.get_option(std::string(entry.option.traits.option))->needs(app.get_option(entry.needs));
    for (const auto& [one, other] : exclusions)
        app.get_option(one)->excludes(app.get_option(other));
    for (const auto& [one, other] : exclusions_of_requests())
        app.get_option(std::string(one))->excludes(app.get_option(std::string(other)));
}

std::span<const OptionTraits> smooth_options()
{
    static const std::vector<OptionTraits> list = [] {
        SmoothCommand command;
        const Entries entries(command);
        std::vector<OptionTraits> traits;
        for (const Entry& entry : entries.list())
            traits.push_back(entry.option.traits);
        return traits;
    }();
    return list;
}

std::vector<OptionTraits> given_options(const CLI::App& app)
{
    std::vector<OptionTraits> given;
    for (const OptionTraits& one : smooth_options())
        if (app.count(std::string(one.option)) > 0)
            given.push_back(one);
    return given;
}

std::string smooth_examples()
{
    return "smooth scan.obj smooth.obj                             the noise goes, edges and details stay\n"
           "smooth scan.ply smooth.ply --radius 1% --within 0.2    bumps up to 1 % of the size; no vertex goes further "
           "than 0.2\n"
           "smooth part.stl smooth.stl --keep-edges 30             sharp edges and flat faces stay\n";
}

}  // namespace seamflow
