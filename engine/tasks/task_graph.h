#pragma once

#include <exception>
#include <functional>
#include <memory>

#include "engine/tasks/schedule.h"
#include "partition/index.h"

namespace seamflow {

class Progress;

/// A graph of tasks with fixed dependencies, built once and run as often as wanted (a oneTBB flow graph of continue
/// nodes). Belongs to the arena in which it is constructed.
///
/// Tasks may throw: tasks that have not started by then are skipped, and `run` rethrows what the lowest-numbered of the
/// failed tasks has thrown (with several failures, which ones happened depends on timing). Tasks are skipped likewise
/// when the flow is to stop. The graph can be run again.
class TaskGraph {
  public:
    /// Number of a task or of a root.
    using Node = Index;

    /// @param progress counts the tasks and says whether to stop; must outlive the graph. nullptr: none.
    explicit TaskGraph(Progress* progress = nullptr);
    ~TaskGraph();
    TaskGraph(const TaskGraph&) = delete;
    TaskGraph& operator=(const TaskGraph&) = delete;

    /// A starting point. A run reaches the tasks behind one root, which must be added before the next root.
    Node add_root();

    /// A task that starts as soon as all tasks and the root before it are done.
    Node add_task(std::function<void()> body, TaskPriority priority);

    /// A task that in every run also waits for something from outside: until `signal` is called for it.
    Node add_event(std::function<void()> body, TaskPriority priority);

    /// Signals that what the event waits for has come: call once in each run for each event behind its root, before or
    /// during the run, from any thread. Does not wait for the task.
    void signal(Node event);

    /// Makes the present run fail as if a task had thrown this; from any thread. Events must still be signalled.
    void fail(std::exception_ptr failure);

    /// Whether the present run skips the tasks that have not begun; from any thread.
    [[nodiscard]] bool is_ending() const;

    /// Makes `after` wait for `before`.
    void add_dependency(Node before, Node after);

    /// Runs all tasks behind a root and waits for them.
    /// @param further_parts that tasks count themselves (see Progress).
    /// @throws whatever a task has thrown; Cancelled if tasks were skipped because the flow is to stop.
    void run(Node root, double further_parts = 0.0);

  private:
    Node add(std::function<void()> body, TaskPriority priority, int n_signals);

    class Nodes;
    struct OrderedTask;
    std::unique_ptr<Nodes> nodes_;
};

}  // namespace seamflow
