#pragma once

#include <vector>

#include "engine/denoise/denoise_options.h"
#include "engine/measure/length_scale.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"

namespace seamflow {

/// The amount of a method; null: it has none.
SmoothingAmount* amount_of(DenoiseMethod& method);

/// Options that hold for one mesh: their amount is a time step, and their lengths are in units of length.
/// @param scale of the mesh.
/// @param remarks gets sentences for the user.
/// @throws InputError for a mesh that is not valid, or that has no size to measure by.
DenoiseOptions resolved(const DenoiseOptions& options, const PolygonMesh& mesh, LengthScale& scale,
                        const Executor& exec, std::vector<Remark>& remarks);

}  // namespace seamflow
