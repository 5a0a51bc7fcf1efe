#pragma once

#include <exception>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "engine/tasks/schedule.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/task_graph.h"

namespace seamflow {

/// The task graph of a step. A task is a name: what it does, and for which sub-mesh; one function performs them all.
/// The graph is built once and run once for each step. On request it records what ran when; that allocates only between
/// steps.
class StepGraph {
  public:
    using Node = TaskGraph::Node;

    /// @param perform does what a task is named after; different tasks may run at the same time.
    /// @param is_recorded whether there is a schedule.
    /// @param progress counts the tasks and says whether to stop; must outlive the graph.
    StepGraph(std::function<void(const ScheduledTask&)> perform, bool is_recorded, Progress& progress);

    /// A starting point: the tasks that are added before the next root belong to it.
    Node add_root();

    /// A task that starts as soon as all tasks and the root before it are done.
    Node add_task(const ScheduledTask& task);

    /// A task that in every step also waits until it is signalled.
    Node add_event(const ScheduledTask& task);

    /// See TaskGraph.
    void signal(Node event) { graph_.signal(event); }
    void fail(std::exception_ptr failure) { graph_.fail(std::move(failure)); }
    [[nodiscard]] bool is_ending() const { return graph_.is_ending(); }

    /// Makes `after` wait for `before`.
    void add_dependency(Node before, Node after);

    /// Takes a step: runs all tasks of a root and waits for them, then calls `join` in this thread.
    /// @param root its number, from 0.
    /// @param further_parts that tasks count themselves (see Progress).
    /// @throws whatever a task has thrown; Cancelled if tasks were skipped because the flow is to stop.
    void run(std::size_t root = 0, double further_parts = 0.0, const std::function<void()>& join = {});

    [[nodiscard]] std::size_t n_roots() const { return roots_.size(); }

    /// What ran when; empty where nothing is recorded.
    [[nodiscard]] const std::optional<Schedule>& schedule() const { return schedule_; }

  private:
    Node add(const ScheduledTask& task, Node (TaskGraph::*add_node)(std::function<void()>, TaskPriority));
    void begin_record();
    void end_record();
    void run_task(Index task);

    std::function<void(const ScheduledTask&)> perform_;
    std::vector<ScheduledTask> tasks_;
    /// Number of the task at each node; -1 at roots.
    std::vector<Index> task_of_node_;
    std::optional<Schedule> schedule_;
    Stopwatch clock_;
    /// #tasks, for the step that runs; step 0: has not run.
    std::vector<TaskRecord> running_;
    /// Last, as its tasks refer to the others.
    TaskGraph graph_;
    std::vector<Node> roots_;
};

}  // namespace seamflow
