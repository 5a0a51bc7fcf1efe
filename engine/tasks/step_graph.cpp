#include "engine/tasks/step_graph.h"

#include <utility>

namespace seamflow {

StepGraph::StepGraph(bool is_recorded, Progress& progress)
    : recorder_(is_recorded ? std::make_unique<ScheduleRecorder>() : nullptr)
    , graph_(recorder_.get(), &progress)
{
}

StepGraph::Node StepGraph::add_root()
{
    roots_.push_back(graph_.add_root());
    return roots_.back();
}

StepGraph::Node StepGraph::add_task(const ScheduledTask& task, std::function<void()> body)
{
    const Node node = graph_.add_task(std::move(body), task.priority);
    if (recorder_)
        recorder_->add_task(node, task);
    return node;
}

void StepGraph::run(std::size_t root, double further_parts, const std::function<void()>& join)
{
    if (recorder_)
        recorder_->begin_step();
    graph_.run(roots_[root], further_parts);
    if (join)
        join();
    if (recorder_)
        recorder_->end_step();
}

std::optional<Schedule> StepGraph::schedule() const
{
    return recorder_ ? std::optional(recorder_->schedule()) : std::nullopt;
}

}  // namespace seamflow
