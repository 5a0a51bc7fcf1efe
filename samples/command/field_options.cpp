#include "samples/command/field_options.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

/// Steps of --fwhm, after which the kernel is nearly a Gaussian.
constexpr int steps_of_fwhm = 10;

void refuse_beside(std::string_view given, const char* with, const char* reason)
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
std::string_view first_of_diffusion(const SmoothCommand& command)
{
    for (const OptionTraits& one : command.given)
        if (one.option != "--from" && one.option != "--threads" && one.group != option_group::written)
            return one.option;
    return {};
}

}  // namespace

void require_fields(SmoothCommand& command)
{
    const char* const by = command.fields.names.empty() ? "--from" : "--fields";
    refuse_beside(first_given(command, concern::motion), by, "the surface stays");
    refuse_beside(command.boundary == BoundaryWord::Smooth ? "--boundary smooth" : "", by, "the surface stays");
    refuse_beside(is_given(command, "--out-dir") ? "--out-dir" : "", by, "fields diffuse on one mesh");
    if (command.fields.names.empty())
        return refuse_beside(first_of_diffusion(command), by, "it concerns what diffuses, and distances do not");
    require_none_broken<SmoothCommand>(rules_of_field_amounts, command, asked_options(command),
                                       filling(command.options));
    if (command.fields.options.fwhm && !is_given(command, "--steps"))
        command.options.steps = steps_of_fwhm;
    if (!is_given(command, "--laplacian"))
        command.options.laplacian = FieldOptions().laplacian;
    command.fields.options.laplacian = command.options.laplacian;
    if (is_given(command, "--boundary"))
        command.fields.options.boundary = command.boundary == BoundaryWord::Fixed ? Boundary::Fixed : Boundary::Free;
}

}  // namespace seamflow
