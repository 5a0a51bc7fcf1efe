#pragma once

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <span>

#include <unistd.h>

#include "tests/support/sanitizers.h"

namespace seamflow::test {

/// Lets a program that crashes, or hangs, say on which case it was.
class SeedAnnouncer {
  public:
    SeedAnnouncer()
    {
        for (std::size_t i = 0; i < signals.size(); ++i)
            before_[i] = std::signal(signals[i], announce);
    }
    SeedAnnouncer(const SeedAnnouncer&) = delete;
    SeedAnnouncer& operator=(const SeedAnnouncer&) = delete;
    ~SeedAnnouncer()
    {
        alarm(0);
        for (std::size_t i = 0; i < signals.size(); ++i)
            std::signal(signals[i], before_[i]);
    }

    /// Begins a case, which should be over within the time.
    void begin(std::uint32_t seed, unsigned seconds)
    {
        const int length = std::snprintf(text().data(), text().size(), "\nstopped at SEAMFLOW_SEED=%u\n", seed);
        text_length() = length > 0 ? static_cast<std::size_t>(length) : 0;
        alarm(seconds);
    }

  private:
    // Sanitizers take crashes themselves, and say more of them.
    static constexpr std::array crashes_and_ends{SIGALRM, SIGTERM, SIGSEGV, SIGBUS, SIGFPE, SIGABRT};
    static constexpr auto signals = std::span(crashes_and_ends).first(under_sanitizers ? 2 : crashes_and_ends.size());
    // A signal handler sees nothing but what is static.
    static std::array<char, 64>& text()
    {
        static std::array<char, 64> text{};
        return text;
    }
    static std::size_t& text_length()
    {
        static std::size_t length = 0;
        return length;
    }
    static void announce(int signal)
    {
        if (write(STDERR_FILENO, text().data(), text_length()) < 0)
            _exit(1);
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }

    std::array<void (*)(int), crashes_and_ends.size()> before_{};
};

}  // namespace seamflow::test
