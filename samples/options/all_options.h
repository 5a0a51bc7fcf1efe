#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "engine/denoise/denoise_options.h"
#include "engine/options/flow_options.h"
#include "engine/options/option_rule.h"
#include "engine/options/option_table.h"

namespace seamflow {

/// All options of `smooth`: those of a flow, and what chooses denoise() in place of a flow.
struct AllOptions : FlowOptions {
    AllOptions() = default;
    AllOptions(FlowOptions of_flow)
        : FlowOptions(std::move(of_flow))
    {
    }

    /// In degrees: edges that stay. With `denoise` where the noise is small, otherwise by an amount.
    std::optional<double> keep_edges = {};
    /// Whether noise is removed, as much as there is.
    bool denoise = false;
    /// Which coordinates are rounded, where noise is removed.
    Rounding rounded = {};
    /// Whether the boundary alone moves.
    bool smooth_rims = false;

    /// Whether there is no flow: no sub-meshes and no equations.
    [[nodiscard]] bool takes_whole_mesh() const { return denoise || keep_edges || smooth_rims; }
};

/// The rows of those options that flows do not have.
inline constexpr OptionTraits row_of_keep_edges{
    "keep_edges",
    "--keep-edges",
    option_group::kept,
    concern::motion | concern::whole_surface,
    "keep edges sharper than this angle between faces, in degrees, and their corners; 20 to 40 suit "
    "most meshes\n"
    "The surface between them is smoothed: as much as there is noise, or as an amount says. On the whole "
    "mesh.",
    limits_of_edge_angle};

inline constexpr OptionTraits row_of_rounded{
    "rounded", "--rounded", option_group::kind, concern::motion | concern::whole_surface,
    "coordinates lie in steps of this length, as of voxels or whole heights: the smoothest surface "
    "within half a step [found]\n"
    "One length for x, y and z, or three; 0: not rounded. Steps are found where they explain what is rough, "
    "unless it is never, or --keep-edges is given. Without an amount."};

/// The table of all options (see option_table).
template <class Options>
auto all_option_table(Options& options)
{
    using OfFlow = std::conditional_t<std::is_const_v<Options>, const FlowOptions, FlowOptions>;
    return std::tuple_cat(option_table(static_cast<OfFlow&>(options)),
                          std::tuple{row(options.keep_edges, row_of_keep_edges), row(options.denoise, {"denoise"}),
                                     row(options.rounded, row_of_rounded), row(options.smooth_rims, {"smooth_rims"})});
}

/// The options of denoise().
/// @pre takes_whole_mesh()
DenoiseOptions denoise_options_of(const AllOptions& options);

/// Completes the text of a rule: {whole} is the option that takes the whole mesh without equations; for the others see
/// fill_in.
FillText filling(const AllOptions& options);

}  // namespace seamflow
