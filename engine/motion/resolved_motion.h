#pragma once

#include <vector>

#include "engine/measure/length_scale.h"
#include "engine/options/motion_options.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"

namespace seamflow {

/// Options whose lengths are in units of length, with w in place of MotionOptions::attachment_radius, and with the
/// strengths that MotionOptions::feather makes.
/// @param scale of the mesh, or of a larger surface that it is part of.
/// @param remarks gets a sentence if a region is less deep than it is feathered.
/// @throws InputError for a mesh that is not valid, or that has no size to measure by;
///         OptionError for a radius whose w no double can hold.
MotionOptions resolved(MotionOptions motion, const PolygonMesh& mesh, LengthScale& scale, const Executor& exec,
                       std::vector<Remark>& remarks);

/// The same without strengths, for a mesh that is not at hand.
MotionOptions with_lengths(MotionOptions motion, LengthScale& scale);

}  // namespace seamflow
