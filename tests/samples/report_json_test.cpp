#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <unistd.h>

#include "partition/version.h"
#include "samples/report/report_json.h"

using namespace seamflow;
using Json = nlohmann::json;

namespace {

/// The report of a run that is complete.
std::string json_of_run(RunRecord run, const AllOptions& options, const FlowReport& report)
{
    run.names = flow_names(options, static_cast<int>(report.steps.size()));
    complete_record(run, report);
    return smooth_report_json(run, options, report);
}

}  // namespace

TEST_CASE("the numbers of a report read back to the same double")
{
    FlowReport report;
    report.time_step = 0.1 + 0.2;
    report.cut.sub_meshes = {{.p = 1.0 / 3.0}, {.p = 6.2993055940947205}};
    StepReport step;
    step.max_mean_curvature_after = 1e-300;
    step.distance = VertexDistance{0.1, 0.2, 0.3, 0.7};
    report.steps = {step, StepReport{}};
    const Json json = Json::parse(json_of_run(RunRecord{}, FlowOptions{}, report));
    CHECK(json["time_step"].get<double>() == report.time_step);
    CHECK(json["p"].get<std::vector<double>>() == std::vector<double>{1.0 / 3.0, 6.2993055940947205});
    CHECK(json["steps"][0]["max_mean_curvature_after"].get<double>() == 1e-300);
    CHECK(json["steps"][0]["v_mean"].get<double>() == 0.1 / 0.7);
    CHECK(json["steps"][0]["v_max_absolute"].get<double>() == 0.3);
    CHECK_FALSE(json["steps"][1].contains("v_mean"));
    CHECK(json["peak_memory_bytes"].get<std::int64_t>() > 0);
}

