#include <iostream>
#include <new>
#include <sstream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "samples/process/exit_status.h"
#include "samples/runs/smoothing_run.h"

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

/// A standard error that keeps what is written piece by piece.
struct Pieces : std::streambuf {
    std::vector<std::string> pieces;

    std::streamsize xsputn(const char* text, std::streamsize size) override
    {
        pieces.emplace_back(text, static_cast<std::size_t>(size));
        return size;
    }
    int overflow(int character) override
    {
        pieces.emplace_back(1, static_cast<char>(character));
        return character;
    }
};

}  // namespace

TEST_CASE("a message is written in one piece, so that what other processes write does not come between")
{
    Pieces written;
    auto* const before = std::cerr.rdbuf(&written);
    say_error("program", std::string(3000, 'm'));
    const int status = run_program("program", []() -> ExitStatus { throw InputError("reason"); });
    std::cerr.rdbuf(before);
    CHECK(status == 3);
    CHECK(written.pieces == std::vector<std::string>{"program: " + std::string(3000, 'm') + "\n", "program: reason\n"});
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
