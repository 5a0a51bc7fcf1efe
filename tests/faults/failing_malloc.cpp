// malloc, calloc and realloc of this executable come before those of the C library, in its shared libraries, too. They
// hand on to them, but for what is to fail (see FailingAllocation). That is decided by who calls:
//
//   counted   this program (Eigen's arrays), METIS, SuiteSparse (CHOLMOD, UMFPACK, AMD and what they use)
//   not       operator new, which has counted already;
//             the C library (streams, threads, the loader) and the C++ library (memory for exceptions that are under
//             way: it has a reserve of its own for that, and ends the program when that is used up);
//             oneTBB, whose scheduler has no way of telling a caller that it cannot go on;
//             OpenBLAS, which asks for memory again and again until it gets it.

#include "tests/faults/failing_malloc.h"

#include "tests/support/allocations.h"
#include "tests/support/sanitizers.h"

#if SEAMFLOW_UNDER_SANITIZERS

bool seamflow::test::has_failing_malloc()
{
    return false;
}

long seamflow::test::live_blocks()
{
    return 0;
}

#else

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <string_view>

#include <link.h>

// Names of the C library.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t n, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void __libc_free(void* memory);
}
// NOLINTEND(readability-identifier-naming)

namespace seamflow::test {

namespace {

/// The code of one executable or library.
struct Code {
    std::uintptr_t begin = 0;
    std::uintptr_t end = 0;
};

constexpr std::array counted_libraries{"libseamflow", "libmetis", "libcholmod", "libumfpack",          "libamd",
                                       "libcolamd",   "libcamd",  "libccolamd", "libsuitesparseconfig"};

/// Fixed in size, since it is used where memory is asked for.
struct CountedCode {
    std::array<Code, 32> pieces;
    std::size_t n = 0;

    CountedCode() { dl_iterate_phdr(&CountedCode::add, this); }

    static int add(dl_phdr_info* object, std::size_t, void* self)
    {
        auto& code = *static_cast<CountedCode*>(self);
        const std::string_view path = object->dlpi_name;
        const auto is_part_of_path = [path](const char* name) { return path.find(name) != path.npos; };
        if (!path.empty() && std::ranges::none_of(counted_libraries, is_part_of_path))
            return 0;
        // The one without a name that comes first is the executable; another one belongs to the system.
        if (path.empty() && code.n > 0)
            return 0;
        for (int i = 0; i < object->dlpi_phnum; ++i)
            if (const auto& part = object->dlpi_phdr[i]; part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0)
                code.pieces.at(code.n++) = {object->dlpi_addr + part.p_vaddr,
                                            object->dlpi_addr + part.p_vaddr + part.p_memsz};
        return 0;
    }

    [[nodiscard]] bool has(const void* address) const
    {
        const auto place = reinterpret_cast<std::uintptr_t>(address);
        return std::any_of(pieces.begin(), pieces.begin() + n,
                           [place](const Code& code) { return code.begin <= place && place < code.end; });
    }
};

const CountedCode& counted_code()
{
    static const CountedCode code;
    return code;
}

/// The blocks that are counted and live, by their addresses: open addressing, fixed in size for the same reason.
class LiveBlocks {
  public:
    void add(const void* block)
    {
        lock();
        blocks_[find(nullptr, place_of(block))] = block;
        ++count_;
        unlock();
    }

    void remove(const void* block)
    {
        lock();
        if (std::size_t hole = find(block, place_of(block)); blocks_[hole] == block) {
            --count_;
            // Those behind move up, if they may stand there.
            for (std::size_t place = next(hole); blocks_[place] != nullptr; place = next(place))
                if (distance(place_of(blocks_[place]), place) >= distance(hole, place)) {
                    blocks_[hole] = blocks_[place];
                    hole = place;
                }
            blocks_[hole] = nullptr;
        }
        unlock();
    }

    [[nodiscard]] long count() const { return count_; }

  private:
    static constexpr std::size_t size = std::size_t{1} << 19;

    static std::size_t next(std::size_t place) { return (place + 1) % size; }
    static std::size_t distance(std::size_t from, std::size_t to) { return (to + size - from) % size; }
    static std::size_t place_of(const void* block)
    {
        return reinterpret_cast<std::uintptr_t>(block) / 16 * 0x9e3779b97f4a7c15U % size;
    }

    /// @returns where it is, or the first free place.
    [[nodiscard]] std::size_t find(const void* block, std::size_t place) const
    {
        while (blocks_[place] != nullptr && blocks_[place] != block)
            place = next(place);
        return place;
    }

    void lock()
    {
        while (locked_.test_and_set(std::memory_order_acquire)) {
        }
    }
    void unlock() { locked_.clear(std::memory_order_release); }

    std::array<const void*, size> blocks_{};
    std::atomic<long> count_ = 0;
    std::atomic_flag locked_;
};

constinit LiveBlocks live;
std::atomic<bool> is_watching{false};

/// What to do with a block that `caller` asks for.
template <class Allocate>
void* watched(const void* caller, Allocate&& allocate)
{
    if (!is_watching.load(std::memory_order_relaxed) || !counted_code().has(caller))
        return allocate();
    if (!is_uncounted() && FailingAllocation::fails_now()) {
        errno = ENOMEM;
        return nullptr;
    }
    void* const block = allocate();
    if (block != nullptr)
        live.add(block);
    return block;
}

}  // namespace

bool has_failing_malloc()
{
    static_cast<void>(counted_code());
    is_watching = true;
    return true;
}

long live_blocks()
{
    return live.count();
}

}  // namespace seamflow::test

using namespace seamflow::test;

extern "C" {

void* malloc(std::size_t size)
{
    return watched(__builtin_return_address(0), [=] { return __libc_malloc(size); });
}

void* calloc(std::size_t n, std::size_t size)
{
    return watched(__builtin_return_address(0), [=] { return __libc_calloc(n, size); });
}

void* realloc(void* memory, std::size_t size)
{
    return watched(__builtin_return_address(0), [=] {
        if (memory != nullptr && is_watching)
            live.remove(memory);
        void* const moved = __libc_realloc(memory, size);
        if (moved == nullptr && memory != nullptr && is_watching)
            live.add(memory);
        return moved;
    });
}

void free(void* memory)
{
    if (memory != nullptr && is_watching.load(std::memory_order_relaxed))
        live.remove(memory);
    __libc_free(memory);
}

}  // extern "C"

#endif
