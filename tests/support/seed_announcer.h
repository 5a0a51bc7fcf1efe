#pragma once

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>

#include <unistd.h>

namespace seamflow::test {

/// Lets a program that crashes, or hangs, say on which case it was.
class SeedAnnouncer {
  public:
    SeedAnnouncer()
    {
        for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGALRM, SIGTERM})
            std::signal(signal, announce);
    }
    SeedAnnouncer(const SeedAnnouncer&) = delete;
    SeedAnnouncer& operator=(const SeedAnnouncer&) = delete;
    ~SeedAnnouncer()
    {
        alarm(0);
        for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGALRM, SIGTERM})
            std::signal(signal, SIG_DFL);
    }

    /// Begins a case, which should be over within the time.
    void begin(std::uint32_t seed, unsigned seconds)
    {
        const int length = std::snprintf(text().data(), text().size(), "\nstopped at SEAMFLOW_SEED=%u\n", seed);
        text_length() = length > 0 ? static_cast<std::size_t>(length) : 0;
        alarm(seconds);
    }

  private:
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
};

}  // namespace seamflow::test
