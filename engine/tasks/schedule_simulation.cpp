#include "engine/tasks/schedule_simulation.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

/// The tasks that ran in a step, numbered from 0 in the order of their numbers in the schedule.
struct TasksOfStep {
    std::vector<Index> task;
    /// Those of tasks that all workers share: of all workers together.
    std::vector<double> seconds;
    std::vector<std::uint8_t> is_shared;
    std::vector<TaskPriority> priority;
    std::vector<std::vector<Index>> before;
    std::vector<std::vector<Index>> after;

    [[nodiscard]] Index size() const { return static_cast<Index>(task.size()); }
};

std::span<const TaskRecord> records_of(const Schedule& schedule, int step)
{
    if (step < 1 || at(step) > schedule.steps.size())
        throw OptionError(
            fmt::format("step {} is not in the schedule, which has {} steps", step, schedule.steps.size()));
    const auto first = std::ranges::lower_bound(schedule.records, step, {}, &TaskRecord::step);
    const auto last = std::ranges::upper_bound(schedule.records, step, {}, &TaskRecord::step);
    return {first, last};
}

TasksOfStep graph_of(const Schedule& schedule, int step)
{
    TasksOfStep graph;
    std::vector<Index> place(schedule.tasks.size(), -1);
    const std::span<const TaskRecord> records = records_of(schedule, step);
    const int recorded_with =
        records.empty() ? 1 : std::ranges::max_element(records, {}, &TaskRecord::thread)->thread + 1;
    for (const TaskRecord& record : records) {
        const bool is_shared = schedule.tasks[record.task].kind == TaskKind::SolveInterface;
        place[record.task] = graph.size();
        graph.task.push_back(record.task);
        graph.seconds.push_back((record.end - record.start) * (is_shared ? recorded_with : 1));
        graph.is_shared.push_back(is_shared ? 1 : 0);
        graph.priority.push_back(priority_of(schedule.tasks[record.task].kind));
    }
    graph.before.resize(graph.task.size());
    graph.after.resize(graph.task.size());
    for (const Dependency& dependency : schedule.dependencies) {
        const Index before = place[dependency.before];
        const Index after = place[dependency.after];
        if (before < 0 || after < 0)
            continue;
        graph.before[after].push_back(before);
        graph.after[before].push_back(after);
    }
    return graph;
}

/// When each task ends, in seconds since the first one starts.
class ListSchedule {
  public:
    /// @param sharing the number of workers that share a task which all of them share.
    ListSchedule(const TasksOfStep& graph, int workers, int sharing)
        : end(graph.task.size(), 0.0)
        , graph_(&graph)
        , sharing_(sharing)
        , idle_(workers)
    {
        for (Index i = 0; i < graph.size(); ++i) {
            waits_for_.push_back(graph.before[i].size());
            if (waits_for_.back() == 0)
                make_ready(i);
        }
        start_tasks();
        while (!running_.empty()) {
            makespan = running_.top().first;
            while (!running_.empty() && running_.top().first == makespan)
                finish_task();
            start_tasks();
        }
    }

    std::vector<double> end;
    double makespan = 0.0;

  private:
    template <class Value>
    using SmallestFirst = std::priority_queue<Value, std::vector<Value>, std::greater<>>;

    void make_ready(Index i) { ready_.emplace(graph_->priority[i] == TaskPriority::High ? 0 : 1, i); }

    void start_tasks()
    {
        for (; idle_ > 0 && !ready_.empty(); --idle_) {
            const Index i = ready_.top().second;
            ready_.pop();
            end[i] = makespan + graph_->seconds[i] / (graph_->is_shared[i] != 0 ? sharing_ : 1);
            running_.emplace(end[i], i);
        }
    }

    void finish_task()
    {
        for (const Index next : graph_->after[running_.top().second])
            if (--waits_for_[next] == 0)
                make_ready(next);
        running_.pop();
        ++idle_;
    }

    const TasksOfStep* graph_;
    int sharing_;
    int idle_;
    std::vector<std::size_t> waits_for_;
    /// 0: high, 1: normal priority.
    SmallestFirst<std::pair<int, Index>> ready_;
    /// By their end.
    SmallestFirst<std::pair<double, Index>> running_;
};

/// With a worker for each task, a waiting task starts when the last one that it waits for ends.
void find_critical_path(const TasksOfStep& graph, Simulation& simulation)
{
    const ListSchedule unlimited(graph, graph.size(), std::numeric_limits<int>::max());
    simulation.critical_path_seconds = unlimited.makespan;
    const auto ends_earlier = [&](Index a, Index b) { return unlimited.end[a] < unlimited.end[b]; };
    const auto last = std::max_element(unlimited.end.begin(), unlimited.end.end());
    auto i = static_cast<Index>(last - unlimited.end.begin());
    simulation.critical_path.push_back(graph.task[i]);
    while (!graph.before[i].empty()) {
        i = *std::max_element(graph.before[i].begin(), graph.before[i].end(), ends_earlier);
        simulation.critical_path.push_back(graph.task[i]);
    }
    std::reverse(simulation.critical_path.begin(), simulation.critical_path.end());
}

}  // namespace

double Simulation::speed_up() const
{
    return makespan > 0.0 ? work / makespan : 1.0;
}

double Simulation::efficiency() const
{
    return speed_up() / workers;
}

Simulation simulate(const Schedule& schedule, int step, int workers)
{
    if (workers < 1)
        throw OptionError(fmt::format("workers is {}, but must be at least 1", workers));
    const TasksOfStep graph = graph_of(schedule, step);
    Simulation simulation;
    simulation.workers = workers;
    for (const double seconds : graph.seconds)
        simulation.work += seconds;
    simulation.makespan = ListSchedule(graph, workers, workers).makespan;
    if (graph.size() > 0)
        find_critical_path(graph, simulation);
    return simulation;
}

}  // namespace seamflow
