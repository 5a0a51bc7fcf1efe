#include <sstream>

#include <doctest/doctest.h>

#include "engine/measure/smoothed_radius.h"
#include "samples/report/report_text.h"

using namespace seamflow;

TEST_CASE("the amount of smoothing in all its units")
{
    FlowOptions options;
    options.steps = 3;
    options.time_step = time_step_for_radius(0.5, options.steps);
    std::ostringstream text;
    print_start(text, {.scale = {.mean_edge = 0.1, .diagonal = 2.0}, .names = flow_names(options, options.steps)}, 4, 2,
                options);
    CHECK(text.str().find("4 vertices, 2 faces, mean edge 0.1\n") != std::string::npos);
    CHECK(text.str().find("bumps of radius 0.5, 25% of the diagonal") != std::string::npos);
    std::ostringstream edges;
    edges << "3 steps of " << options.time_step / 0.01;
    CHECK(text.str().find(edges.str() + " squared mean edge lengths") != std::string::npos);
}

TEST_CASE("what a run prints at the end: choices, time, remarks, and what the result is like")
{
    RunRecord run;
    run.output = "b.obj";
    run.scale = {.mean_edge = 0.5, .diagonal = 2.0};
    run.seconds = 1.25;
    run.surface = {.before = {.area = 4.0, .volume = 2.0, .roughness = Roughness{12.0, 30.0}},
                   .after = {.area = 3.0, .volume = 1.5, .roughness = Roughness{6.5, 9.0}},
                   .moved = {.mean = 0.1, .rms = 0.2, .max = 1.0}};
    FlowReport report;
    report.choices = {std::string("This."), std::string("That.")};
    report.remarks = {{"gap", {}, {"Mind the <weld never>."}}};
    report.resources.threads = 2;
    report.steps.resize(1);
    report.steps.back().estimated_v_max = 0.03;
    std::ostringstream text;
    complete_record(run, report);
    print_result(text, run, report);
    const std::string printed = text.str();
    CHECK(printed.find("chosen     This. That.\ntime       1.25 s: read ") == 0);
    CHECK(printed.find("2 threads") != std::string::npos);
    CHECK(printed.find("\nremark     Mind the --weld never.\nresult     b.obj: moved 0.1 (0.2 mean edge lengths) on "
                       "average, 1 (2) at most; "
                       "roughness 12 -> 6.5 degrees, area 4 -> 3, volume 2 -> 1.5; by estimate 0.03 mean edge lengths "
                       "at most from the undecomposed flow\n") != std::string::npos);
    CHECK(printed.find("distance") == std::string::npos);

    run.surface.after.volume.reset();
    run.surface.after.roughness.reset();
    run.choices_in_words.clear();
    report.steps.back().distance = VertexDistance{.mean = 1.0, .rms = 2.0, .max = 3.0, .mean_edge = 2.0};
    std::ostringstream other;
    print_result(other, run, report);
    CHECK(other.str().find("volume") == std::string::npos);
    CHECK(other.str().find("1 (2) at most; area 4 -> 3; by ") != std::string::npos);
    CHECK(other.str().find("chosen") == std::string::npos);
    CHECK(other.str().find("distance   V_mean 0.5  V_RMS 1  V_max 1.5 mean edge lengths") != std::string::npos);
}
