#include "samples/command/field_options.h"

#include <array>
#include <string>

#include <fmt/format.h>

#include "partition/errors.h"
#include "samples/command/command_help.h"
#include "samples/command/command_line.h"

namespace seamflow {

namespace {

/// Steps of --fwhm, after which the kernel is nearly a Gaussian.
constexpr int steps_of_fwhm = 10;

/// Options about where the surface goes, which stays.
constexpr std::array of_moving_surfaces = {"--preset",          "--noise",
                                           "--within",          "--rescale",
                                           "--keep-edges",      "--edges",
                                           "--edges-from-file", "--attach",
                                           "--attach-weights",  "--reference",
                                           "--keep-gaps",       "--every-step",
                                           "--checkpoint",      "--self-intersections",
                                           "--scheme",          "--csv",
                                           "--strict",          "--region",
                                           "--region-property", "--feather",
                                           "--direction",       "--parts",
                                           "--trace",           "--task-graph"};

/// Options that only one of the two has.
constexpr std::array of_diffusion = {"--fwhm",
                                     "--radius",
                                     "--time-step",
                                     "--time-step-edges",
                                     "--fill",
                                     "--steps",
                                     "--keep-field-edges",
                                     "--flow",
                                     "--order",
                                     "--filter",
                                     "--laplacian",
                                     "--boundary",
                                     "--fix",
                                     "--subdomains",
                                     "--labels",
                                     "--approach",
                                     "--converge",
                                     "--junctions",
                                     "--weld",
                                     "--precision",
                                     "--factorisation",
                                     "--memory-limit",
                                     "--converge-iterations",
                                     "--tune-for",
                                     "--conditions",
                                     "--transmission",
                                     "--p",
                                     "--p-rule",
                                     "--p-edge",
                                     "--q",
                                     "--overlap",
                                     "--sweep",
                                     "--coloring",
                                     "--no-correction",
                                     "--paper",
                                     "--plain"};

void refuse_any(const CLI::App& app, auto&& names, const char* with, const char* reason)
{
    for (const char* const name : names)
        if (const CLI::Option* const option = app.get_option_no_throw(name); option != nullptr && option->count() > 0)
            throw OptionError(fmt::format("{} cannot be combined with {}: {}", with, name, reason));
}

}  // namespace

void add_fields(CLI::App& app, SmoothCommand& command)
{
    app.option_defaults()->group(option_group::fields);
    FieldRequest& fields = command.fields;
    auto* names = app.add_option("--fields", fields.names,
                                 "smooth these numbers of the vertices instead of the surface, which stays\n"
                                 "Properties of PLY files; red, green and blue of OBJ and OFF files; normal, colour. "
                                 "They diffuse by the heat equation on the surface, with --fwhm, --radius or "
                                 "--time-step. NaN is no data: such vertices take no part.")
                      ->delimiter(',')
                      ->type_name("NAME,…");
    add_length(app, "--fwhm", fields.fwhm,
               "full width at half maximum of the smoothing, over all steps together; 10 steps unless told otherwise")
        ->needs(names);
    app.add_flag("--fill", fields.options.fill, "give vertices without data the harmonic extension of the others")
        ->needs(names);
    add_real(app, "--keep-field-edges", fields.options.keep_edges, positive(),
             "differences of fields well above this stay (Perona and Malik)")
        ->needs(names);
    app.add_option("--from", fields.from,
                   "write geodesic distances from vertices as the field distance; the surface stays\n"
                   "Their numbers from 0, one a line. By the heat method; NaN where the surface does not lead.")
        ->excludes(names)
        ->type_name("FILE");
}

void require_fields(const CLI::App& app, SmoothCommand& command)
{
    const char* const by = command.fields.names.empty() ? "--from" : "--fields";
    refuse_any(app, of_moving_surfaces, by, "the surface stays");
    if (app.count("--out-dir") > 0)
        throw OptionError(fmt::format("{} cannot be combined with --out-dir: fields diffuse on one mesh", by));
    if (command.fields.names.empty())
        return refuse_any(app, of_diffusion, by, "it concerns what diffuses, and distances do not");
    const std::size_t n_amounts =
        app.count("--fwhm") + app.count("--radius") + app.count("--time-step") + app.count("--time-step-edges");
    if (n_amounts != 1)
        throw OptionError(n_amounts == 0 ? "--fields needs an amount: give --fwhm, --radius, --time-step or "
                                           "--time-step-edges"
                                         : "--fwhm, --radius, --time-step and --time-step-edges all say how much to "
                                           "smooth: give one of them");
    if (command.fields.fwhm && app.count("--steps") == 0)
        command.options.steps = steps_of_fwhm;
    if (app.count("--laplacian") == 0)
        command.options.laplacian = FieldOptions().laplacian;
    command.fields.options.laplacian = command.options.laplacian;
    if (app.count("--boundary") > 0)
        command.fields.options.boundary = command.options.motion.boundary;
}

}  // namespace seamflow
