#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/flow.h"
#include "engine/options/flow_control.h"
#include "engine/tasks/stopwatch.h"
#include "partition/polygon_mesh.h"
#include "samples/command/smooth_command.h"
#include "samples/report/run_record.h"
#include "samples/report/surface_change.h"

namespace seamflow {

/// The result of a flow of a mesh in memory.
struct FlowResult {
    /// #V by 3.
    Points positions;
    /// Sub-mesh of every face.
    std::vector<Index> labels;
    /// See smooth_report_json.
    std::string report;
    /// See missed_tolerance.
    std::string missed;
};

/// A flow of a mesh in memory, as `smooth` smooths one in a file, with the same bits. Its functions may be called from
/// any thread, one after the other.
class FlowCall {
  public:
    /// @param command from parse_flow_options; labels, fixed vertices and weights are in its options.
    /// @param mesh need not be valid.
    /// @throws the exceptions of mean_curvature_flow; messages about the mesh begin with "mesh: ".
    FlowCall(SmoothCommand command, PolygonMesh mesh, const FlowControl& control = {});

    /// @throws as Flow::step.
    void step(int n);

    /// Calls action(flow) between steps, for what Flow changes there.
    template <class Action>
    void change(Action&& action)
    {
        const std::lock_guard lock(mutex_);
        action(*flow_);
    }

    /// All steps of the command that have not been taken.
    void take_all_steps();

    [[nodiscard]] int n_steps();

    /// After the steps so far.
    [[nodiscard]] FlowResult result();

    /// #V by 3: a copy.
    [[nodiscard]] Points positions();

  private:
    void begin(const FlowControl& control);

    std::mutex mutex_;
    Stopwatch watch_;
    SmoothCommand command_;
    PolygonMesh mesh_;
    RunRecord record_;
    std::optional<SurfaceChangeMeter> change_;
    std::optional<Flow> flow_;
};

}  // namespace seamflow
