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
/// Tasks may throw: tasks that have not started by then are skipped, and `run` throws what the task with the lowest
/// number among those that failed has thrown (with several failures, which ones happened depends on timing). The same
/// tasks are skipped when the flow is to stop. The graph can be run again.
class TaskGraph {
  public:
    /// Number of a task or of a root.
    using Node = Index;

    /// @param progress counts the tasks and says whether to stop; must outlive the graph. nullptr: none.
    explicit TaskGraph(Progress* progress = nullptr);
    ~TaskGraph();
    TaskGraph(const TaskGraph&) = delete;
    TaskGraph& operator=(const TaskGraph&) = delete;

    /// A place to start from. A run reaches the tasks behind one root, which are to be added before the next one.
    Node add_root();

    /// A task that starts as soon as all tasks and the root before it are done.
    Node add_task(std::function<void()> body, TaskPriority priority);

    /// A task that in every run also waits for something from outside: until `signal` is called for it.
    Node add_event(std::function<void()> body, TaskPriority priority);

    /// What the event waits for has come: to be called once in each run for each event behind its root, before the run
    /// or while it goes on, by any thread. Does not wait for the task.
    void signal(Node event);

    /// Lets the present run fail as if a task had thrown this; by any thread. Events have to be signalled all the same.
    void fail(std::exception_ptr failure);

    /// Whether the present run leaves out the tasks that have not begun; by any thread.
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
