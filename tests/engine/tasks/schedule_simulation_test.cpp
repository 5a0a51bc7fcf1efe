#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/schedule_simulation.h"
#include "partition/errors.h"

using namespace seamflow;
using Priority = TaskPriority;

namespace {

/// A schedule of one step, recorded with one thread.
Schedule schedule_of(const std::vector<double>& seconds, std::vector<Dependency> dependencies,
                     const std::vector<Priority>& priorities = {})
{
    Schedule schedule;
    double now = 0.0;
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        const auto task = static_cast<Index>(i);
        const bool is_high = !priorities.empty() && priorities[i] == Priority::High;
        schedule.tasks.push_back({is_high ? TaskKind::Solve : TaskKind::AssembleAndFactorise, task});
        schedule.records.push_back({.step = 1, .task = task, .start = now, .end = now + seconds[i]});
        now += seconds[i];
    }
    schedule.dependencies = std::move(dependencies);
    schedule.steps.push_back({0.0, now});
    return schedule;
}

const std::vector<Index> none;

}  // namespace

TEST_CASE("a chain takes as long with any number of workers")
{
    const Schedule chain = schedule_of({1.0, 2.0, 4.0}, {{0, 1}, {1, 2}});
    for (const int workers : {1, 2, 64}) {
        const Simulation simulation = simulate(chain, 1, workers);
        CHECK(simulation.work == 7.0);
        CHECK(simulation.makespan == 7.0);
        CHECK(simulation.critical_path_seconds == 7.0);
        CHECK(simulation.critical_path == std::vector<Index>{0, 1, 2});
        CHECK(simulation.speed_up() == 1.0);
        CHECK(simulation.efficiency() == 1.0 / workers);
    }
}

TEST_CASE("a fork is as fast as its longest branch, once there are workers enough")
{
    const Schedule fork =
        schedule_of({1.0, 2.0, 8.0, 2.0, 2.0, 1.0}, {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 5}, {2, 5}, {3, 5}, {4, 5}});
    CHECK(simulate(fork, 1, 1).makespan == 16.0);
    CHECK(simulate(fork, 1, 1).efficiency() == 1.0);
    // Task 1, then 3 and 4, beside task 2.
    const Simulation two = simulate(fork, 1, 2);
    CHECK(two.makespan == 10.0);
    CHECK(two.efficiency() == 0.8);
    CHECK(simulate(fork, 1, 4).makespan == 10.0);
    CHECK(two.critical_path == std::vector<Index>{0, 2, 5});
    CHECK(two.critical_path_seconds == 10.0);
}

TEST_CASE("of the tasks that are ready the one with priority starts first, and among equals the first")
{
    using enum TaskPriority;
    // One worker is busy with task 0; the other one must take 3, on which the long task 4 waits, before 1 and 2.
    const std::vector<double> seconds{10.0, 2.0, 3.0, 1.0, 8.0};
    CHECK(simulate(schedule_of(seconds, {{3, 4}}, {High, Normal, Normal, High, High}), 1, 2).makespan == 13.0);
    CHECK(simulate(schedule_of(seconds, {{3, 4}}), 1, 2).makespan == 14.0);
    CHECK(simulate(schedule_of({1.0, 1.0, 2.0}, {}), 1, 2).makespan == 3.0);
    CHECK(simulate(schedule_of({1.0, 1.0, 2.0}, {}, {Normal, Normal, High}), 1, 2).makespan == 2.0);
}

TEST_CASE("tasks that end together free what waits for them before the next one starts")
{
    using enum TaskPriority;
    // At 1 both workers are free, and 3 and 4 (after 1, with priority) go before 2 (after 0).
    const Schedule schedule =
        schedule_of({1.0, 1.0, 10.0, 5.0, 5.0}, {{0, 2}, {1, 3}, {1, 4}}, {Normal, Normal, Normal, High, High});
    CHECK(simulate(schedule, 1, 2).makespan == 16.0);
}

TEST_CASE("all workers share the solution on the interface")
{
    Schedule schedule = schedule_of({1.0, 1.0, 8.0, 1.0}, {{0, 2}, {1, 2}, {2, 3}});
    schedule.tasks[2].kind = TaskKind::SolveInterface;
    CHECK(simulate(schedule, 1, 1).makespan == 11.0);
    CHECK(simulate(schedule, 1, 2).makespan == 6.0);
    CHECK(simulate(schedule, 1, 8).makespan == 3.0);
    CHECK(simulate(schedule, 1, 8).work == 11.0);
    // Two threads shared it when it was recorded.
    schedule.records[1].thread = 1;
    CHECK(simulate(schedule, 1, 1).makespan == 19.0);
}

TEST_CASE("only the tasks of the step count")
{
    Schedule schedule = schedule_of({1.0, 2.0, 4.0}, {{0, 1}, {2, 0}});
    schedule.records = {{.step = 1, .task = 0, .start = 0.0, .end = 1.0},
                        {.step = 1, .task = 1, .start = 1.0, .end = 3.0},
                        {.step = 2, .task = 2, .start = 3.0, .end = 7.0},
                        {.step = 3, .task = 0, .start = 7.0, .end = 12.0},
                        {.step = 3, .task = 1, .start = 12.0, .end = 13.0}};
    schedule.steps.resize(4);
    CHECK(simulate(schedule, 1, 2).makespan == 3.0);
    CHECK(simulate(schedule, 2, 2).critical_path == std::vector<Index>{2});
    CHECK(simulate(schedule, 3, 2).makespan == 6.0);
    CHECK(simulate(schedule, 4, 2).makespan == 0.0);
    CHECK(simulate(schedule, 4, 2).critical_path == none);
}

TEST_CASE("steps that were not recorded and no workers are refused")
{
    const Schedule schedule = schedule_of({1.0}, {});
    CHECK_THROWS_AS((void)simulate(schedule, 0, 1), OptionError);
    CHECK_THROWS_AS((void)simulate(schedule, 2, 1), OptionError);
    CHECK_THROWS_AS((void)simulate(schedule, 1, 0), OptionError);
}
