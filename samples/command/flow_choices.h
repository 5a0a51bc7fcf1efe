#pragma once

#include <string>
#include <utility>
#include <vector>

#include <CLI/App.hpp>

#include "engine/options/flow_options.h"

/// The words of programs for the values of FlowOptions (see add_choice).
namespace seamflow {

/// The names of all Laplacians.
const std::vector<std::pair<std::string, Laplacian>>& laplacian_choices();

/// Adds the option of a field of FlowOptions: a number within its limits, one of several words, a size or a flag.
/// @param name its name in the table of options, "--steps".
CLI::Option* add_field(CLI::App& app, FlowOptions& options, const std::string& name, const std::string& description);

/// Adds --converge: "auto", "never", or a tolerance below 1, for AccuracyOptions::tolerance and approach.
CLI::Option* add_converge(CLI::App& app, FlowOptions& options, const std::string& description);

}  // namespace seamflow
