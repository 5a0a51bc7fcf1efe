#pragma once

#include <optional>

#include "engine/options/motion_options.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "solvers/filters/step_filter.h"

namespace seamflow {

/// The sizes of a mesh by which lengths and amounts of smoothing are given, in units of length. They are measured when
/// they are first asked for.
class LengthScale {
  public:
    /// @param mesh must outlive this.
    explicit LengthScale(const PolygonMesh& mesh, Executor exec = run_serially);
    /// A scale of known sizes, in length.
    LengthScale(double mean_edge, double diagonal);

    /// The mean edge length (see mean_edge_length). @throws InputError for a mesh that is not valid.
    double mean_edge();

    /// The diagonal of the box around the faces. @throws InputError for a mesh that is not valid.
    double diagonal();

    /// The length in units of length. @throws as diagonal().
    double length_of(const LengthOnMesh& length);

  private:
    const PolygonMesh& mesh() const;

    const PolygonMesh* mesh_ = nullptr;
    Executor exec_ = run_serially;
    std::optional<double> mean_edge_;
    std::optional<double> diagonal_;
};

/// dt of one step, in length².
/// @param steps 0 counts as 1. @param filter of each step.
/// @throws InputError for a mesh without a size to measure by, or that is not valid; OptionError for a time step that
/// no double can hold.
double time_step_of(const SmoothingAmount& amount, int steps, LengthScale& scale, const StepFilter& filter = {});

}  // namespace seamflow
