#include "samples/python/flow_call.h"

#include <utility>

#include "engine/mean_curvature_flow.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "samples/process/option_words.h"
#include "samples/report/report_json.h"
#include "samples/runs/smoothing_run.h"

namespace seamflow {

namespace {

FlowReport run(SmoothCommand& command, PolygonMesh& mesh, const FlowControl& control, RunRecord& record)
{
    if (mesh.n_vertices() == 0)
        throw InputError("has no vertices");
    const Stopwatch whole;
    Workers workers(command.options.resources.threads);
    const Executor exec = workers.exec();
    require_valid(mesh, exec);
    resolve_amount(command, mesh, exec, record);
    const SurfaceChangeMeter change(mesh, exec);
    FlowReport report = mean_curvature_flow(mesh, command.options, {}, control);
    report.remarks.insert(report.remarks.begin(), record.remarks.begin(), record.remarks.end());
    record.surface = change.measure(mesh, report.mesh.moved_with, command.self_intersections, exec);
    remark_on_loss(command.options, record.surface, report.remarks);
    remark_on_folds(command.options, record.surface, report.remarks);
    for (std::string& remark : report.remarks)
        remark = in_words_of_keywords(remark);
    record.seconds = whole.seconds();
    return report;
}

}  // namespace

FlowResult call_flow(SmoothCommand command, PolygonMesh mesh, const FlowControl& control)
{
    RunRecord record = begin_record(command);
    try {
        FlowReport report = run(command, mesh, control, record);
        return {.positions = std::move(mesh.vertices),
                .labels = std::move(report.cut.labels),
                .report = smooth_report_json(record, report),
                .missed = missed_tolerance(command, report.convergence)};
    } catch (const InputError& error) {
        throw InputError(std::string("mesh: ").append(error.what()));
    }
}

}  // namespace seamflow
