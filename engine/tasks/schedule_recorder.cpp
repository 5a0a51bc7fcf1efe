#include "engine/tasks/schedule_recorder.h"

#include <oneapi/tbb/task_arena.h>

namespace seamflow {

void ScheduleRecorder::add_task(TaskGraph::Node node, const ScheduledTask& task)
{
    if (at(node) >= task_of_node_.size())
        task_of_node_.resize(at(node) + 1, -1);
    task_of_node_[node] = static_cast<Index>(schedule_.tasks.size());
    schedule_.tasks.push_back(task);
}

Index ScheduleRecorder::task_at(TaskGraph::Node node) const
{
    return at(node) < task_of_node_.size() ? task_of_node_[node] : -1;
}

void ScheduleRecorder::add_dependency(TaskGraph::Node before, TaskGraph::Node after)
{
    const Dependency dependency{task_at(before), task_at(after)};
    if (dependency.before >= 0 && dependency.after >= 0)
        schedule_.dependencies.push_back(dependency);
}

void ScheduleRecorder::begin_step()
{
    running_.assign(schedule_.tasks.size(), {});
    if (schedule_.steps.empty())
        clock_ = Stopwatch();
    schedule_.steps.push_back({.start = clock_.seconds()});
}

void ScheduleRecorder::end_step()
{
    schedule_.steps.back().end = clock_.seconds();
    for (const TaskRecord& record : running_)
        if (record.step > 0)
            schedule_.records.push_back(record);
}

void ScheduleRecorder::timed(TaskGraph::Node node, const std::function<void()>& body)
{
    const Index task = task_at(node);
    const double start = clock_.seconds();
    body();
    if (task >= 0)
        running_[task] = {.step = static_cast<int>(schedule_.steps.size()),
                          .task = task,
                          .thread = oneapi::tbb::this_task_arena::current_thread_index(),
                          .start = start,
                          .end = clock_.seconds()};
}

}  // namespace seamflow
