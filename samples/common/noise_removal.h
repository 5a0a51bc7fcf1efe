#pragma once

#include "engine/options/flow_options.h"
#include "partition/loop.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// A time step with which a flow takes no more off a mesh than the noise that it is to remove: that of the options, or
/// a shorter one where the flow would move vertices further along the normals (the discrepancy principle: Morozov,
/// 1966). What looks like noise may be details as narrow as the edges, beside which there are wider ones. Displacements
/// are measured by their median, as the noise is, so that edges and spikes do not count as long as they are few. Flows
/// are taken on trial, at most four: of the whole mesh, or of patches all over it if it is large.
/// @param noise in units of length, as estimate_noise gives it; 0: the time step is that of the options.
/// @param options of the flow, all its steps.
/// @returns dt, in length², above 0; that of the options where no trial can be taken.
double time_step_within_noise(const PolygonMesh& mesh, double noise, const FlowOptions& options,
                              const Loop& loop = run_serially);

}  // namespace seamflow
