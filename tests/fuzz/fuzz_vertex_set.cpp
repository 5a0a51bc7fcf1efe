// Any bytes as a set of vertices, a list of numbers or a property of a PLY file: refused with an InputError, or numbers
// of vertices, ascending, each once.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "partition/errors.h"
#include "partition/formats/index_files.h"
#include "tests/fuzz/fuzzed_file.h"

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t n_bytes)
{
    using namespace seamflow;
    using namespace seamflow::test;
    constexpr Index n_vertices = 5;
    for (const char* name : {"set.txt", "set.ply"}) {
        const FuzzedFile file(name, bytes, n_bytes);
        try {
            const auto set = read_vertex_set(file.path(), n_vertices, "locked");
            demand(std::ranges::adjacent_find(set, std::greater_equal<>()) == set.end(), "the set ascends");
            demand(set.empty() || (set.front() >= 0 && set.back() < n_vertices), "the vertices are there");
        } catch (const InputError&) {
        }
    }
    return 0;
}
