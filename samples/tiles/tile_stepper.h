#pragma once

#include <span>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_control.h"
#include "engine/options/flow_options.h"
#include "partition/metrics/bounding_box.h"
#include "samples/tiles/tile_files.h"

namespace seamflow {

/// How far from a tile the surface matters for its step, in units of length. The step of a vertex depends on another
/// one as exp(-d/√dt) of their distance d; with filters of higher order more slowly.
/// @param options with the amount in length². @param mean_edge the longest of those of the tiles, in length.
double width_of_bands(const FlowOptions& options, double mean_edge);

/// Takes steps of one tile at a time. Each tile flows together with bands of the tiles around it, whose outer rims are
/// held: an overlapping Schwarz method (see Toselli, Widlund) whose overlap is so wide that one iteration suffices.
class TileStepper {
  public:
    /// @param options of one step; vertices on borders must already be joined. @param width of bands, see
    /// width_of_bands. The folder must outlive this.
    TileStepper(const TileFolder& folder, FlowOptions options, double width);

    /// The step of a tile.
    /// @param step from 1: all tiles have states of the step before. @param boxes of these, for each tile.
    /// @param positions get those after the step, except that vertices do not yet have the positions of their owners.
    /// @throws as mean_curvature_flow.
    FlowReport take(Index tile, int step, std::span<const BoundingBox> boxes, const FlowControl& control,
                    const Executor& exec, Points& positions) const;

  private:
    const TileFolder* folder_;
    FlowOptions options_;
    double width_;
};

}  // namespace seamflow
