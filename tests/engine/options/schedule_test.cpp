#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"

using namespace seamflow;

namespace {

FlowOptions recorded(int threads, int steps = 4)
{
    FlowOptions options;
    options.accuracy.approach = Approach::Sweep;
    options.time_step = 0.001;
    options.steps = steps;
    options.cut.subdomains = 24;
    options.resources.threads = threads;
    options.report.record_schedule = true;
    return options;
}

/// The schedule of a flow of 3000 vertices.
struct Recorded {
    explicit Recorded(const FlowOptions& options)
    {
        PolygonMesh mesh = make_mixed_polygons(3000);
        report = mean_curvature_flow(mesh, options);
        REQUIRE(report.schedule);
    }

    [[nodiscard]] const Schedule& schedule() const { return *report.schedule; }

    FlowReport report;
};

}  // namespace

TEST_CASE("every sub-mesh has each of its tasks once in each step")
{
    for (const int threads : {1, 2, 5}) {
        const Recorded flow(recorded(threads));
        std::set<std::pair<int, Index>> ran;
        std::map<TaskKind, Index> count;
        std::set<std::tuple<int, TaskKind, Index>> done;
        for (const TaskRecord& record : flow.schedule().records) {
            const ScheduledTask& task = flow.schedule().tasks[record.task];
            CHECK(ran.emplace(record.step, record.task).second);
            CHECK(done.emplace(record.step, task.kind, task.sub_mesh).second);
            CHECK(task.sub_mesh < flow.report.cut.n_sub_meshes());
            ++count[task.kind];
        }
        const Index all = 4 * flow.report.cut.n_sub_meshes();
        CHECK(count[TaskKind::AssembleAndFactorise] == all);
        CHECK(count[TaskKind::Solve] == all);
        CHECK(count[TaskKind::Accept] == all);
        CHECK(count[TaskKind::Predict] > 0);
        CHECK(count[TaskKind::UsePredictions] > 0);
        // Forward sweeps and backward sweeps have tasks of their own, and each runs in every second step.
        CHECK(flow.schedule().records.size() == 2 * flow.schedule().tasks.size());
        CHECK(flow.schedule().steps.size() == 4);
    }
}

TEST_CASE("records respect the dependencies and their steps, and a thread does one thing at a time")
{
    for (const int threads : {1, 2, 5}) {
        const Recorded flow(recorded(threads));
        const Schedule& schedule = flow.schedule();
        std::map<std::pair<int, Index>, const TaskRecord*> ran;
        std::map<int, std::vector<std::pair<double, double>>> by_thread;
        for (const TaskRecord& record : schedule.records) {
            ran[{record.step, record.task}] = &record;
            by_thread[record.thread].emplace_back(record.start, record.end);
            CHECK(record.start >= schedule.steps[record.step - 1].start);
            CHECK(record.end <= schedule.steps[record.step - 1].end);
            CHECK(record.start < record.end);
        }
        std::size_t compared = 0;
        for (int step = 1; step <= 4; ++step)
            for (const auto& [before, after] : schedule.dependencies)
                if (ran.contains({step, before}) && ran.contains({step, after})) {
                    CHECK(ran[{step, before}]->end <= ran[{step, after}]->start);
                    ++compared;
                }
        CHECK(compared == 2 * schedule.dependencies.size());
        CHECK(by_thread.size() <= usize(threads));
        CHECK(by_thread.begin()->first >= 0);
        for (auto& [thread, spans] : by_thread) {
            std::sort(spans.begin(), spans.end());
            for (std::size_t i = 1; i < spans.size(); ++i)
                CHECK(spans[i - 1].second <= spans[i].first);
        }
    }
}

TEST_CASE("records are in the order of steps and tasks")
{
    const Recorded flow(recorded(2));
    CHECK(std::ranges::is_sorted(flow.schedule().records, {},
                                 [](const TaskRecord& record) { return std::pair(record.step, record.task); }));
}

TEST_CASE("without being asked a flow records nothing, and explicit steps have no tasks")
{
    PolygonMesh mesh = make_quads(400);
    FlowOptions options = recorded(1);
    options.report.record_schedule = false;
    CHECK_FALSE(mean_curvature_flow(mesh, options).schedule);
    options.report.record_schedule = true;
    options.steps = 0;
    CHECK(mean_curvature_flow(mesh, options).schedule->records.empty());
    options.scheme = Scheme::ExplicitEuler;
    CHECK_FALSE(mean_curvature_flow(mesh, options).schedule);
}
