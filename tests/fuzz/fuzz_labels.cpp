// Any bytes as the labels of the faces of a mesh: refused with an InputError, or one label a face.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "partition/errors.h"
#include "partition/formats/index_files.h"
#include "tests/fuzz/fuzzed_file.h"

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t n_bytes)
{
    using namespace seamflow;
    using namespace seamflow::test;
    const FuzzedFile file("labels.txt", bytes, n_bytes);
    for (const Index n_faces : {Index{0}, Index{1}, Index{4}}) {
        try {
            const auto labels = read_labels(file.path(), n_faces);
            demand(static_cast<Index>(labels.size()) == n_faces, "there is a label for every face");
            demand(std::ranges::all_of(labels, [](Index label) { return label >= 0; }), "no label is negative");
        } catch (const InputError&) {
        }
    }
    return 0;
}
