#pragma once

#include <vector>

#include "engine/measure/length_scale.h"
#include "engine/options/motion_options.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"

namespace seamflow {

/// The options with all lengths in units of length, with MotionOptions::attachment = 1/R² in place of the radius R in
/// attachment_radius, with strengths that already rise over the distance MotionOptions::feather, and without
/// Rescale::Area where a limit of volume excludes it: the area of noise is no area of the surface.
/// @param scale of the mesh, or of a larger surface that it is part of.
/// @param remarks gets a sentence if a region is less deep than it is feathered, and if areas are not restored.
/// @throws InputError if there is a feather or a length relative to the mesh, and the mesh is not valid or has no size
///         to measure by; OptionError for a radius R whose 1/R² no double can hold.
MotionOptions resolved(MotionOptions motion, const PolygonMesh& mesh, LengthScale& scale, const Executor& exec,
                       std::vector<Remark>& remarks);

/// The same, except that strengths and MotionOptions::feather (in units of length) are left for later: for a mesh that
/// is not at hand.
MotionOptions with_lengths(MotionOptions motion, LengthScale& scale);

}  // namespace seamflow
