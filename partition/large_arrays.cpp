#include "partition/large_arrays.h"

#include <cstdint>

#include <sys/mman.h>
#include <unistd.h>

namespace seamflow {

void prefer_large_pages(void* memory, std::size_t n_bytes)
{
#ifdef MADV_HUGEPAGE
    constexpr std::size_t large_page = std::size_t{1} << 21;
    if (n_bytes < large_page)
        return;
    // The range is rounded outwards to small pages: otherwise a page that two arrays share would have no advice, and
    // the large page around it would be lost.
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(memory) / page * page;
    const std::uintptr_t end = (reinterpret_cast<std::uintptr_t>(memory) + n_bytes + page - 1) / page * page;
    static_cast<void>(::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE));
#endif
}

}  // namespace seamflow
