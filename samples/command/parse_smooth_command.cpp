#include "samples/command/parse_smooth_command.h"

#include <array>
#include <iostream>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "engine/options/option_rule.h"
#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "partition/io/input_file.h"
#include "samples/command/command_line.h"
#include "samples/command/field_options.h"
#include "samples/command/smooth_options.h"
#include "samples/command/tile_options.h"
#include "samples/files/output_files.h"
#include "samples/page/page_html.h"

namespace seamflow {

namespace {

/// Properties are those of a .ply file.
void require_ply_with_properties(const SmoothCommand& command)
{
    const auto require = [&](std::string_view option, const DataFile& file, std::string_view text) {
        if (is_given(command, option) && file.format() != FileFormat::Ply)
            refuse(filling(command.options)(text, unmarked(file.path().string()).text));
    };
    require("--fix-property", command.fix, "--fix-property is for a .ply file; {other} has vertex numbers");
    require("--region-property", command.region,
            "--region-property is for a .ply file; {other} has vertex numbers, or is a property itself");
    require("--attach-property", command.attach_weights,
            "--attach-property is for a .ply file; {other} has one number per line");
}

/// Requires results in known formats.
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

/// @returns the file with the region, if it is one; empty: it is a property of INPUT.
std::filesystem::path region_file(const SmoothCommand& command)
{
    std::error_code ignored;
    const std::filesystem::path& region = command.region.path();
    if (region.empty() || std::filesystem::exists(region, ignored))
        return region;
    if (is_input_stream(command.input) || format_of(command.input) != FileFormat::Ply)
        throw OptionError(fmt::format("--region {}: there is no such file, and INPUT is no .ply file with properties: "
                                      "name a file",
                                      region.string()));
    return {};
}

/// INPUT has the edges that --edges-from-file asks for, and the region where that is no file but a property.
void take_data_of_input(SmoothCommand& command)
{
    if (command.edges_from_file)
        command.edges = command.input;
    if (command.region.empty() || !region_file(command).empty())
        return;
    command.region_property = command.region.path().string();
    command.region = command.input;
}

/// See SmoothCommand::messages.
std::ostream& message_stream(const SmoothCommand& command)
{
    static std::ostream silence(nullptr);
    const bool is_taken = is_standard_stream(command.output) || is_standard_stream(command.report);
    return command.quiet ? silence : is_taken ? std::cerr : std::cout;
}

constexpr OptionRule<SmoothCommand> rules_of_files[]{
    {[](const SmoothCommand& c, const AskedOptions&) { return c.every_step && c.options.steps > 100'000; }, 0,
     "--every-step writes at most 100000 files: give fewer --steps"},
    {[](const SmoothCommand& c, const AskedOptions&) {
         return is_standard_stream(c.report) && is_standard_stream(c.output);
     },
     0, "OUTPUT and --report are both -: name a file for one of them"},
    {[](const SmoothCommand& c, const AskedOptions&) { return c.edges_from_file && is_input_stream(c.input); }, 0,
     "--edges-from-file reads INPUT a second time: name a file instead of -"},
};

/// Also keeps every result except OUTPUT from replacing one of the inputs.
void require_usable_files(const SmoothCommand& command)
{
    require_none_broken<SmoothCommand>(rules_of_files, command, {}, filling(command.options));
    std::vector<std::filesystem::path> results;
    for (int step = 1; command.every_step && step <= command.options.steps; ++step)
        results.push_back(command.every_step->path(step));
    for (const auto& path : {command.csv, command.parts, command.trace, command.task_graph, command.html})
        if (!path.empty())
            results.push_back(path);
    require_files(results);
    if (!command.report.empty() && !is_standard_stream(command.report))
        results.push_back(command.report);
    const std::vector<std::filesystem::path> further{command.labels,
                                                     command.fix.path(),
                                                     command.edges.path(),
                                                     command.attach_weights.path(),
                                                     command.fields.from.path(),
                                                     region_file(command)};
    require_files(further);
    std::vector<std::filesystem::path> inputs = further;
    inputs.push_back(command.input);
    for (const auto& input : inputs) {
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

}  // namespace

std::optional<ExitStatus> parse_smooth_command(int argc, char** argv, SmoothCommand& command,
                                               const SmoothProgram& program)
{
    CLI::App app(program.description, program.name);
    app.add_option("INPUT", command.input,
                   "mesh: " + extensions_of() + ", optionally followed by .gz; - for standard input")
        ->required()
        ->type_name("");
    app.add_option("OUTPUT", command.output, "smoothed mesh; - for standard output")->required()->type_name("");
    add_options(app, command);
    if (names_tiles({argv, static_cast<std::size_t>(argc)}))
        take_tiles(app, command);
    app.footer(program.examples.empty() ? smooth_examples() : program.examples);
    if (!program.approaches.empty())
        app.get_option("--approach")->description(program.approaches);
    static constexpr std::array<std::string_view, 12> common{"--radius",     "--within",   "--preset", "--rounded",
                                                             "--keep-edges", "--boundary", "--fix",    "--region",
                                                             "--direction",  "--report",   "--html",   "--threads"};
    if (const auto end = parse_command_line(app, argc, argv, common))
        return end;
    command.program = program.name;
    command.arguments.assign(argv + 1, argv + argc);
    command.given = given_options(app);
    if (command.fields.exists())
        require_fields(command);
    if (!command.out_dir.empty())
        require_tiles(command);
    settle(command);
    require_ply_with_properties(command);
    if (!command.out_dir.empty()) {
        command.options.report.measures = false;
        return std::nullopt;
    }
    // Only if they are shown.
    command.options.report.measures = command.verbose || !command.report.empty() || !command.csv.empty() ||
                                      !command.html.empty() || !command.checkpoint.empty();
    command.self_intersections = command.self_intersections || !command.report.empty();
    command.options.report.record_schedule = !command.trace.empty() || !command.task_graph.empty();
    require_usable_results(command);
    require_usable_files(command);
    take_data_of_input(command);
    command.messages = &message_stream(command);
    return std::nullopt;
}

}  // namespace seamflow
