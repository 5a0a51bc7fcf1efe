#pragma once

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"
#include "solvers/laplacian/flow_terms.h"

namespace seamflow {

/// The terms of the flow's equations besides Vᵏ.
/// @param initial #V by 3: V⁰. It and the options must outlive the result.
FlowTerms terms_of(const FlowOptions& options, const Points& initial);

}  // namespace seamflow
