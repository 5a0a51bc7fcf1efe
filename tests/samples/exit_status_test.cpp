#include <array>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include "partition/errors.h"
#include "samples/process/exit_status.h"
#include "samples/runs/command_run.h"

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

TEST_CASE("lines are written whole, so that what other processes write does not come between")
{
    std::array<int, 2> pipe{};
    // Each write is a packet of its own.
    REQUIRE(pipe2(pipe.data(), O_DIRECT) == 0);
    const int before = dup(STDERR_FILENO);
    REQUIRE(dup2(pipe[1], STDERR_FILENO) == STDERR_FILENO);
    const int status = run_program("program", []() -> ExitStatus {
        std::cerr << "a summary " << 1.5 << " of " << 3 << '\n';
        throw InputError(std::string(3000, 'm'));
    });
    REQUIRE(dup2(before, STDERR_FILENO) == STDERR_FILENO);
    std::string packet(4096, ' ');
    const auto next = [&] { return packet.substr(0, static_cast<std::size_t>(read(pipe[0], packet.data(), 4096))); };
    CHECK(next() == "a summary 1.5 of 3\n");
    CHECK(next() == "program: " + std::string(3000, 'm') + "\n");
    for (const int file : {before, pipe[0], pipe[1]})
        close(file);
    CHECK(status == 3);
}

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
    ConvergenceReport report;
    report.steps_short_of_tolerance = 3;
    report.steps_stagnated = 1;
    SmoothCommand command;
    CHECK(missed_tolerance(command, report).empty());
    command.options.accuracy.tolerance = 1e-8;
    CHECK(missed_tolerance(command, report) == "the tolerance 1e-08 was missed in 3 steps");
    command.limits_iterations = true;
    CHECK(missed_tolerance(command, report) == "the tolerance 1e-08 was missed in 1 step");
    report.steps_stagnated = 0;
    CHECK(missed_tolerance(command, report).empty());
    command.limits_iterations = false;
    CHECK(missed_tolerance(command, report).ends_with("3 steps"));
    CHECK(missed_tolerance(command, {}).empty());
}
