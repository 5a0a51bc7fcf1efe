#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <optional>

#include "engine/tasks/schedule.h"
#include "partition/index.h"

namespace seamflow {

class Progress;

/// A graph of tasks with fixed dependencies, built once and run any number of times (a oneTBB flow graph of continue
/// nodes). Belongs to the arena in which it is constructed.
///
/// Tasks may throw: tasks that have not started by then are skipped, and `run` rethrows the exception of the failed
/// task with the lowest number (with several failures, it depends on timing which of them happened). Tasks are skipped
/// likewise when the flow is to stop. The graph can be run again afterwards.
///
/// On request it records the times of all tasks; recording allocates memory only between runs.
class TaskGraph {
  public:
    /// Number of a task or of a root.
    using Node = Index;

    /// @param progress counts the tasks and requests stops; must outlive the graph. nullptr: none.
    /// @param is_recorded whether there is a schedule.
    explicit TaskGraph(Progress* progress = nullptr, bool is_recorded = false);
    ~TaskGraph();
    TaskGraph(const TaskGraph&) = delete;
    TaskGraph& operator=(const TaskGraph&) = delete;

    /// Adds a starting point. A run reaches the tasks behind one root, which must be added before the next root.
    Node add_root();

    /// Adds a task that starts as soon as all tasks and the root before it are done. It may run at the same time as
    /// others.
    /// @param task its description in the schedule; its kind has a priority.
    Node add_task(std::function<void()> body, const ScheduledTask& task);

    /// Adds a task that in every run also waits until `signal` is called for it.
    Node add_event(std::function<void()> body, const ScheduledTask& task);

    /// Lets an event start: to be called once in each run for each event behind its root, before or during the run,
    /// from any thread. Does not wait for the task.
    void signal(Node event);

    /// Makes the present run fail as if a task had thrown this exception; may be called from any thread. Events must
    /// still be signalled.
    void fail(std::exception_ptr failure);

    /// Whether the present run skips the tasks that have not begun; may be called from any thread.
    [[nodiscard]] bool is_ending() const;

    /// Makes `after` wait for `before`.
    void add_dependency(Node before, Node after);

    /// Takes a step: runs all tasks behind a root and waits for them, then calls `join` in this thread.
    /// @param root the number of the root among roots, from 0.
    /// @param further_parts the number of parts that tasks count themselves (see Progress).
    /// @throws the exception of a task; Cancelled if tasks were skipped because the flow is to stop.
    void run(std::size_t root = 0, double further_parts = 0.0, const std::function<void()>& join = {});

    /// The times of all tasks; empty if nothing is recorded.
    [[nodiscard]] const std::optional<Schedule>& schedule() const;

  private:
    Node add(std::function<void()> body, const ScheduledTask& task, int n_signals);
    void run_tasks(Node root, double further_parts);

    class Nodes;
    struct OrderedTask;
    std::unique_ptr<Nodes> nodes_;
};

}  // namespace seamflow
