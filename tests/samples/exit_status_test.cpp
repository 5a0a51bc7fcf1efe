#include <iostream>
#include <new>
#include <sstream>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "samples/command/parse_smooth_command.h"
#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"

using namespace seamflow;

namespace {

/// The exit status of a body that throws, and what it wrote to standard error.
template <class Error>
std::pair<int, std::string> end_of(const Error& error)
{
    std::ostringstream message;
    auto* const before = std::cerr.rdbuf(message.rdbuf());
    const int status = run_program("program", [&]() -> ExitStatus { throw error; });
    std::cerr.rdbuf(before);
    return {status, message.str()};
}

}  // namespace

TEST_CASE("every kind of exception has its exit status and one message")
{
    CHECK(run_program("program", [] { return ExitStatus::Success; }) == 0);
    CHECK(end_of(OptionError("reason")) == std::pair(2, std::string("program: reason\n")));
    CHECK(end_of(InputError("reason")) == std::pair(3, std::string("program: reason\n")));
    CHECK(end_of(ComputationError("reason")) == std::pair(4, std::string("program: reason\n")));
    CHECK(end_of(OutputError("reason")) == std::pair(5, std::string("program: reason\n")));
    CHECK(end_of(std::bad_alloc()).first == 4);
    CHECK(end_of(std::bad_alloc()).second.find("memory") != std::string::npos);
    CHECK(end_of(std::logic_error("reason")).first == 4);
    CHECK(end_of(7).first == 4);
}

TEST_CASE(
    "steps fail that miss the tolerance asked for, unless they were to have few iterations and only these ran out")
{
    FlowReport report;
    report.convergence.steps_short_of_tolerance = 3;
    report.convergence.steps_stagnated = 1;
    SmoothCommand command;
    CHECK(steps_failed(command, report.convergence) == 0);
    command.options.accuracy.tolerance = 1e-8;
    CHECK(steps_failed(command, report.convergence) == 3);
    command.limits_iterations = true;
    CHECK(steps_failed(command, report.convergence) == 1);
    report.convergence.steps_stagnated = 0;
    CHECK(steps_failed(command, report.convergence) == 0);
    command.limits_iterations = false;
    CHECK(steps_failed(command, report.convergence) == 3);
    CHECK(steps_failed(command, ConvergenceReport{}) == 0);
}