TEST_CASE("a report counts the pages of memory that were touched for the first time")
{
    const auto faults = [] {
        return Json::parse(json_of_run(RunRecord{}, FlowOptions{}, FlowReport{}))["page_faults"].get<std::int64_t>();
    };
    constexpr std::int64_t n_pages = 1000;
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    void* const memory = ::mmap(nullptr, n_pages * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    REQUIRE(memory != MAP_FAILED);
    static_cast<void>(::madvise(memory, n_pages * page, MADV_NOHUGEPAGE));
    const std::int64_t before = faults();
    std::fill_n(static_cast<volatile char*>(memory), n_pages * page, 'a');
    CHECK(faults() - before >= n_pages);
    ::munmap(memory, n_pages * page);
}

TEST_CASE("a report tells how many converged steps missed their tolerance, and which of them stagnated")
{
    FlowReport report;
    const Json of_sweeps = Json::parse(json_of_run(RunRecord{}, FlowOptions{}, report));
    for (const char* key : {"tolerance", "steps_short_of_tolerance", "steps_stagnated"})
        CHECK_FALSE(of_sweeps.contains(key));
    report.convergence.tolerance = 1e-9;
    const Json all_reached = Json::parse(json_of_run(RunRecord{}, FlowOptions{}, report));
    CHECK(all_reached["tolerance"] == 1e-9);
    CHECK(all_reached["steps_short_of_tolerance"] == 0);
    CHECK(all_reached["steps_stagnated"] == 0);
    report.convergence.steps_short_of_tolerance = 5;
    report.convergence.steps_stagnated = 3;
    const Json missed = Json::parse(json_of_run(RunRecord{}, FlowOptions{}, report));
    CHECK(missed["steps_short_of_tolerance"] == 5);
    CHECK(missed["steps_stagnated"] == 3);
}

TEST_CASE("a report is valid JSON whatever happened")
{
    FlowReport report;
    report.time_step = std::numeric_limits<double>::quiet_NaN();
    // Where nothing was smoothed there is no amount.
    CHECK_FALSE(Json::parse(json_of_run(RunRecord{}, FlowOptions{}, report)).contains("time_step"));
    report.steps = {StepReport{}};
    report.cut.sub_meshes = {{.p = std::numeric_limits<double>::infinity()}};
    RunRecord run;
    run.input = "\xff.obj";
    report.choices = {std::string("a choice")};
    report.remarks = {{"a kind", {{"height", 0.5}}, {"a \"remark\"\n on <radius 3>"}}};
    run.surface.after = {
        .area = std::numeric_limits<double>::infinity(), .volume = 2.0, .roughness = Roughness{3.0, 4.0}};
    run.surface.moved = {.mean = 1.0, .rms = 2.0, .max = 3.0};
    const Json json = Json::parse(json_of_run(run, FlowOptions{}, report));
    CHECK(json["time_step"].is_null());
    CHECK(json["p"][0].is_null());
    CHECK(json["choices"][0]["text"] == "a choice");
    CHECK(json["surface"]["before"]["volume"].is_null());
    CHECK(json["surface"]["after"]["area"].is_null());
    CHECK(json["surface"]["after"]["volume"] == 2.0);
    CHECK(json["surface"]["after"]["roughness_percentile_95"] == 4.0);
    CHECK(json["surface"]["moved_max_absolute"] == 3.0);

    CHECK(json["remarks"][0]["text"] == "a \"remark\"\n on --radius 3");
    CHECK(json["remarks"][0]["kind"] == "a kind");
    CHECK(json["remarks"][0]["numbers"]["height"] == 0.5);
    Comparison comparison;
    comparison.vertex_distance.emplace();
    const Json without_edges = Json::parse(compare_report_json(comparison));
    CHECK(without_edges["v_mean"].is_null());
    CHECK(without_edges["v_mean_absolute"] == 0.0);
}

TEST_CASE("displacements are in mean edge lengths of the input")
{
    FlowReport report;
    StepReport step;
    step.displacement = {.tangential = {1.0, 2.0, 3.0}, .normal = {4.0, 5.0, 6.0}};
    report.steps = {step};
    report.displacement = {.path = step.displacement, .drift = {0.5, 0.25, 7.0}};
    RunRecord run;
    run.scale.mean_edge = 2.0;
    const Json json = Json::parse(json_of_run(run, FlowOptions{}, report));
    CHECK_FALSE(json.contains("region"));
    CHECK(json["steps"][0]["tangential_mean"] == 0.5);
    CHECK(json["steps"][0]["tangential_rms"] == 1.0);
    CHECK(json["steps"][0]["normal_max"] == 3.0);
    CHECK(json["displacement"]["normal_mean"] == 2.0);
    CHECK(json["displacement"]["drift_max"] == 3.5);
}

TEST_CASE("the report says how vertices were to move")
{
    AllOptions options;
    options.keep_edges = 30.0;
    options.motion = {.attachment = 0.25, .attachment_weights = {1.0, 2.0}, .strength = {0.0, 1.0}};
    const Json json = Json::parse(json_of_run(RunRecord{}, options, FlowReport{}));
    CHECK(json["region"] == true);
    CHECK(json["attachment"] == 0.25);
    CHECK(json["attachment_weights"] == true);
    CHECK(json["keep_edges"] == 30.0);
}

TEST_CASE("the report of compare has what was measured, and nothing else")
{
    Comparison comparison;
    comparison.mean_edge = 2.0;
    comparison.direction = Direction::Both;
    comparison.surface_distance = LengthStatistics{1.0, 2.0, 3.0};
    comparison.surface_distance_back = LengthStatistics{4.0, 5.0, 6.0};
    comparison.remarks = {"V_ is left out."};
    const Json json = Json::parse(compare_report_json(comparison));
    CHECK(json["direction"] == "both");
    CHECK(json["h_mean"] == 0.5);
    CHECK(json["h_rms_absolute"] == 2.0);
    CHECK(json["h_max"] == 1.5);
    CHECK(json["h_back_max_absolute"] == 6.0);
    CHECK(json["remarks"].size() == 1);
    CHECK_FALSE(json.contains("v_mean"));
    CHECK_FALSE(json.contains("tangential_mean"));
}

TEST_CASE("reports say by which version they were made, when, and which keys they have")
{
    for (const std::string& text :
         {json_of_run(RunRecord{}, FlowOptions{}, FlowReport{}), smooth_failure_json(RunRecord{}, Failure{})}) {
        const Json json = Json::parse(text);
        CHECK(json["schema"] == 3);
        CHECK(json["version"] == std::string(version));
        const std::string date = json["date"];
        REQUIRE(date.size() == 20);
        CHECK(date.starts_with("20"));
        CHECK(date.substr(10, 1) == "T");
        CHECK(date.ends_with("Z"));
    }
}

TEST_CASE("the table of steps has a row for each, and a column for all that any has, numbers to the last bit")
{
    FlowReport report;
    report.cut.sub_meshes = {{.p = 3.25}, {.p = 0.1}, {.p = 7.0}};
    StepReport first;
    first.seconds = 0.1 + 0.2;
    first.max_mean_curvature_after = std::numeric_limits<double>::infinity();
    StepReport second;
    second.iterations = 12;
    second.distance = VertexDistance{0.1, 0.2, 0.3, 0.5};
    second.surface_distance = LengthStatistics{0.05, 0.1, 0.25};
    report.steps = {first, second};
    RunRecord run;
    run.scale.mean_edge = 1.0;
    const std::string csv = steps_csv(json_of_run(run, FlowOptions{}, report));
    std::istringstream lines(csv);
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(lines, line);) {
        rows.emplace_back();
        std::istringstream cells(line + ",");
        for (std::string cell; std::getline(cells, cell, ',');)
            rows.back().push_back(cell);
    }
    REQUIRE(rows.size() == 3);
    for (const auto& row : rows)
        CHECK(row.size() == rows[0].size());
    CHECK(std::set<std::string>(rows[0].begin(), rows[0].end()).size() == rows[0].size());
    const auto cell = [&](int step, const std::string& column) {
        const auto found = std::ranges::find(rows[0], column);
        REQUIRE(found != rows[0].end());
        return rows[static_cast<std::size_t>(step)][static_cast<std::size_t>(found - rows[0].begin())];
    };
    CHECK(cell(1, "step") == "1");
    CHECK(cell(2, "step") == "2");
    CHECK(std::stod(cell(1, "seconds")) == 0.1 + 0.2);
    CHECK(cell(1, "p_smallest") == "0.1");
    CHECK(cell(2, "p_largest") == "7.0");
    CHECK(cell(1, "max_mean_curvature_after").empty());
    CHECK(cell(1, "iterations").empty());
    CHECK(cell(2, "iterations") == "12");
    CHECK(std::stod(cell(2, "v_mean")) == 0.1 / 0.5);
    CHECK(std::stod(cell(2, "h_mean")) == 0.05 / 0.5);
    CHECK(std::stod(cell(2, "h_rms")) == 0.1 / 0.5);
    CHECK(std::stod(cell(2, "h_max")) == 0.25 / 0.5);
    CHECK(std::stod(cell(2, "h_max_absolute")) == 0.25);
    CHECK(steps_csv(json_of_run(run, FlowOptions{}, FlowReport{})) == "step,p_smallest,p_largest\n");
}
