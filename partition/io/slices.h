#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partition/errors.h"
#include "partition/executor.h"
#include "partition/io/output_file.h"
#include "partition/io/text_scanner.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// How several threads read and write files slice by slice.
struct Slicing {
    Executor exec = run_serially;
    /// Approximate size of a slice in bytes.
    std::size_t bytes = std::size_t{1} << 18;
};

/// The number of elements of about `size` bytes in a slice; at least 1.
inline Index elements_per_slice(const Slicing& slicing, std::size_t size)
{
    return static_cast<Index>(slicing.bytes / size + 1);
}

/// Writes n elements in slices of per_slice, several at once.
/// @param write called with a buffer and the element.
template <class Write>
void write_elements(OutputFile& file, Index n, Index per_slice, const Executor& exec, Write&& write)
{
    file.slices(n / per_slice + (n % per_slice > 0 ? 1 : 0), exec, [&](Index i, OutputBuffer& slice) {
        const Index begin = i * per_slice;
        const Index end = begin + std::min(per_slice, n - begin);
        for (Index element = begin; element < end; ++element)
            write(slice, element);
    });
}

/// The sum of two numbers of elements.
/// @throws InputError if there are more than 2^31 - 1.
Index sum_of_counts(std::int64_t a, std::int64_t b);

/// The number of lines with a token before each slice of a text and, at the end, in the whole text.
std::vector<std::int64_t> count_lines(const TextScanner& whole, std::span<const std::string_view> slices,
                                      const Executor& exec);

/// Reads the faces of n slices, several at a time, and appends them to those of the mesh.
/// @param read called with a slice and a mesh without faces, which gets those of the slice; with a single slice, the
///        mesh itself.
/// @throws InputError if there are more than 2^31 - 1 corners.
void append_faces(PolygonMesh& mesh, Index n, const Executor& exec,
                  const std::function<void(Index slice, PolygonMesh& faces)>& read);

/// A position for faults of slices, whose messages are not shown (see read_in_slices_if_faultless).
class NoPosition final : public InputPosition {
  private:
    [[nodiscard]] std::string position() const override { return {}; }
};

/// Reads a file slice by slice. Which slice fails first is a matter of chance: a file with a fault is read again in one
/// go, which reports the first fault with its line.
template <class InSlices, class InOneGo>
auto read_in_slices_if_faultless(InSlices&& in_slices, InOneGo&& in_one_go)
{
    try {
        return in_slices();
    } catch (const InputError&) {
        return in_one_go();
    }
}

}  // namespace seamflow
