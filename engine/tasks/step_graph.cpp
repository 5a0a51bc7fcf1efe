#include "engine/tasks/step_graph.h"

#include <utility>

#include <oneapi/tbb/task_arena.h>

namespace seamflow {

StepGraph::StepGraph(std::function<void(const ScheduledTask&)> perform, bool is_recorded, Progress& progress)
    : perform_(std::move(perform))
    , schedule_(is_recorded ? std::optional<Schedule>(std::in_place) : std::nullopt)
    , graph_(&progress)
{
}

StepGraph::Node StepGraph::add_root()
{
    task_of_node_.push_back(-1);
    roots_.push_back(graph_.add_root());
    return roots_.back();
}

StepGraph::Node StepGraph::add(const ScheduledTask& task,
                               Node (TaskGraph::*add_node)(std::function<void()>, TaskPriority))
{
    const auto number = static_cast<Index>(tasks_.size());
    tasks_.push_back(task);
    task_of_node_.push_back(number);
    if (schedule_)
        schedule_->tasks.push_back(task);
    return (graph_.*add_node)([this, number] { run_task(number); }, priority_of(task.kind));
}

StepGraph::Node StepGraph::add_task(const ScheduledTask& task)
{
    return add(task, &TaskGraph::add_task);
}

StepGraph::Node StepGraph::add_event(const ScheduledTask& task)
{
    return add(task, &TaskGraph::add_event);
}

void StepGraph::add_dependency(Node before, Node after)
{
    graph_.add_dependency(before, after);
    if (schedule_ && task_of_node_[before] >= 0)
        schedule_->dependencies.push_back({task_of_node_[before], task_of_node_[after]});
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

/// Notes when the task ran, unless it throws.
void StepGraph::run_task(Index task)
{
    if (!schedule_)
        return perform_(tasks_[task]);
    const double start = clock_.seconds();
    perform_(tasks_[task]);
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
