#include "engine/task_graph.h"

#include <atomic>
#include <deque>
#include <exception>
#include <mutex>
#include <unordered_map>
#include <utility>

#include <oneapi/tbb/flow_graph.h>

#include "engine/progress.h"
#include "engine/schedule_recorder.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

namespace flow = oneapi::tbb::flow;

/// The failure of the task with the lowest number.
class FirstFailure {
  public:
    void record(TaskGraph::Node node, std::exception_ptr failure)
    {
        const std::lock_guard lock(mutex_);
        if (!failure_ || node < node_)
            failure_ = std::move(failure), node_ = node;
        failed_.store(true, std::memory_order_release);
    }

    [[nodiscard]] bool failed() const { return failed_.load(std::memory_order_acquire); }

    /// Forgets the failure, if there is one, by throwing it.
    void rethrow()
    {
        failed_.store(false, std::memory_order_release);
        if (auto failure = std::exchange(failure_, nullptr))
            std::rethrow_exception(failure);
    }

  private:
    std::mutex mutex_;
    std::atomic<bool> failed_{false};
    std::exception_ptr failure_;
    TaskGraph::Node node_ = -1;
};

}  // namespace

class TaskGraph::Nodes {
  public:
    /// What a node runs. oneTBB copies what a node is given, and loses a copy where memory lacks for the next one: so
    /// it is given no more than where this is.
    struct Task {
        Node node = -1;
        std::function<void()> body;
    };

    ~Nodes() { graph.wait_for_all(); }

    std::deque<Task> tasks;
    flow::graph graph;
    std::deque<flow::continue_node<flow::continue_msg>> nodes;
    FirstFailure failure;
    /// Set where a task was not run because the flow is to stop. oneTBB's own cancellation would also make the loops
    /// within running tasks leave out what they have not begun.
    std::atomic<bool> skipped{false};
    /// Of each root.
    std::unordered_map<Node, Index> n_tasks;
    Node latest_root = -1;
};

TaskGraph::TaskGraph(ScheduleRecorder* recorder, Progress* progress)
    : nodes_(std::make_unique<Nodes>())
    , recorder_(recorder)
    , progress_(progress)
{
}

TaskGraph::~TaskGraph() = default;

TaskGraph::Node TaskGraph::add_root()
{
    nodes_->nodes.emplace_back(nodes_->graph, [](const flow::continue_msg& message) { return message; });
    return nodes_->latest_root = static_cast<Node>(nodes_->nodes.size()) - 1;
}

TaskGraph::Node TaskGraph::add_task(std::function<void()> body, Priority priority)
{
    const auto node = static_cast<Node>(nodes_->nodes.size());
    nodes_->tasks.push_back({node, std::move(body)});
    // Exceptions stay inside: a flow graph that one has left starts its next run with wrong counts.
    auto guarded = [nodes = nodes_.get(), recorder = recorder_, progress = progress_,
                    task = &nodes_->tasks.back()](const flow::continue_msg& message) {
        FirstFailure* const failure = &nodes->failure;
        if (failure->failed())
            return message;
        if (progress != nullptr && progress->is_stopped()) {
            nodes->skipped.store(true, std::memory_order_relaxed);
            return message;
        }
        try {
            recorder != nullptr ? recorder->timed(task->node, task->body) : task->body();
            if (progress != nullptr)
                progress->count();
        } catch (...) {
            failure->record(task->node, std::current_exception());
        }
        return message;
    };
    nodes_->nodes.emplace_back(nodes_->graph, std::move(guarded),
                               priority == Priority::High ? flow::node_priority_t{1} : flow::no_priority);
    ++nodes_->n_tasks[nodes_->latest_root];
    return node;
}

void TaskGraph::add_dependency(Node before, Node after)
{
    flow::make_edge(nodes_->nodes[at(before)], nodes_->nodes[at(after)]);
    if (recorder_ != nullptr)
        recorder_->add_dependency(before, after);
}

void TaskGraph::run(Node root, double further_parts)
{
    if (progress_ != nullptr)
        progress_->expect(nodes_->n_tasks[root] + further_parts);
    nodes_->nodes[at(root)].try_put(flow::continue_msg());
    nodes_->graph.wait_for_all();
    const bool skipped = nodes_->skipped.exchange(false, std::memory_order_relaxed);
    nodes_->failure.rethrow();
    if (skipped)
        throw Cancelled("the flow was stopped in the middle of a step");
}

}  // namespace seamflow
