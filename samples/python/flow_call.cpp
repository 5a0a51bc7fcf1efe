#include "samples/python/flow_call.h"

#include <utility>

#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "samples/process/option_words.h"
#include "samples/report/mesh_scale.h"
#include "samples/report/report_json.h"
#include "samples/report/surface_remarks.h"
#include "samples/runs/command_run.h"
#include "samples/runs/smoothing_run.h"

namespace seamflow {

namespace {

/// Calls work(); messages about the mesh get their beginning.
template <class Work>
auto about_mesh(Work&& work)
{
    try {
        return work();
    } catch (const InputError& error) {
        const std::string& text = error.wording().text;
        throw InputError(Wording{text.starts_with("the mesh ") ? text : "mesh: " + text});
    }
}

}  // namespace

MeshCall::MeshCall(SmoothRequest of_call, PolygonMesh given)
    : request(std::move(of_call))
    , mesh(std::move(given))
    , record_(begin_record(request))
{
    about_mesh([&] {
        if (mesh.n_vertices() == 0)
            throw InputError("has no vertices");
        Workers workers(request.options.resources.threads);
        require_valid(mesh, workers.exec());
        record_.scale = measure_scale(mesh, workers.exec());
        resolve_amount(request, mesh, workers.exec(), record_);
        change_.emplace(mesh, workers.exec());
    });
}

FlowResult MeshCall::smooth(const FlowControl& control)
{
    return result(about_mesh([&] { return smooth_surface(mesh, request.options, {}, control); }));
}

FlowResult MeshCall::result(SmoothReport report)
{
    report.remarks.insert(report.remarks.begin(), record_.remarks.begin(), record_.remarks.end());
    Workers workers(request.options.resources.threads);
    record_.surface = change_->measure(mesh, report.mesh, request.self_intersections, workers.exec());
    remark_on_loss(request.options, record_.surface, report.remarks);
    remark_on_folds(request.options, record_.surface, report.remarks);
    // A Flow may have taken other steps than its options name.
    record_.names = flow_names(request.options, static_cast<int>(report.steps.size()));
    complete_record(record_, report);
    for (RemarkInWords& remark : record_.remarks_in_words)
        remark.text = in_words_of_keywords(remark.text);
    record_.seconds = watch_.seconds();
    FlowResult result{.positions = mesh.vertices,
                      .labels = {},
                      .report = smooth_report_json(record_, request.options, report),
                      .missed = missed_tolerance(request, report.convergence)};
    result.labels = std::move(report.cut.labels);
    return result;
}

FlowCall::FlowCall(SmoothRequest request, PolygonMesh mesh)
    : call_(std::move(request), std::move(mesh))
{
    if (call_.request.options.takes_whole_mesh())
        throw OptionError(
            "a Flow takes steps of mean curvature flow, by an amount that is given: give --radius, or call "
            "smooth(), which removes noise and keeps edges");
    about_mesh([&] { flow_.emplace(call_.mesh, call_.request.options); });
}

void FlowCall::step(int n)
{
    const std::lock_guard lock(mutex_);
    flow_->step(n);
}

int FlowCall::n_steps()
{
    const std::lock_guard lock(mutex_);
    return flow_->n_steps();
}

Points FlowCall::positions()
{
    const std::lock_guard lock(mutex_);
    return call_.mesh.vertices;
}

FlowResult FlowCall::result()
{
    const std::lock_guard lock(mutex_);
    return call_.result(flow_->report());
}

}  // namespace seamflow
