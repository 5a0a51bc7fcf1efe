#pragma once

#include <nlohmann/json.hpp>

#include "samples/benchmark/benchmark_case.h"

namespace seamflow {

/// One method with one tolerance.
nlohmann::ordered_json row_json(const Row& row);

/// The results for one mesh, as written by `--json`.
/// @param mesh name of the mesh.
/// @param dt_over_h2 time step in squared mean edge lengths.
nlohmann::ordered_json case_json(const std::string& mesh, double dt_over_h2, const CaseOptions& options,
                                 const CaseResult& result);

}  // namespace seamflow
