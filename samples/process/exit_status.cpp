#include "samples/process/exit_status.h"

#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

#include "partition/errors.h"
#include "samples/process/option_words.h"

namespace seamflow {

namespace {

ExitStatus say_failure(const char* program, const Failure& failure)
{
    std::cout.flush();
    say_error(program, failure.message);
    return failure.status;
}

}  // namespace

void say_error(std::string_view program, std::string_view message)
{
    std::cerr << program << ": " << message << '\n';
}

Failure current_failure()
{
    try {
        throw;
    } catch (const OptionError& error) {
        return {ExitStatus::WrongUsage, sentence(error.wording(), option_of_program)};
    } catch (const InputError& error) {
        return {ExitStatus::UnusableInput, sentence(error.wording(), option_of_program)};
    } catch (const OutputError& error) {
        return {ExitStatus::OutputNotWritten, error.what()};
    } catch (const std::bad_alloc&) {
        return {ExitStatus::ComputationFailed,
                "there is not enough memory: close other programs, raise the limit of this one (ulimit -v), or give it "
                "less to do at once (fewer vertices; where these options exist, more --subdomains or fewer --threads)"};
    } catch (const std::exception& error) {
        return {ExitStatus::ComputationFailed, error.what()};
    } catch (...) {
        return {ExitStatus::ComputationFailed, "failed for an unknown reason"};
    }
}

int run_program(const char* program, const std::function<ExitStatus()>& body)
{
    // Standard error gets whole lines: what other processes write there (ranks, mpirun) does not come between.
    std::setvbuf(stderr, nullptr, _IOLBF, BUFSIZ);
    std::cerr.unsetf(std::ios::unitbuf);
    ExitStatus status = ExitStatus::Success;
    try {
        status = body();
    } catch (...) {
        status = say_failure(program, current_failure());
    }
    std::cout.flush();
    if (status == ExitStatus::Success && !std::cout)
        status = say_failure(program,
                             {ExitStatus::OutputNotWritten, "standard output could not be written: is its disk full?"});
    return static_cast<int>(status);
}

}  // namespace seamflow
