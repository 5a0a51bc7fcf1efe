#include "engine/tasks/task_graph.h"

#include <atomic>
#include <deque>
#include <exception>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/task_arena.h>

#include "engine/tasks/progress.h"
#include "engine/tasks/stopwatch.h"
#include "partition/errors.h"
#include "solvers/platform/thread_sanitizer.h"

namespace seamflow {

namespace {

namespace flow = oneapi::tbb::flow;

}  // namespace

class TaskGraph::Nodes {
  public:
    /// The failure of the task with the lowest number.
    class FirstFailure {
      public:
        void record(TaskGraph::Node node, std::exception_ptr thrown)
        {
            const std::lock_guard lock(mutex_);
            if (!failure_ || node < node_)
                failure_ = std::move(thrown), node_ = node;
            failed_.store(true, std::memory_order_release);
        }

        [[nodiscard]] bool failed() const { return failed_.load(std::memory_order_acquire); }

        /// Throws the failure, if there is one, and forgets it.
        void rethrow()
        {
            failed_.store(false, std::memory_order_release);
            if (auto thrown = std::exchange(failure_, nullptr))
                std::rethrow_exception(thrown);
        }

      private:
        std::mutex mutex_;
        std::atomic<bool> failed_{false};
        std::exception_ptr failure_;
        TaskGraph::Node node_ = -1;
    };

    /// The work at a node. oneTBB copies the body of a node, and loses a copy if there is no memory for the next one:
    /// it is given only a pointer to this struct.
    struct Task {
        Node node = -1;
        Index number = 0;
        std::function<void()> body;
    };

    ~Nodes() { graph.wait_for_all(); }

    /// Runs the body of a task, and records the times, unless it throws.
    void run(const Task& task);

    /// Runs a task, or skips it. Exceptions are caught here: a flow graph from which one has escaped starts its next
    /// run with wrong counts.
    void perform(const Task& task);

    /// Starts an event, or lets it begin when the tasks before it are done. The call is made within the arena: a thread
    /// outside it would wait for a slot of the arena.
    void start(Node event)
    {
        arena.enqueue([this, event] {
            nodes[event].try_put(flow::continue_msg());
            graph.release_wait();
        });
    }

    /// Begins the records of a step.
    void begin_record()
    {
        running.assign(schedule->tasks.size(), {});
        if (schedule->steps.empty())
            clock = Stopwatch();
        schedule->steps.push_back({.start = clock.seconds()});
    }

    /// Adds the records of the step, in the order of tasks, to the schedule.
    void end_record()
    {
        schedule->steps.back().end = clock.seconds();
        for (const TaskRecord& record : running)
            if (record.step > 0)
                schedule->records.push_back(record);
    }

    std::deque<Task> tasks;
    /// Number of the task at each node; -1 at roots.
    std::vector<Index> task_of_node;
    std::optional<Schedule> schedule;
    /// Begins with the first step.
    Stopwatch clock;
    /// One per task, for the present step; step 0: the task has not run.
    std::vector<TaskRecord> running;
    /// The arena in which all members are constructed: signals come from threads outside it.
    oneapi::tbb::task_arena arena{oneapi::tbb::task_arena::attach()};
    flow::graph graph;
    std::deque<flow::continue_node<flow::continue_msg>> nodes;
    /// Tells the thread sanitizer in which order tasks run.
    TaskOrder order;
    Progress* progress = nullptr;
    FirstFailure failure;
    /// Set if a task was skipped because the flow was asked to stop. oneTBB's own cancellation would also make loops
    /// within running tasks skip the ranges that have not begun.
    std::atomic<bool> skipped{false};
    /// The numbers of tasks and of events behind each root.
    std::unordered_map<Node, Index> n_tasks;
    std::unordered_map<Node, Index> n_events;
    /// Guards the following two members, because signals come from any thread.
    std::mutex mutex;
    bool is_running = false;
    /// The events signalled before the run.
    std::vector<Node> early;
    /// In the order in which they were added; not guarded, because they change only while the graph is built.
    std::vector<Node> roots;
};

void TaskGraph::Nodes::run(const Task& task)
{
    if (!schedule)
        return task.body();
    const double start = clock.seconds();
    task.body();
    running[task.number] = {.step = static_cast<int>(schedule->steps.size()),
                            .task = task.number,
                            .thread = oneapi::tbb::this_task_arena::current_thread_index(),
                            .start = start,
                            .end = clock.seconds()};
}

void TaskGraph::Nodes::perform(const Task& task)
{
    if (failure.failed())
        return;
    if (progress != nullptr && progress->is_stopped()) {
        skipped.store(true, std::memory_order_relaxed);
        return;
    }
    try {
        run(task);
        if (progress != nullptr)
            progress->count();
    } catch (...) {
        failure.record(task.node, std::current_exception());
    }
}

/// The body of a node of the oneTBB graph.
struct TaskGraph::OrderedTask {
    flow::continue_msg operator()(const flow::continue_msg& message) const
    {
        nodes->order.begin(task->node);
        nodes->perform(*task);
        nodes->order.end(task->node);
        return message;
    }

