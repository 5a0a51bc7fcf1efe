#include "tests/support/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace seamflow::test {

namespace {

std::atomic<long> n_calls{0};

/// What is to fail; 0: nothing.
std::atomic<long> first_failure{0};
std::atomic<bool> goes_on{false};
std::atomic<long> n_since{0};

thread_local bool uncounted = false;

}  // namespace

long n_allocations()
{
    return n_calls;
}

FailingAllocation::FailingAllocation(long n, Failing failing)
{
    n_since = 0;
    goes_on = failing == Failing::FromThenOn;
    first_failure = n;
}

FailingAllocation::~FailingAllocation()
{
    first_failure = 0;
}

bool FailingAllocation::has_failed()
{
    return n_since >= first_failure;
}

bool FailingAllocation::fails_now()
{
    const long first = first_failure.load(std::memory_order_relaxed);
    if (first == 0)
        return false;
    const long n = ++n_since;
    return n == first || (n > first && goes_on);
}

void* allocate_uncounted(std::size_t size)
{
    uncounted = true;
    void* const memory = std::malloc(size > 0 ? size : 1);
    uncounted = false;
    return memory;
}

bool is_uncounted()
{
    return uncounted;
}

}  // namespace seamflow::test

using seamflow::test::FailingAllocation;

void* operator new(std::size_t size)
{
    ++seamflow::test::n_calls;
    if (!FailingAllocation::fails_now())
        if (void* memory = seamflow::test::allocate_uncounted(size))
            return memory;
    throw std::bad_alloc();
}

void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept
{
    ++seamflow::test::n_calls;
    return FailingAllocation::fails_now() ? nullptr : seamflow::test::allocate_uncounted(size);
}

void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept
{
    std::free(memory);
}

void operator delete(void* memory) noexcept
{
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}

// The forms for arrays come from the library, and call the ones above. What is aligned more than usual has forms of its
// own.
void* operator new(std::size_t size, std::align_val_t alignment)
{
    ++seamflow::test::n_calls;
    const auto multiple = static_cast<std::size_t>(alignment);
    if (!FailingAllocation::fails_now())
        if (void* memory = std::aligned_alloc(multiple, (size + multiple - 1) / multiple * multiple))
            return memory;
    throw std::bad_alloc();
}

void operator delete(void* memory, std::align_val_t) noexcept
{
    std::free(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
    std::free(memory);
}
