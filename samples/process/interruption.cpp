#include "samples/process/interruption.h"

#include <cerrno>
#include <string_view>
#include <utility>

#include <pthread.h>
#include <unistd.h>

#include "solvers/platform/library_threads.h"

namespace seamflow {

namespace {

/// Wakes only the waiting thread, at the end.
constexpr int wake_up = SIGUSR1;

bool is_ignored(int signal)
{
    struct sigaction action = {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

ExitStatus status_after(int signal)
{
    return signal == SIGTERM ? ExitStatus::Terminated : ExitStatus::Interrupted;
}

/// For the handler, which can access nothing else.
std::atomic<pthread_t> waiting_thread{};

/// Runs only in threads of libraries, which do not block signals: all others do.
void hand_on(int signal)
{
    const int error = errno;
    ::pthread_kill(waiting_thread.load(), signal);
    errno = error;
}

void write_to_error(std::string_view text)
{
    static_cast<void>(::write(STDERR_FILENO, text.data(), text.size()));
}

}  // namespace

Interruption::Interruption(std::string program)
    : program_(std::move(program))
{
    sigemptyset(&ours_);
    for (const int signal : {SIGINT, SIGTERM})
        if (!is_ignored(signal))
            sigaddset(&ours_, signal);
    waited_for_ = ours_;
    sigaddset(&waited_for_, wake_up);
    // Threads inherit the mask of their creator.
    pthread_sigmask(SIG_BLOCK, &waited_for_, &mask_before_);
    end_threads_of_blas();
    thread_ = std::thread([this] { wait_for_signals(); });
    pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
    pthread_sigmask(SIG_BLOCK, &ours_, nullptr);
    hand_on_signals();
}

void Interruption::hand_on_signals()
{
    waiting_thread.store(thread_.native_handle());
    struct sigaction action = {};
    action.sa_handler = hand_on;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    ::sigaction(SIGINT, sigismember(&ours_, SIGINT) == 1 ? &action : nullptr, &int_before_);
    ::sigaction(SIGTERM, sigismember(&ours_, SIGTERM) == 1 ? &action : nullptr, &term_before_);
}

Interruption::~Interruption()
{
    ::sigaction(SIGINT, &int_before_, nullptr);
    ::sigaction(SIGTERM, &term_before_, nullptr);
    is_over_.store(true);
    pthread_kill(thread_.native_handle(), wake_up);
    thread_.join();
    pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

ExitStatus Interruption::status() const
{
    return status_after(first_signal_.load());
}

void Interruption::wait_for_signals()
{
    for (;;) {
        int signal = 0;
        if (sigwait(&waited_for_, &signal) != 0)
            continue;
        if (is_over_.load())
            return;
        if (signal == wake_up)
            continue;
        if (first_signal_.load() != 0)
            end_at_once(signal);
        if (!works_.load())
            end_unmade(signal);
        first_signal_.store(signal);
        source_.request_stop();
    }
}

void Interruption::end_unmade(int signal) const
{
    write_to_error(program_ + ": interrupted before the first step; nothing was written\n");
    ::_exit(static_cast<int>(status_after(signal)));
}

/// Ends by the signal itself, so that whoever waits for the program knows.
void Interruption::end_at_once(int signal)
{
    if (::isatty(STDERR_FILENO) != 0)
        write_to_error("\n");
    std::signal(signal, SIG_DFL);
    sigset_t this_one;
    sigemptyset(&this_one);
    sigaddset(&this_one, signal);
    pthread_sigmask(SIG_UNBLOCK, &this_one, nullptr);
    ::raise(signal);
    ::_exit(static_cast<int>(status_after(signal)));
}

}  // namespace seamflow
