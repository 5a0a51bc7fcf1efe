#include "samples/python/flow_call.h"

#include <utility>

#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "samples/process/option_words.h"
#include "samples/report/report_json.h"
#include "samples/runs/smoothing_run.h"

namespace seamflow {

FlowCall::FlowCall(SmoothCommand command, PolygonMesh mesh, const FlowControl& control)
    : command_(std::move(command))
    , mesh_(std::move(mesh))
    , record_(begin_record(command_))
{
    try {
        begin(control);
    } catch (const InputError& error) {
        throw InputError(Wording{"mesh: " + error.wording().text});
    }
}

void FlowCall::begin(const FlowControl& control)
{
    if (mesh_.n_vertices() == 0)
        throw InputError("has no vertices");
    Workers workers(command_.options.resources.threads);
    require_valid(mesh_, workers.exec());
    resolve_amount(command_, mesh_, workers.exec(), record_);
    change_.emplace(mesh_, workers.exec());
    flow_.emplace(mesh_, command_.options, StepObserver(), control);
}

void FlowCall::step(int n)
{
    const std::lock_guard lock(mutex_);
    flow_->step(n);
}

void FlowCall::take_all_steps()
{
    step(command_.options.steps - flow_->n_steps());
}

int FlowCall::n_steps()
{
    const std::lock_guard lock(mutex_);
    return flow_->n_steps();
}

Points FlowCall::positions()
{
    const std::lock_guard lock(mutex_);
    return mesh_.vertices;
}

FlowResult FlowCall::result()
{
    const std::lock_guard lock(mutex_);
    FlowReport report = flow_->report();
    report.remarks.insert(report.remarks.begin(), record_.remarks.begin(), record_.remarks.end());
    Workers workers(command_.options.resources.threads);
    record_.surface = change_->measure(mesh_, report.mesh, command_.self_intersections, workers.exec());
    remark_on_loss(command_.options, record_.surface, report.remarks);
    remark_on_folds(command_.options, record_.surface, report.remarks);
    for (Remark& remark : report.remarks)
        remark.wording = unmarked(in_words_of_keywords(sentence(remark, option_of_program)));
    record_.seconds = watch_.seconds();
    FlowResult result{.positions = mesh_.vertices,
                      .labels = {},
                      .report = smooth_report_json(record_, command_.options, report),
                      .missed = missed_tolerance(command_, report.convergence)};
    result.labels = std::move(report.cut.labels);
    return result;
}

}  // namespace seamflow
