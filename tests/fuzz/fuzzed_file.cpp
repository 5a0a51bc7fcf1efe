#include "tests/fuzz/fuzzed_file.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#include <sanitizer/allocator_interface.h>
#define SEAMFLOW_WATCH_ALLOCATIONS
#endif
#endif

namespace seamflow::test {

namespace {

/// In bytes. 0: any size may be allocated.
std::size_t largest_allocation = 0;

#ifdef SEAMFLOW_WATCH_ALLOCATIONS

void on_allocation(const volatile void*, std::size_t n_bytes)
{
    if (largest_allocation == 0 || n_bytes <= largest_allocation)
        return;
    std::fprintf(stderr, "%zu bytes are allocated, where %zu are enough\n", n_bytes, largest_allocation);
    std::abort();
}

void watch_allocations()
{
    static const int installed = __sanitizer_install_malloc_and_free_hooks(on_allocation, [](const volatile void*) {});
    demand(installed > 0, "allocations can be watched");
}

#else

void watch_allocations() {}

#endif

/// One for all files of the process: they come one after another.
const std::filesystem::path& directory()
{
    static const TemporaryDirectory made;
    return made.path();
}

}  // namespace

FuzzedFile::FuzzedFile(const std::string& name, const std::uint8_t* bytes, std::size_t n_bytes)
    : path_(directory() / name)
{
    std::ofstream file(path_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(n_bytes));
    file.close();
    demand(!file.fail(), "the file can be written");
    watch_allocations();
    // Three bytes can be a vertex, of 24 bytes in an array that grows by doubling, and a megabyte is a buffer.
    largest_allocation = (std::size_t{2} << 20) + 64 * n_bytes;
}

FuzzedFile::~FuzzedFile()
{
    largest_allocation = 0;
}

void demand(bool holds, const std::string& what)
{
    if (holds)
        return;
    std::fprintf(stderr, "does not hold: %s\n", what.c_str());
    std::abort();
}

}  // namespace seamflow::test
