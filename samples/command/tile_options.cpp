#include "samples/command/tile_options.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_file.h"
#include "partition/io/input_file.h"
#include "samples/command/smooth_options.h"
#include "samples/files/output_files.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;

struct Refusal {
    const char* option;
    const char* reason;
};

/// Those for which none of the reasons below is right.
constexpr std::array refusals = {
    Refusal{"--preset", "it may measure the whole surface; give its options instead"},
    Refusal{"--noise", "it measures the whole surface; give --time-step, --time-step-edges or --radius"},
    Refusal{"--strict", "faces are missing where a file ends; inspect lists what is wrong with one"},
    Refusal{"--keep-gaps", "each result has the form of its input"},
    Refusal{"--checkpoint", "such a run keeps its own state in that folder, and the same command resumes"},
};

/// Why options that concern this are refused.
constexpr std::array<std::pair<unsigned, const char*>, 3> reasons = {
    {{concern::whole_surface, "it needs the whole surface at once"},
     {concern::numbers, "it numbers vertices or faces of one mesh"},
     {concern::one_mesh, "it shows the steps of one mesh"}}};

/// Options that refer to the first positions, which further steps do not have.
constexpr std::array<const char*, 3> of_first_positions = {"--attach", "--within", "--flow"};

void refuse(std::string_view option, const char* reason)
{
    if (!option.empty())
        throw OptionError(fmt::format("--out-dir cannot be combined with {}: {}", option, reason));
}

void require_options(const CLI::App& app, const SmoothCommand& command)
{
    for (const auto& [option, reason] : refusals)
        refuse(first_given(app, {option}), reason);
    for (const auto& [concerns, reason] : reasons)
        refuse(first_given(app, concerns), reason);
    if (first_given(app, concern::amount).empty())
        throw OptionError("--out-dir needs an amount, because no preset can measure all files at once: give "
                          "--time-step, --time-step-edges or --radius");
    if (command.options.steps == 0)
        throw OptionError("--out-dir takes at least one step, but --steps is 0");
    for (const char* const option : of_first_positions)
        if (app.count(option) > 0 && command.options.steps > 1)
            throw OptionError(fmt::format("--out-dir supports {} with one step only: further ones start from their "
                                          "own positions",
                                          option));
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

void require_tiles(const CLI::App& app, SmoothCommand& command)
{
    require_options(app, command);
    std::ranges::sort(command.tiles, {}, [](const fs::path& one) { return one.filename(); });
    require_inputs(command);
    require_folder(command);
}

}  // namespace seamflow
