#include "samples/benchmark/method_process.h"

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <string>
#include <vector>

#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "partition/errors.h"
#include "samples/benchmark/run_method.h"
#include "samples/benchmark/scratch_folder.h"
#include "solvers/direct/blas_work_area.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;

constexpr const char* this_program = "/proc/self/exe";

/// Variables by which libraries learn how many threads they may start. CHOLMOD asks for four, whatever OMP_NUM_THREADS
/// says: the limit stops it. Threads that wait are to sleep.
std::vector<std::string> environment_for(int threads)
{
    const std::string number = std::to_string(threads);
    std::vector<std::string> variables{"OMP_NUM_THREADS=" + number, "OMP_THREAD_LIMIT=" + number,
                                       "OPENBLAS_NUM_THREADS=" + number, "OMP_WAIT_POLICY=passive"};
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string text = *variable;
        if (!text.starts_with("OMP_") && !text.starts_with("OPENBLAS_NUM_THREADS="))
            variables.push_back(text);
    }
    return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts)
{
    std::vector<char*> pointers;
    for (std::string& text : texts)
        pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// @returns how the process ended; empty: with success.
std::string run_program_in(const fs::path& folder, int threads)
{
    std::vector<std::string> words{"benchmark", run_method_word, folder.string()};
    std::vector<std::string> variables = environment_for(threads);
    pid_t child = 0;
    const int failure =
        posix_spawn(&child, this_program, nullptr, nullptr, pointers_to(words).data(), pointers_to(variables).data());
    if (failure != 0)
        return std::string("cannot be started: ") + std::strerror(failure);
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            return std::string("cannot be waited for: ") + std::strerror(errno);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
        return "killed, most likely because the memory of this machine does not suffice";
    if (WIFSIGNALED(status))
        return std::string("ended by the signal \"") + strsignal(WTERMSIG(status)) + "\"";
    return WEXITSTATUS(status) == 0 ? "" : "ended with status " + std::to_string(WEXITSTATUS(status));
}

/// The high-water mark of this process alone, in bytes. What getrusage gives includes the parent's.
std::int64_t high_water_mark()
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (std::int64_t kilobytes = 0; word == "VmHWM:" && status >> kilobytes)
            return kilobytes * 1024;
    return 0;
}

/// OpenBLAS asks for ever for the work area of its first call (128 MiB a thread) where the address space is limited and
/// full. Here there is still room, or it is known that there is none.
/// @throws std::bad_alloc if there is no room.
void take_blas_work_areas_within_limit(int threads)
{
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return;
    constexpr std::size_t one_area = std::size_t{130} << 20;
    ::operator delete(::operator new(one_area* static_cast<std::size_t>(threads)));
    take_blas_work_areas();
}

MethodResult result_or_error(const fs::path& folder)
{
    try {
        take_blas_work_areas_within_limit(read_task(folder).options.resources.threads);
        return run_method(read_mesh_for_methods(folder), read_task(folder));
    } catch (const std::bad_alloc&) {
        return failed("out of memory");
    } catch (const std::exception& error) {
        return failed(error.what());
    }
}

}  // namespace

MethodResult run_in_process(const fs::path& folder, const MethodTask& task)
{
    write_task(folder, task);
    const std::string failure = run_program_in(folder, task.options.resources.threads);
    if (failure.empty())
        return read_result(folder);
    return failed(failure);
}

void serve_method(const fs::path& folder)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // not to outlive a benchmark that was stopped
    MethodResult result = result_or_error(folder);
    result.peak_memory_bytes = high_water_mark();
    write_result(folder, result);
}

}  // namespace seamflow
