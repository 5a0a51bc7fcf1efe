#include "samples/process/process.h"

#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/tasks/stopwatch.h"

namespace seamflow {

namespace {

/// Variables that tell libraries how many threads they may start. CHOLMOD asks for four, regardless of OMP_NUM_THREADS:
/// the limit prevents that. Waiting threads should sleep.
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

/// @param usage receives what the process used, if it could be started.
std::string run_and_wait(const std::string& program, std::vector<std::string>& words,
                         std::vector<std::string>& variables, rusage& usage)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int failure = posix_spawn(&child, program.c_str(), &actions, nullptr, pointers_to(words).data(),
                                    pointers_to(variables).data());
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0)
        return std::string("cannot be started: ") + std::strerror(failure);
    int status = 0;
    while (wait4(child, &status, 0, &usage) < 0)
        if (errno != EINTR)
            return std::string("cannot be waited for: ") + std::strerror(errno);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
        return "killed, most likely because this machine has too little memory";
    if (WIFSIGNALED(status))
        return std::string("ended by the signal \"") + strsignal(WTERMSIG(status)) + "\"";
    return WEXITSTATUS(status) == 0 ? "" : "ended with status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

ProcessEnd run_process(const std::string& program, std::vector<std::string> words, int threads)
{
    std::vector<std::string> variables = environment_for(threads);
    const Stopwatch watch;
    ProcessEnd end;
    rusage usage{};
    end.failure = run_and_wait(program, words, variables, usage);
    end.seconds = watch.seconds();
    end.peak_memory_bytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
    return end;
}

}  // namespace seamflow
