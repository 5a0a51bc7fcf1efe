#include "samples/command/field_options.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "partition/errors.h"
#include "samples/command/smooth_options.h"

namespace seamflow {

namespace {

/// Steps of --fwhm, after which the kernel is nearly a Gaussian.
constexpr int steps_of_fwhm = 10;

void refuse(std::string_view given, const char* with, const char* reason)
{
    if (!given.empty())
        throw OptionError(fmt::format("{} cannot be combined with {}: {}", with, given, reason));
}

std::ptrdiff_t n_amounts(const AskedOptions& asked)
{
    return std::ranges::count_if(std::array{"--fwhm", "--radius", "--time-step", "--time-step-edges"}, asked.has);
}

constexpr OptionRule<SmoothCommand> rules_of_field_amounts[]{
    {[](const SmoothCommand&, const AskedOptions& asked) { return n_amounts(asked) == 0; }, 0,
     "--fields needs an amount: give --fwhm, --radius, --time-step or --time-step-edges"},
    {[](const SmoothCommand&, const AskedOptions& asked) { return n_amounts(asked) > 1; }, 0,
     "--fwhm, --radius, --time-step and --time-step-edges all say how much to smooth: give one of them"},
};

/// The first option about what diffuses that was given.
std::string_view first_of_diffusion(const CLI::App& app)
{
    for (const OptionTraits& one : smooth_options())
        if (app.count(std::string(one.option)) > 0 && one.option != "--from" && one.option != "--threads" &&
            one.group != option_group::written)
            return one.option;
    return {};
}

}  // namespace

void require_fields(const CLI::App& app, SmoothCommand& command)
{
    const char* const by = command.fields.names.empty() ? "--from" : "--fields";
    refuse(first_given(app, concern::motion), by, "the surface stays");
    refuse(first_given(app, {"--out-dir"}), by, "fields diffuse on one mesh");
    if (command.fields.names.empty())
        return refuse(first_of_diffusion(app), by, "it concerns what diffuses, and distances do not");
    require_none_broken<SmoothCommand>(rules_of_field_amounts, command, given_options(app, command),
                                       filling(command.options));
    if (command.fields.fwhm && app.count("--steps") == 0)
        command.options.steps = steps_of_fwhm;
    if (app.count("--laplacian") == 0)
        command.options.laplacian = FieldOptions().laplacian;
    command.fields.options.laplacian = command.options.laplacian;
    if (app.count("--boundary") > 0)
        command.fields.options.boundary = command.options.motion.boundary;
}

}  // namespace seamflow
