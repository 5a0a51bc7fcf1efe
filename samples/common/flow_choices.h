#pragma once

#include <string>
#include <utility>
#include <vector>

#include <CLI/App.hpp>

#include "engine/options/flow_options.h"

/// The words by which programs know the values of FlowOptions (see add_choice).
namespace seamflow {

/// The names of all Laplacians.
const std::vector<std::pair<std::string, Laplacian>>& laplacian_choices();

/// Adds --converge: "auto", "never", or a tolerance below 1, for AccuracyOptions::tolerance and approach.
CLI::Option* add_converge(CLI::App& app, FlowOptions& options, const std::string& description);

}  // namespace seamflow
