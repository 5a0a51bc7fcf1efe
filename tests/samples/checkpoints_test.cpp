#include <memory>

#include <doctest/doctest.h>

#include "engine/state/flow_state.h"
#include "partition/errors.h"
#include "samples/command/command_line.h"
#include "samples/files/checkpoints.h"
#include "samples/runs/long_run.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

TEST_CASE("a period of checkpoints is a number of steps or a time")
{
    CHECK(parse_checkpoint_period("10").steps == 10);
    CHECK(parse_checkpoint_period("10").seconds == 0.0);
    CHECK(parse_checkpoint_period("90s").seconds == 90.0);
    CHECK(parse_checkpoint_period("1.5min").seconds == 90.0);
    CHECK(parse_checkpoint_period("2h").seconds == 7200.0);
    CHECK(parse_checkpoint_period("2h").steps == 1);
    for (const char* text : {"", "0", "-1", "1.5", "s", "3 s", "3d", "nan", "3ss", "-3s"})
        CHECK_THROWS_AS(parse_checkpoint_period(text), OptionError);
}

TEST_CASE("a checkpoint is kept after every so many steps, or when so much time has passed, and at the end")
{
    const test::TemporaryDirectory directory;
    const Points positions(0, 3);
    const StepReport report;
    const auto keep = [&](Checkpoints& checkpoints, int step, bool is_last) {
        checkpoints.save_if_due({.step = step,
                                 .positions = positions,
                                 .report = report,
                                 .capture = [] { return std::make_shared<const FlowState>(); }},
                                is_last);
        return checkpoints.step();
    };
    Checkpoints every_third(directory.path(), {.steps = 3});
    for (int step = 1; step <= 7; ++step)
        CHECK(keep(every_third, step, false) == step / 3 * 3);
    CHECK(keep(every_third, 8, true) == 8);
    // Each takes some time, and almost none passes between them.
    Checkpoints cheaply(directory.path(), {.most_of_time = 0.0});
    for (int step = 1; step <= 3; ++step)
        CHECK(keep(cheaply, step, false) == 1);
    CHECK(keep(cheaply, 4, true) == 4);
    CHECK(cheaply.seconds() > 0.0);
    Checkpoints rarely(directory.path(), {.seconds = 1e6});
    for (int step = 1; step <= 3; ++step)
        CHECK(keep(rarely, step, false) == 0);
    CHECK(keep(rarely, 4, true) == 4);
}

TEST_CASE("the mesh of an interrupted run stands beside the output, never in place of the input")
{
    const test::TemporaryDirectory directory;
    CHECK(interrupted_path("a/smooth.ply", "b.ply") == "a/smooth.interrupted.ply");
    CHECK(interrupted_path("a/smooth.ply.gz", "b.ply") == "a/smooth.interrupted.ply.gz");
    const auto input = directory.with("out.interrupted.obj", "");
    CHECK(interrupted_path(directory / "out.obj", input) == directory / "out.interrupted.interrupted.obj");
}
