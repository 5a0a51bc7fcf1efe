#pragma once

#include <cstddef>

namespace seamflow::test {

/// How often operator new has been called; a program that asks counts from its start on.
long n_allocations();

/// Which allocations fail, of any thread.
enum class Failing { Once, FromThenOn };

/// While this lives the n-th allocation, from 1, fails, and with FromThenOn all after it: operator new throws
/// std::bad_alloc, and malloc returns nullptr where it is interposed (see failing_malloc.cpp). One at a time.
class FailingAllocation {
  public:
    FailingAllocation(long n, Failing failing);
    ~FailingAllocation();
    FailingAllocation(const FailingAllocation&) = delete;
    FailingAllocation& operator=(const FailingAllocation&) = delete;

    /// Whether there were so many.
    [[nodiscard]] static bool has_failed();

    /// Counts an allocation.
    /// @returns whether it is to fail.
    static bool fails_now();
};

/// Allocates without being counted, and without failing on purpose.
void* allocate_uncounted(std::size_t size);

/// Whether the calling thread is in allocate_uncounted.
bool is_uncounted();

}  // namespace seamflow::test
