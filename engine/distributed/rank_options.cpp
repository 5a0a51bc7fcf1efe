#include "engine/distributed/rank_options.h"

#include <string_view>

#include <fmt/format.h>

#include "engine/options/option_table.h"
#include "engine/setup/automatic_choices.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

bool is_converged(const FlowOptions& options)
{
    return options.accuracy.approach == Approach::Converged;
}

}  // namespace

void require_for_ranks(const FlowOptions& options)
{
    const InterfaceOptions& interface = options.interface;
    std::string_view unknown;
    if (is_converged(options) && !is_symmetric(options.laplacian))
        throw OptionError(fmt::format("ranks cannot take converged steps of {}, which need GMRES: use sweeps (approach "
                                      "sweep, without a tolerance), or a single process",
                                      name_of(options.laplacian)));
    if (!is_converged(options) && (options.accuracy.approach != Approach::Sweep || options.accuracy.tolerance))
        unknown = "approaches except sweeps and converged steps (approach has to be sweep, without a tolerance, or "
                  "converged)";
    else if (!is_converged(options) && interface.conditions != Conditions::AdaptedRobin &&
             interface.conditions != Conditions::AdaptedVentcell)
        unknown = "conditions except the adapted ones";
    else
        unknown = first_set(options, concern::one_process);
    if (unknown.empty() && options.laplacian == Laplacian::Uniform && options.uniform_edge == 0.0)
        throw OptionError("uniform_edge is 0, but ranks do not know the mean edge length of the whole mesh: set it to "
                          "that length (measure in engine/distributed/parts/slice_measures.h finds it)");
    if (const std::string_view of_part = first_set(options, concern::part); unknown.empty() && !of_part.empty())
        throw OptionError(fmt::format("{} is given, but distributed flows take it from the parts of the mesh: leave it "
                                      "out of the options",
                                      of_part));
    if (!unknown.empty())
        throw OptionError(
            fmt::format("distributed flows do not support {}: leave that out, or use a single process", unknown));
}

FlowOptions completed(const FlowOptions& options, const MeshPart& part)
{
    FlowOptions complete = options;
    if (is_converged(options))
        complete.accuracy.tolerance = choose_tolerance(part.mesh, {}, options, false).tolerance;
    complete.motion.attachment_weights = part.attachment_weights;
    complete.motion.strength = part.strengths;
    return complete;
}

}  // namespace seamflow
