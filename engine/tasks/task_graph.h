#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <optional>

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
///
/// On request it records what ran when; that allocates only between runs.
class TaskGraph {
  public:
    /// Number of a task or of a root.
    using Node = Index;

    /// @param progress counts the tasks and says whether to stop; must outlive the graph. nullptr: none.
    /// @param is_recorded whether there is a schedule.
    explicit TaskGraph(Progress* progress = nullptr, bool is_recorded = false);
    ~TaskGraph();
    TaskGraph(const TaskGraph&) = delete;
    TaskGraph& operator=(const TaskGraph&) = delete;

    /// A starting point. A run reaches the tasks behind one root, which must be added before the next root.
    Node add_root();

    /// A task that starts as soon as all tasks and the root before it are done.
    /// @param task what it is in the schedule; its kind has a priority. It may run at the same time as others.
    Node add_task(std::function<void()> body, const ScheduledTask& task);

    /// A task that in every run also waits for something from outside: until `signal` is called for it.
    Node add_event(std::function<void()> body, const ScheduledTask& task);

    /// Signals that what the event waits for has come: call once in each run for each event behind its root, before or
    /// during the run, from any thread. Does not wait for the task.
    void signal(Node event);

    /// Makes the present run fail as if a task had thrown this; from any thread. Events must still be signalled.
    void fail(std::exception_ptr failure);

    /// Whether the present run skips the tasks that have not begun; from any thread.
    [[nodiscard]] bool is_ending() const;

    /// Makes `after` wait for `before`.
    void add_dependency(Node before, Node after);

    /// Takes a step: runs all tasks behind a root and waits for them, then calls `join` in this thread.
    /// @param root its number, from 0.
    /// @param further_parts that tasks count themselves (see Progress).
    /// @throws whatever a task has thrown; Cancelled if tasks were skipped because the flow is to stop.
    void run(std::size_t root = 0, double further_parts = 0.0, const std::function<void()>& join = {});

    /// What ran when; empty where nothing is recorded.
    [[nodiscard]] const std::optional<Schedule>& schedule() const;

  private:
    Node add(std::function<void()> body, const ScheduledTask& task, int n_signals);
    void run_tasks(Node root, double further_parts);

    class Nodes;
    struct OrderedTask;
    std::unique_ptr<Nodes> nodes_;
};

}  // namespace seamflow
