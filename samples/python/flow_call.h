#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/mean_curvature_flow.h"
#include "engine/options/flow_control.h"
#include "engine/tasks/stopwatch.h"
#include "partition/polygon_mesh.h"
#include "samples/options/smooth_request.h"
#include "samples/options/smooth_surface.h"
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

/// A mesh in memory that is smoothed as `smooth` smooths one in a file, with the same bits.
class MeshCall {
  public:
    /// @param request settled; labels, fixed vertices and weights are in its options.
    /// @param mesh need not be valid.
    /// @throws InputError whose message about the mesh begins with "mesh: ".
    MeshCall(SmoothRequest request, PolygonMesh mesh);

    /// All steps.
    /// @throws the exceptions of smooth_surface.
    FlowResult smooth(const FlowControl& control);

    [[nodiscard]] FlowResult result(SmoothReport report);

    SmoothRequest request;
    PolygonMesh mesh;

  private:
    Stopwatch watch_;
    RunRecord record_;
    std::optional<SurfaceChangeMeter> change_;
};

/// A flow of a mesh in memory. Its functions may be called from any thread, one after the other.
class FlowCall {
  public:
    /// @throws as MeshCall; the exceptions of Flow; OptionError for options that remove noise, which is no flow.
    FlowCall(SmoothRequest request, PolygonMesh mesh);

    /// @throws as Flow::step.
    void step(int n);

    /// Calls action(flow) between steps, for what Flow changes there.
    template <class Action>
    void change(Action&& action)
    {
        const std::lock_guard lock(mutex_);
        action(*flow_);
    }

    [[nodiscard]] int n_steps();

    /// After the steps so far.
    [[nodiscard]] FlowResult result();

    /// #V by 3: a copy.
    [[nodiscard]] Points positions();

  private:
    std::mutex mutex_;
    MeshCall call_;
    std::optional<Flow> flow_;
};

}  // namespace seamflow
