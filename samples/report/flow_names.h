#pragma once

#include <optional>
#include <string_view>

#include "samples/options/all_options.h"

namespace seamflow {

/// The kind and the amount of the steps of a run, in the words of the command line: for all reports on it.
struct FlowNames {
    std::string_view laplacian;
    std::string_view flow;
    std::string_view filter;
    int order = 1;
    /// Whether steps have neither another filter nor another order than plain diffusion.
    bool is_plain = true;
    std::string_view rescale;
    /// The way in which they were taken; empty before the run is complete.
    std::string_view approach = {};
    /// The radius of bumps that lose half their height, in length. Nothing where there is no amount: where noise is
    /// removed, or nothing is.
    std::optional<double> radius = {};
};

/// @param options resolved. @param steps that are taken.
FlowNames flow_names(const AllOptions& options, int steps);

}  // namespace seamflow