    Nodes* nodes;
    const Nodes::Task* task;
};

TaskGraph::TaskGraph(Progress* progress, bool is_recorded)
    : nodes_(std::make_unique<Nodes>())
{
    nodes_->progress = progress;
    if (is_recorded)
        nodes_->schedule.emplace();
}

TaskGraph::~TaskGraph() = default;

TaskGraph::Node TaskGraph::add_root()
{
    nodes_->nodes.emplace_back(nodes_->graph, [](const flow::continue_msg& message) { return message; });
    nodes_->task_of_node.push_back(-1);
    nodes_->roots.push_back(static_cast<Node>(nodes_->nodes.size()) - 1);
    return nodes_->roots.back();
}

/// Adds a task behind the last root.
/// @param n_signals the number of signals that the task waits for besides the tasks before it.
TaskGraph::Node TaskGraph::add(std::function<void()> body, const ScheduledTask& task, int n_signals)
{
    const auto node = static_cast<Node>(nodes_->nodes.size());
    const auto number = static_cast<Index>(nodes_->tasks.size());
    nodes_->tasks.push_back({node, number, std::move(body)});
    nodes_->task_of_node.push_back(number);
    if (nodes_->schedule)
        nodes_->schedule->tasks.push_back(task);
    nodes_->nodes.emplace_back(nodes_->graph, n_signals, OrderedTask{nodes_.get(), &nodes_->tasks.back()},
                               has_priority(task.kind) ? flow::node_priority_t{1} : flow::no_priority);
    ++nodes_->n_tasks[nodes_->roots.back()];
    return node;
}

TaskGraph::Node TaskGraph::add_task(std::function<void()> body, const ScheduledTask& task)
{
    return add(std::move(body), task, 0);
}

TaskGraph::Node TaskGraph::add_event(std::function<void()> body, const ScheduledTask& task)
{
    const Node node = add(std::move(body), task, 1);
    ++nodes_->n_events[nodes_->roots.back()];
    return node;
}

void TaskGraph::signal(Node event)
{
    nodes_->order.come(event);
    const std::scoped_lock lock(nodes_->mutex);
    if (nodes_->is_running)
        nodes_->start(event);
    else
        nodes_->early.push_back(event);
}

void TaskGraph::fail(std::exception_ptr failure)
{
    nodes_->failure.record(-1, std::move(failure));
}

bool TaskGraph::is_ending() const
{
    return nodes_->failure.failed() || (nodes_->progress != nullptr && nodes_->progress->is_stopped());
}

void TaskGraph::add_dependency(Node before, Node after)
{
    flow::make_edge(nodes_->nodes[before], nodes_->nodes[after]);
    nodes_->order.add_dependency(before, after);
    if (nodes_->schedule && nodes_->task_of_node[before] >= 0)
        nodes_->schedule->dependencies.push_back({nodes_->task_of_node[before], nodes_->task_of_node[after]});
}

void TaskGraph::run(std::size_t root, double further_parts, const std::function<void()>& join)
{
    if (nodes_->schedule)
        nodes_->begin_record();
    run_tasks(nodes_->roots[root], further_parts);
    if (join)
        join();
    if (nodes_->schedule)
        nodes_->end_record();
}

const std::optional<Schedule>& TaskGraph::schedule() const
{
    return nodes_->schedule;
}

/// Runs all tasks behind a root, and waits for them.
/// @throws as TaskGraph::run.
void TaskGraph::run_tasks(Node root, double further_parts)
{
    if (nodes_->progress != nullptr)
        nodes_->progress->expect(nodes_->n_tasks[root] + further_parts);
    nodes_->order.end(root);
    // The run ends only after every event has been signalled (see Nodes::start).
    for (Index i = 0; i < nodes_->n_events[root]; ++i)
        nodes_->graph.reserve_wait();
    {
        const std::scoped_lock lock(nodes_->mutex);
        nodes_->is_running = true;
        for (const Node event : std::exchange(nodes_->early, {}))
            nodes_->start(event);
    }
    nodes_->nodes[root].try_put(flow::continue_msg());
    nodes_->graph.wait_for_all();
    {
        const std::scoped_lock lock(nodes_->mutex);
        nodes_->is_running = false;
    }
    nodes_->order.end_run();
    const bool skipped = nodes_->skipped.exchange(false, std::memory_order_relaxed);
    nodes_->failure.rethrow();
    if (skipped)
        throw Cancelled("the flow was stopped in the middle of a step");
}

}  // namespace seamflow
