#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "engine/denoise/denoise_report.h"
#include "engine/measure/flow_report.h"
#include "engine/options/flow_control.h"
#include "partition/polygon_mesh.h"
#include "samples/options/all_options.h"

namespace seamflow {

/// The report of a flow, or of denoise() in its form: one sub-mesh that is the whole mesh.
struct SmoothReport : FlowReport {
    SmoothReport() = default;
    SmoothReport(FlowReport of_flow)
        : FlowReport(std::move(of_flow))
    {
    }

    /// See DenoiseReport.
    std::optional<NoiseReport> noise;
    std::optional<RoundingReport> rounding;
};

SmoothReport report_of(DenoiseReport report, Index n_faces);

/// Goes through the door that the options ask for: mean_curvature_flow() or denoise().
SmoothReport smooth_surface(PolygonMesh& mesh, const AllOptions& options, const StepObserver& on_step = {},
                            const FlowControl& control = {});

/// The identity of the flow or of the run of denoise() (see identify).
std::uint64_t identity_of(const PolygonMesh& mesh, const AllOptions& options);

}  // namespace seamflow
