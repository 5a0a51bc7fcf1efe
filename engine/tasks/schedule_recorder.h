#pragma once

#include <functional>
#include <vector>

#include "engine/options/schedule.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/task_graph.h"

namespace seamflow {

/// Writes down what a task graph is made of and when its tasks run. Allocates between steps alone.
class ScheduleRecorder {
  public:
    /// Says what a node of the graph is. Nodes of which nothing was said are not recorded.
    void add_task(TaskGraph::Node node, const ScheduledTask& task);

    /// To be called after `add_task` for both.
    void add_dependency(TaskGraph::Node before, TaskGraph::Node after);

    void begin_step();
    void end_step();

    /// Runs the body of a node and notes when; not if it throws. Different nodes may run at the same time.
    void timed(TaskGraph::Node node, const std::function<void()>& body);

    [[nodiscard]] const Schedule& schedule() const { return schedule_; }

  private:
    [[nodiscard]] Index task_at(TaskGraph::Node node) const;

    Schedule schedule_;
    Stopwatch clock_;
    /// Number of the task at each node; -1: none.
    std::vector<Index> task_of_node_;
    /// #tasks, for the step that runs; step 0: has not run.
    std::vector<TaskRecord> running_;
};

}  // namespace seamflow
