#include "samples/figures/figures_command.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "partition/errors.h"
#include "samples/command/command_line.h"
#include "samples/figures/experiment.h"
#include "samples/figures/experiments.h"
#include "samples/files/output_files.h"
#include "samples/page/page_html.h"

namespace seamflow {

namespace {

std::vector<std::string> all_names()
{
    std::vector<std::string> names;
    for (const Experiment& experiment : experiments())
        names.emplace_back(experiment.name);
    names.emplace_back(many_sub_meshes);
    return names;
}

std::string listed_names()
{
    std::string text;
    for (const Experiment& experiment : experiments())
        text += std::string(experiment.name) + " (" + std::to_string(experiment.figure) + "), ";
    return text.append(many_sub_meshes);
}

/// The name of a figure that may be given by its number in the paper.
/// @throws OptionError if there is no such figure.
std::string name_of_figure(const std::string& text)
{
    for (const Experiment& experiment : experiments())
        if (text == std::to_string(experiment.figure))
            return std::string(experiment.name);
    const std::vector<std::string> known = all_names();
    if (std::find(known.begin(), known.end(), text) == known.end())
        throw OptionError("no figure is called \"" + text + "\"; there are " + listed_names());
    return text;
}

void require_folders(const FiguresCommand& command)
{
    std::error_code error;
    if (!command.meshes.empty() && !std::filesystem::is_directory(command.meshes, error))
        throw InputError(command.meshes.string() + ": is not a readable folder");
    if (!command.meshes.empty() && std::ranges::all_of(experiments(), [&](const Experiment& experiment) {
            return find_file(experiment.source.file, command.meshes).empty();
        }))
        throw InputError(fmt::format("{}: has none of the authors' meshes, such as {}; without --meshes all are "
                                     "generated",
                                     command.meshes.string(), experiments().front().source.file));
    std::filesystem::create_directories(command.out, error);
    if (error)
        throw OutputError(command.out.string() + ": cannot be created: " + error.message());
    require_writable(command.out / "claims.csv");
}

}  // namespace

bool FiguresCommand::wants(std::string_view figure) const
{
    return figures.empty() || std::find(figures.begin(), figures.end(), figure) != figures.end();
}

std::optional<ExitStatus> parse_figures_command(int argc, char** argv, FiguresCommand& command)
{
    CLI::App app("Repeats the experiments of the paper and tells which of its claims hold.", "figures");
    app.add_option("FIGURE", command.figures, "by name or by number in the paper [all]\n" + listed_names())
        ->type_name("");
    app.add_option("--meshes", command.meshes, "folder with the authors' own meshes [all are generated]")
        ->type_name("DIR");
    app.add_option("--out", command.out, "folder for tables, meshes, claims and pictures")
        ->required()
        ->type_name("DIR");
    app.add_flag("--html", command.html,
                 "also write a page for each figure that shows its flows step by step in a browser");
    app.footer("figures --out results                  all figures on generated meshes\n"
               "figures --out results 5 7              two of them, by their numbers in the paper\n"
               "figures --out results --meshes authors --html   on the authors' meshes, with pages for a browser\n");
    if (const auto end = parse_command_line(app, argc, argv))
        return end;
    if (command.html)
        require_page();
    for (std::string& figure : command.figures)
        figure = name_of_figure(figure);
    require_folders(command);
    return std::nullopt;
}

}  // namespace seamflow
