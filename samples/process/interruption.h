#pragma once

#include <atomic>
#include <csignal>
#include <stop_token>
#include <string>
#include <thread>

#include "samples/process/exit_status.h"

namespace seamflow {

/// Ends a program cleanly when SIGINT (Ctrl-C) or SIGTERM arrives, as long as this object exists. The first signal ends
/// the program at once if there is no result yet, and otherwise asks it to stop. The second ends it at once, as it
/// would without this object. A thread waits for the signals, so that none interrupts other code; all other threads
/// block them, so that the handlers that METIS temporarily installs are never called. A signal that the program ignored
/// from its start is left alone. Only one object at a time in a program.
class Interruption {
  public:
    /// Must be made before any other thread, which would otherwise get the signals.
    /// @param program the name that begins the message.
    explicit Interruption(std::string program);
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    /// From here on the first signal only asks to stop.
    void begin_work() { works_.store(true); }

    /// Reports whether a signal has asked to stop.
    [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

    /// The exit status of the program after that.
    [[nodiscard]] ExitStatus status() const;

  private:
    void hand_on_signals();
    void wait_for_signals();
    void end_unmade(int signal) const;
    [[noreturn]] static void end_at_once(int signal);

    std::string program_;
    std::stop_source source_;
    std::atomic<bool> works_{false};
    std::atomic<bool> is_over_{false};
    /// 0: none yet.
    std::atomic<int> first_signal_{0};
    /// SIGINT and SIGTERM, except for those that were ignored; and the same with the signal that wakes the thread.
    sigset_t ours_{};
    sigset_t waited_for_{};
    sigset_t mask_before_{};
    struct sigaction int_before_ = {};
    struct sigaction term_before_ = {};
    std::thread thread_;
};

}  // namespace seamflow
