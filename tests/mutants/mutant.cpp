#include "tests/mutants/mutant.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include <fcntl.h>
#include <unistd.h>

namespace {

constexpr int most_mutants = 10000;

/// One write of a short line to the end of a file is whole, also among threads and processes. Nothing is allocated:
/// some tests count allocations, or let them fail.
void append_line(const char* path, int number) noexcept
{
    std::array<char, 16> line{};
    const int length = std::snprintf(line.data(), line.size(), "%d\n", number);
    const int file = ::open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0)
        return;
    static_cast<void>(::write(file, line.data(), static_cast<std::size_t>(length)) < 0);
    ::close(file);
}

}  // namespace

bool seamflow_mutant(int number) noexcept
{
    static const char* const name = std::getenv("SEAMFLOW_MUTANT");
    static const int chosen = name != nullptr ? std::atoi(name) : -1;
    static const char* const reached = std::getenv("SEAMFLOW_MUTANTS_REACHED");
    static std::array<std::atomic<bool>, most_mutants> noted;
    if (reached != nullptr && !noted[static_cast<std::size_t>(number)].exchange(true))
        append_line(reached, number);
    return number == chosen;
}
