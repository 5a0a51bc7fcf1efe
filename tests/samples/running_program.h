#pragma once

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace seamflow::test {

/// A program that runs by itself, in a directory, until it is waited for.
class RunningProgram {
  public:
    /// What it says goes to the file `said`; what it says to standard error goes elsewhere if told so.
    RunningProgram(const std::filesystem::path& directory, const std::string& program, const std::string& arguments,
                   int standard_error = -1)
    {
        // Without a shell in between, which would get the signals.
        std::vector<std::string> words{program};
        for (std::size_t i = 0; i < arguments.size();) {
            const std::size_t end = std::min(arguments.find(' ', i), arguments.size());
            words.push_back(arguments.substr(i, end - i));
            i = end + 1;
        }
        std::vector<char*> pointers;
        for (std::string& word : words)
            pointers.push_back(word.data());
        pointers.push_back(nullptr);
        // Before it starts, so that nobody reads what another one has said.
        const int file = ::open((directory / "said").c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        REQUIRE(file >= 0);
        pid_ = ::fork();
        REQUIRE(pid_ >= 0);
        if (pid_ > 0) {
            ::close(file);
            return;
        }
        if (::dup2(file, 1) < 0 || ::dup2(standard_error < 0 ? file : standard_error, 2) < 0 ||
            ::chdir(directory.c_str()) != 0)
            ::_exit(127);
        ::execv(pointers.front(), pointers.data());
        ::_exit(127);
    }

    ~RunningProgram()
    {
        if (pid_ > 0) {
            ::kill(pid_, SIGKILL);
            ::waitpid(pid_, nullptr, 0);
        }
    }
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    void send(int signal) const { ::kill(pid_, signal); }

    [[nodiscard]] bool runs()
    {
        siginfo_t info{};
        return pid_ > 0 && ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
               info.si_pid == 0;
    }

    /// @returns its exit status, or 1000 and the signal that has ended it.
    int wait()
    {
        int status = 0;
        REQUIRE(::waitpid(pid_, &status, 0) == pid_);
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    }

  private:
    pid_t pid_ = -1;
};

}  // namespace seamflow::test
