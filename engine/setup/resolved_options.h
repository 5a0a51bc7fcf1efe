#pragma once

#include <vector>

#include "engine/measure/length_scale.h"
#include "engine/options/flow_options.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"

namespace seamflow {

/// Options that hold for one mesh: dt in place of a radius or of squared edge lengths, lengths in units of length, w in
/// place of a radius of attachment, strengths that are feathered; for Laplacian::Uniform the mean edge length, or 1 if
/// no edge has a length, in place of FlowOptions::uniform_edge of 0. Options that are resolved stay as they are.
/// @param scale of the mesh.
/// @param remarks gets sentences for the user.
/// @throws InputError for a mesh that is not valid, or that has no size to measure by;
///         OptionError for a length that is too small or too large.
FlowOptions resolved(FlowOptions options, const PolygonMesh& mesh, LengthScale& scale, const Executor& exec,
                     std::vector<Remark>& remarks);

/// The same, for options whose remarks nobody reads.
FlowOptions resolved(FlowOptions options, const PolygonMesh& mesh);

/// FlowOptions::time_step, or the time step in its place, in length².
/// @throws as resolved.
double time_step_of(const FlowOptions& options, LengthScale& scale);

}  // namespace seamflow
