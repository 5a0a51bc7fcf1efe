#include "samples/command/tile_options.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_file.h"
#include "partition/io/input_file.h"
#include "samples/files/output_files.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;

using Rule = OptionRule<SmoothCommand>;

constexpr auto always = [](const SmoothCommand&, const AskedOptions&) { return true; };

constexpr Rule rules_of_tiles[]{
    {[](const SmoothCommand&, const AskedOptions& asked) { return asked.has("--preset"); }, 0,
     "--out-dir cannot be combined with --preset: it may measure the whole surface; give its options instead"},
    {[](const SmoothCommand&, const AskedOptions& asked) { return asked.has("--noise"); }, 0,
     "--out-dir cannot be combined with --noise: it measures the whole surface; give --time-step, --time-step-edges or "
     "--radius"},
    {[](const SmoothCommand&, const AskedOptions& asked) { return asked.has("--strict"); }, 0,
     "--out-dir cannot be combined with --strict: faces are missing where a file ends; inspect lists what is wrong "
     "with "
     "one"},
    {[](const SmoothCommand&, const AskedOptions& asked) { return asked.has("--keep-gaps"); }, 0,
     "--out-dir cannot be combined with --keep-gaps: each result has the form of its input"},
    {[](const SmoothCommand&, const AskedOptions& asked) { return asked.has("--checkpoint"); }, 0,
     "--out-dir cannot be combined with --checkpoint: such a run keeps its own state in that folder, and the same "
     "command resumes"},
    {always, concern::whole_surface, "--out-dir cannot be combined with <{other}>: it needs the whole surface at once"},
    {[](const SmoothCommand& c, const AskedOptions&) {
         return c.options.smooth_rims || c.boundary == BoundaryWord::Smooth;
     },
     0, "--out-dir cannot be combined with --boundary smooth: it needs the whole surface at once"},
    {always, concern::numbers, "--out-dir cannot be combined with <{other}>: it numbers vertices or faces of one mesh"},
    {always, concern::one_mesh, "--out-dir cannot be combined with <{other}>: it shows the steps of one mesh"},
    {[](const SmoothCommand&, const AskedOptions& asked) { return asked.first(concern::amount).empty(); }, 0,
     "--out-dir needs an amount, because no preset can measure all files at once: give --time-step, --time-step-edges "
     "or --radius"},
    {[](const SmoothCommand& c, const AskedOptions&) { return c.options.steps == 0; }, 0,
     "--out-dir takes at least one step, but --steps is 0"},
    {[](const SmoothCommand& c, const AskedOptions& asked) { return c.options.steps > 1 && asked.has("--attach"); }, 0,
     "--out-dir supports --attach with one step only: further ones start from their own positions"},
    {[](const SmoothCommand& c, const AskedOptions& asked) { return c.options.steps > 1 && asked.has("--within"); }, 0,
     "--out-dir supports --within with one step only: further ones start from their own positions"},
    {[](const SmoothCommand& c, const AskedOptions& asked) { return c.options.steps > 1 && asked.has("--flow"); }, 0,
     "--out-dir supports --flow with one step only: further ones start from their own positions"},
};

void require_options(const SmoothCommand& command)
{
    require_none_broken<SmoothCommand>(rules_of_tiles, command, asked_options(command), filling(command.options));
}

void require_inputs(const SmoothCommand& command)
{
    for (const fs::path& path : command.tiles) {
        if (is_input_stream(path))
            throw OptionError(fmt::format("{} can be read only once: with --out-dir name files", path.string()));
        std::error_code ignored;
        if (!fs::is_regular_file(path, ignored))
            static_cast<void>(OpenFile(path));
        if (!format_of(path))
            throw OptionError(fmt::format("{}: its extension is none of {}", path.string(), extensions_of()));
    }
    const auto same = std::ranges::adjacent_find(command.tiles, {}, [](const fs::path& one) { return one.filename(); });
    if (same != command.tiles.end())
        throw OptionError(fmt::format("{} and {} have the same name, and would both become {}: rename one",
                                      same->string(), (same + 1)->string(),
                                      (command.out_dir / same->filename()).string()));
}

void require_folder(const SmoothCommand& command)
{
    std::error_code error;
    fs::create_directories(command.out_dir, error);
    if (!fs::is_directory(command.out_dir))
        throw OutputError(fmt::format("{}: cannot create this folder: {}; name another", command.out_dir.string(),
                                      error ? error.message() : "no folder can have this name"));
    for (const fs::path& input : command.tiles) {
        const fs::path output = command.out_dir / input.filename();
        if (fs::equivalent(input, output, error))
            throw OptionError(fmt::format("{} would be replaced, but a run that resumes reads it again: name another "
                                          "folder than {}",
                                          input.string(), command.out_dir.string()));
        require_writable(output);
    }
}

}  // namespace

bool names_tiles(std::span<char* const> arguments)
{
    return std::ranges::any_of(arguments, [](std::string_view word) { return word.starts_with("--out-dir"); });
}

void take_tiles(CLI::App& app, SmoothCommand& command)
{
    app.remove_option(app.get_option("OUTPUT"));
    app.remove_option(app.get_option("INPUT"));
    app.add_option("INPUT", command.tiles, "meshes whose borders coincide")->required()->type_name("");
}

void require_tiles(SmoothCommand& command)
{
    require_options(command);
    std::ranges::sort(command.tiles, {}, [](const fs::path& one) { return one.filename(); });
    require_inputs(command);
    require_folder(command);
}

}  // namespace seamflow
