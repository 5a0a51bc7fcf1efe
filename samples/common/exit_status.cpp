#include "samples/common/exit_status.h"

#include <exception>
#include <iostream>
#include <new>

#include "partition/errors.h"
#include "samples/common/blas_threads.h"

namespace seamflow {

namespace {

ExitStatus tell(const char* program, const char* message, ExitStatus status)
{
    std::cout.flush();
    std::cerr << program << ": " << message << '\n';
    return status;
}

ExitStatus guarded(const char* program, const std::function<ExitStatus()>& body)
{
    try {
        return body();
    } catch (const OptionError& error) {
        return tell(program, error.what(), ExitStatus::WrongUsage);
    } catch (const InputError& error) {
        return tell(program, error.what(), ExitStatus::UnusableInput);
    } catch (const OutputError& error) {
        return tell(program, error.what(), ExitStatus::OutputNotWritten);
    } catch (const std::bad_alloc&) {
        return tell(program,
                    "there is not enough memory: close other programs, raise the limit of this one (ulimit -v), or "
                    "give it less to do at once (fewer vertices; where these options are, more --subdomains or fewer "
                    "--threads)",
                    ExitStatus::ComputationFailed);
    } catch (const std::exception& error) {
        return tell(program, error.what(), ExitStatus::ComputationFailed);
    } catch (...) {
        return tell(program, "failed for an unknown reason", ExitStatus::ComputationFailed);
    }
}

}  // namespace

int run_program(const char* program, const std::function<ExitStatus()>& body)
{
    const ExitStatus status = guarded(program, [&] {
        do_without_blas_threads_where_limited();
        return body();
    });
    std::cout.flush();
    if (status == ExitStatus::Success && !std::cout)
        return static_cast<int>(
            tell(program, "standard output could not be written: is its disk full?", ExitStatus::OutputNotWritten));
    return static_cast<int>(status);
}

}  // namespace seamflow
