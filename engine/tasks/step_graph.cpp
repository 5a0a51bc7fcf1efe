#include "engine/tasks/step_graph.h"

#include <utility>

#include <oneapi/tbb/task_arena.h>

namespace seamflow {

StepGraph::StepGraph(bool is_recorded, Progress& progress)
    : schedule_(is_recorded ? std::optional<Schedule>(std::in_place) : std::nullopt)
    , graph_(&progress)
{
}

StepGraph::Node StepGraph::add_root()
{
    roots_.push_back(graph_.add_root());
    return roots_.back();
}

/// The body, as it runs in the graph.
std::function<void()> StepGraph::recorded(const ScheduledTask& task, std::function<void()> body)
{
    if (!schedule_)
        return body;
    const auto number = static_cast<Index>(schedule_->tasks.size());
    schedule_->tasks.push_back(task);
    return [this, number, run = std::move(body)] { run_recorded(number, run); };
}

/// Notes the node of the latest task.
void StepGraph::note(Node node)
{
    if (!schedule_)
        return;
    task_of_node_.resize(at(node) + 1, -1);
    task_of_node_[node] = static_cast<Index>(schedule_->tasks.size()) - 1;
}

StepGraph::Node StepGraph::add_task(const ScheduledTask& task, std::function<void()> body)
{
    const Node node = graph_.add_task(recorded(task, std::move(body)), task.priority);
    note(node);
    return node;
}

StepGraph::Node StepGraph::add_event(const ScheduledTask& task, std::function<void()> body)
{
    const Node node = graph_.add_event(recorded(task, std::move(body)), task.priority);
    note(node);
    return node;
}

Index StepGraph::task_at(Node node) const
{
    return at(node) < task_of_node_.size() ? task_of_node_[node] : -1;
}

void StepGraph::add_dependency(Node before, Node after)
{
    graph_.add_dependency(before, after);
    const Dependency dependency{task_at(before), task_at(after)};
    if (dependency.before >= 0 && dependency.after >= 0)
        schedule_->dependencies.push_back(dependency);
}

void StepGraph::begin_record()
{
    running_.assign(schedule_->tasks.size(), {});
    if (schedule_->steps.empty())
        clock_ = Stopwatch();
    schedule_->steps.push_back({.start = clock_.seconds()});
}

void StepGraph::end_record()
{
    schedule_->steps.back().end = clock_.seconds();
    for (const TaskRecord& record : running_)
        if (record.step > 0)
            schedule_->records.push_back(record);
}

/// Notes when the body ran, unless it throws. Different tasks may run at the same time.
void StepGraph::run_recorded(Index task, const std::function<void()>& body)
{
    const double start = clock_.seconds();
    body();
    running_[task] = {.step = static_cast<int>(schedule_->steps.size()),
                      .task = task,
                      .thread = oneapi::tbb::this_task_arena::current_thread_index(),
                      .start = start,
                      .end = clock_.seconds()};
}

void StepGraph::run(std::size_t root, double further_parts, const std::function<void()>& join)
{
    if (schedule_)
        begin_record();
    graph_.run(roots_[root], further_parts);
    if (join)
        join();
    if (schedule_)
        end_record();
}

}  // namespace seamflow
