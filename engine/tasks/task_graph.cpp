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
    /// so it is given only a pointer to this.
    struct Task {
        Node node = -1;
        std::function<void()> body;
    };

    ~Nodes() { graph.wait_for_all(); }

    /// Runs a task, or skips it. Exceptions stay inside: a flow graph from which one has escaped starts its next run
    /// with wrong counts.
    void perform(const Task& task);

    /// Starts an event, or lets it begin when the tasks before it are done. An outside thread that did so itself would
    /// wait for a place in the arena.
    void start(Node event)
    {
        arena.enqueue([this, event] {
            nodes[event].try_put(flow::continue_msg());
            graph.release_wait();
        });
    }

    std::deque<Task> tasks;
    /// The arena in which all is constructed: signals come from threads outside it.
    oneapi::tbb::task_arena arena{oneapi::tbb::task_arena::attach()};
    flow::graph graph;
    std::deque<flow::continue_node<flow::continue_msg>> nodes;
    TaskOrder order;
    Progress* progress = nullptr;
    FirstFailure failure;
    /// Set if a task was skipped because the flow was asked to stop. oneTBB's own cancellation would also make the
    /// loops within running tasks skip what they have not begun.
    std::atomic<bool> skipped{false};
    /// For each root.
    std::unordered_map<Node, Index> n_tasks;
    std::unordered_map<Node, Index> n_events;
    /// Guards what follows: signals come from any thread.
    std::mutex mutex;
    bool is_running = false;
    /// The events signalled before the run.
    std::vector<Node> early;
    Node latest_root = -1;
};

void TaskGraph::Nodes::perform(const Task& task)
{
    if (failure.failed())
        return;
    if (progress != nullptr && progress->is_stopped()) {
        skipped.store(true, std::memory_order_relaxed);
        return;
    }
    try {
        task.body();
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
        nodes->order.begin(usize(task->node));
        nodes->perform(*task);
        nodes->order.end(usize(task->node));
        return message;
    }

    Nodes* nodes;
    const Nodes::Task* task;
};

TaskGraph::TaskGraph(Progress* progress)
    : nodes_(std::make_unique<Nodes>())
{
    nodes_->progress = progress;
}

TaskGraph::~TaskGraph() = default;

TaskGraph::Node TaskGraph::add_root()
{
    nodes_->nodes.emplace_back(nodes_->graph, [](const flow::continue_msg& message) { return message; });
    return nodes_->latest_root = static_cast<Node>(nodes_->nodes.size()) - 1;
}

TaskGraph::Node TaskGraph::add(std::function<void()> body, TaskPriority priority, int n_signals)
{
    const auto node = static_cast<Node>(nodes_->nodes.size());
    nodes_->tasks.push_back({node, std::move(body)});
    nodes_->nodes.emplace_back(nodes_->graph, n_signals, OrderedTask{nodes_.get(), &nodes_->tasks.back()},
                               priority == TaskPriority::High ? flow::node_priority_t{1} : flow::no_priority);
    ++nodes_->n_tasks[nodes_->latest_root];
    return node;
}

TaskGraph::Node TaskGraph::add_task(std::function<void()> body, TaskPriority priority)
{
    return add(std::move(body), priority, 0);
}

TaskGraph::Node TaskGraph::add_event(std::function<void()> body, TaskPriority priority)
{
    const Node node = add(std::move(body), priority, 1);
    ++nodes_->n_events[nodes_->latest_root];
    return node;
}

void TaskGraph::signal(Node event)
{
    nodes_->order.come(usize(event));
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
    nodes_->order.add_dependency(usize(before), usize(after));
}

void TaskGraph::run(Node root, double further_parts)
{
    if (nodes_->progress != nullptr)
        nodes_->progress->expect(nodes_->n_tasks[root] + further_parts);
    nodes_->order.end(usize(root));
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
