#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "partition/errors.h"
#include "samples/report/schedule_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using Json = nlohmann::json;

namespace {

/// Two tasks, one after the other in two threads, and a third one that no step ran.
FlowReport two_tasks()
{
    FlowReport report;
    report.cut.sub_meshes = {{.vertices = 70}, {.vertices = 80}};
    Schedule& schedule = report.schedule.emplace();
    schedule.tasks = {{TaskKind::AssembleAndFactorise, 0}, {TaskKind::Solve, 1}, {TaskKind::Solve, 0}};
    schedule.dependencies = {{0, 1}, {0, 2}};
    schedule.records = {{.step = 1, .task = 0, .thread = 2, .start = 1e-6, .end = 3.5e-6},
                        {.step = 1, .task = 1, .thread = 0, .start = 3.5e-6, .end = 1.0},
                        {.step = 2, .task = 0, .thread = 2, .start = 3600.0, .end = 3600.000000001}};
    schedule.steps = {{0.0, 1.25}, {3600.0, 3601.0}};
    return report;
}

/// The events of one kind.
std::vector<Json> events(const Json& trace, const std::string& kind)
{
    std::vector<Json> found;
    for (const Json& event : trace["traceEvents"])
        if (event["ph"] == kind)
            found.push_back(event);
    return found;
}

Json traced(const FlowReport& report)
{
    const test::TemporaryDirectory directory;
    write_schedule_trace(directory / "trace.json", report);
    return Json::parse(test::content_of(directory / "trace.json"));
}

}  // namespace

TEST_CASE("a trace has a slice per task, in microseconds, with its arguments")
{
    const Json trace = traced(two_tasks());
    const auto slices = events(trace, "X");
    REQUIRE(slices.size() == 2 * 2 + 3);
    const Json expected = {{"ph", "X"},     {"pid", 1},
                           {"tid", 3},      {"ts", 1.0},
                           {"dur", 2.5},    {"name", "assemble and factorise 0"},
                           {"cat", "task"}, {"args", {{"step", 1}, {"sub-mesh", 0}, {"vertices", 70}}}};
    CHECK(slices[4] == expected);
    CHECK(slices[5]["name"] == "solve 1");
    CHECK(slices[5]["args"]["vertices"] == 80);
    CHECK(slices[6]["ts"] == 3.6e9);
    CHECK(slices[6]["dur"] == 0.001);
}

TEST_CASE("a trace has a row for the steps, and after their last tasks the join")
{
    const Json trace = traced(two_tasks());
    const auto slices = events(trace, "X");
    CHECK(slices[0]["name"] == "step 1");
    CHECK(slices[0]["dur"] == 1.25e6);
    CHECK(slices[1]["name"] == "join");
    CHECK(slices[1]["ts"] == 1e6);
    CHECK(slices[1]["dur"] == 0.25e6);
    std::map<int, std::string> rows;
    for (const Json& event : events(trace, "M"))
        if (event["name"] == "thread_name")
            rows[event["tid"]] = event["args"]["name"];
    CHECK(rows == std::map<int, std::string>{{1, "thread 0"}, {3, "thread 2"}, {4, "steps"}});
    CHECK(slices[0]["tid"] == 4);
    CHECK(trace["traceEvents"][0]["name"] == "process_name");
}

TEST_CASE("a trace has an arrow for each dependency of a step, from slice to slice")
{
    const Json trace = traced(two_tasks());
    const auto starts = events(trace, "s");
    const auto ends = events(trace, "f");
    REQUIRE(starts.size() == 1);
    REQUIRE(ends.size() == 1);
    CHECK(starts[0]["id"] == ends[0]["id"]);
    CHECK(starts[0]["tid"] == 3);
    CHECK(starts[0]["ts"] == 3.499);
    CHECK(ends[0]["tid"] == 1);
    CHECK(ends[0]["ts"] == 3.5);
    CHECK(ends[0]["bp"] == "e");
}

TEST_CASE("a trace of nothing is valid, and one that cannot be written is an error")
{
    FlowReport report;
    report.schedule.emplace();
    CHECK(events(traced(report), "X").empty());
    CHECK_THROWS_AS(write_schedule_trace("/dev/full", report), OutputError);
}

TEST_CASE("a task graph has a node per task and an arrow per dependency")
{
    const test::TemporaryDirectory directory;
    write_task_graph(directory / "graph.dot", two_tasks());
    CHECK(test::content_of(directory / "graph.dot") == "digraph step {\n"
                                                       "    node [shape=box]\n"
                                                       "    0 [label=\"assemble and factorise 0\"]\n"
                                                       "    1 [label=\"solve 1\"]\n"
                                                       "    2 [label=\"solve 0\"]\n"
                                                       "    0 -> 1\n"
                                                       "    0 -> 2\n"
                                                       "}\n");
    CHECK_THROWS_AS(write_task_graph("/dev/full", two_tasks()), OutputError);
}
