#pragma once

#include <vector>

#include "partition/remark.h"
#include "samples/options/all_options.h"
#include "samples/report/surface_change.h"

namespace seamflow {

/// A surface that flows by mean curvature shrinks, which surprises those who only wanted it smooth: adds a remark if it
/// has lost much of its volume, or most of its area if it encloses none; where sheets meet, if cells have lost much.
void remark_on_loss(const AllOptions& options, const SurfaceChange& change, std::vector<Remark>& remarks);

/// Adds a remark, with a remedy, if the surface has folded over, or crosses itself where it did not before, or if
/// sheets lie on each other so that cells are not known.
void remark_on_folds(const AllOptions& options, const SurfaceChange& change, std::vector<Remark>& remarks);

}  // namespace seamflow
