#pragma once

#include <optional>
#include <string_view>

#include "samples/options/smooth_surface.h"

namespace seamflow {

/// How the steps of a run were taken, in the words of the command line: for all reports on it.
struct FlowNames {
    std::string_view laplacian;
    std::string_view flow;
    std::string_view filter;
    int order = 1;
    /// Whether steps have neither another filter nor another order than plain diffusion.
    bool is_plain = true;
    std::string_view rescale;
    std::string_view approach;
    /// The radius of bumps that lose half their height, in length. Nothing where there is no amount: where noise is
    /// removed, or nothing is.
    std::optional<double> radius = {};
};

/// @param options resolved.
FlowNames flow_names(const AllOptions& options, const SmoothReport& report);

}  // namespace seamflow
