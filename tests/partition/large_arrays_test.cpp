#include <cstddef>
#include <cstdint>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <sys/mman.h>

#include "partition/large_arrays.h"
#include "partition/polygon_mesh.h"

using namespace seamflow;

namespace {

constexpr std::size_t many = std::size_t{1} << 20;

bool system_has_large_pages()
{
    return std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled").good();
}

/// Whether the system was asked for large pages where this memory is.
bool prefers_large_pages(const void* memory)
{
    const auto address = reinterpret_cast<std::uintptr_t>(memory);
    std::ifstream maps("/proc/self/smaps");
    bool is_here = false;
    for (std::string line; std::getline(maps, line);) {
        std::istringstream words(line);
        std::uintptr_t begin = 0;
        std::uintptr_t end = 0;
        char dash = 0;
        if (words >> std::hex >> begin >> dash >> end && dash == '-')
            is_here = begin <= address && address < end;
        else if (is_here && line.starts_with("VmFlags:"))
            return line.find(" hg") != std::string::npos;
    }
    return false;
}

}  // namespace

TEST_CASE("large arrays ask for large pages, and have the values of others")
{
    const auto equal = large_vector<Index>(many, 7);
    CHECK(equal == std::vector<Index>(many, 7));
    const auto numbers = uninitialised<double>(many);
    const Points points = uninitialised_points(static_cast<Index>(many));
    CHECK(points.rows() == static_cast<Eigen::Index>(many));
    if (system_has_large_pages()) {
        CHECK(prefers_large_pages(equal.data() + many / 2));
        CHECK(prefers_large_pages(numbers.get() + many / 2));
        CHECK(prefers_large_pages(points.data() + many));
    }
}

TEST_CASE("small arrays do not")
{
    const auto few = large_vector<Index>(1000, 3);
    CHECK(few == std::vector<Index>(1000, 3));
    CHECK(large_vector<Index>(0).empty());
    // Memory that no array has been in before.
    constexpr std::size_t n_bytes = std::size_t{1} << 23;
    void* const memory = ::mmap(nullptr, n_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    REQUIRE(memory != MAP_FAILED);
    prefer_large_pages(memory, n_bytes / 8);
    CHECK_FALSE(prefers_large_pages(memory));
    prefer_large_pages(memory, n_bytes);
    CHECK(prefers_large_pages(memory) == system_has_large_pages());
    ::munmap(memory, n_bytes);
}

TEST_CASE("making room keeps what is there")
{
    std::vector<Index> values(10);
    std::iota(values.begin(), values.end(), 0);
    const std::vector<Index> before = values;
    reserve_large(values, many);
    CHECK(values == before);
    const Index* const place = values.data();
    reserve_large(values, 1);
    values.resize(many);
    CHECK(values.data() == place);
    if (system_has_large_pages())
        CHECK(prefers_large_pages(place + many / 2));
}
