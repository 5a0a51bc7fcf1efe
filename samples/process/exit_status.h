#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace seamflow {

/// The exit statuses of the programs. Scripts rely on these numbers.
enum class ExitStatus : int {
    Success = 0,
    WrongUsage = 2,
    UnusableInput = 3,
    ComputationFailed = 4,
    OutputNotWritten = 5,
    /// Stopped by SIGINT (Ctrl-C) or SIGTERM.
    Interrupted = 130,
    Terminated = 143,
};

/// Why a program ends, and how.
struct Failure {
    ExitStatus status = ExitStatus::ComputationFailed;
    std::string message;
};

/// The failure for the exception that is being handled: OptionError → WrongUsage, InputError → UnusableInput,
/// OutputError → OutputNotWritten; ComputationError, running out of memory and anything else → ComputationFailed.
Failure current_failure();

/// Writes `program: message` and a line feed to standard error.
void say_error(std::string_view program, std::string_view message);

/// Runs the body of a program and converts its exceptions to an exit status, with one message on standard error (see
/// current_failure). From then on lines are written to standard error whole.
/// @param program the name that begins the message.
/// @returns the status, for main to return.
int run_program(const char* program, const std::function<ExitStatus()>& body);

}  // namespace seamflow
