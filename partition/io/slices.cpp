#include "partition/io/slices.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "partition/large_arrays.h"

namespace seamflow {

namespace {

/// Reserves memory for the parts and for those that follow, each as long as the longest of these, but for no more than
/// nine times the values and parts so far.
template <class Value>
void make_room(std::vector<Value>& values, std::span<const PolygonMesh> parts, Index n_to_follow,
               std::vector<Value> PolygonMesh::*member)
{
    std::size_t sum = values.size();
    std::size_t largest = 0;
    for (const PolygonMesh& part : parts) {
        sum += (part.*member).size();
        largest = std::max(largest, (part.*member).size());
    }
    if (sum <= values.capacity())
        return;
    constexpr std::size_t most_growth = 8;
    reserve_large(values, sum + std::min(usize(n_to_follow) * largest, most_growth * sum));
}

/// Appends the faces of parts to those of the mesh.
/// @param n_to_follow the number of parts that will be appended afterwards.
void append(PolygonMesh& mesh, std::span<const PolygonMesh> parts, Index n_to_follow)
{
    make_room(mesh.face_offsets, parts, n_to_follow, &PolygonMesh::face_offsets);
    make_room(mesh.face_vertices, parts, n_to_follow, &PolygonMesh::face_vertices);
    for (const PolygonMesh& part : parts) {
        const Index first = mesh.n_corners();
        static_cast<void>(sum_of_counts(first, part.n_corners()));
        mesh.face_vertices.insert(mesh.face_vertices.end(), part.face_vertices.begin(), part.face_vertices.end());
        const auto offsets =
            mesh.face_offsets.insert(mesh.face_offsets.end(), part.face_offsets.begin() + 1, part.face_offsets.end());
        std::for_each(offsets, mesh.face_offsets.end(), [first](Index& end) { end += first; });
    }
}

}  // namespace

Index sum_of_counts(std::int64_t a, std::int64_t b)
{
    if (a + b > std::numeric_limits<Index>::max())
        throw InputError("too many elements for one file");
    return static_cast<Index>(a + b);
}

std::vector<std::int64_t> count_lines(const TextScanner& whole, std::span<const std::string_view> slices,
                                      const Executor& exec)
{
    std::vector<std::int64_t> first(slices.size() + 1);
    for_each(exec, static_cast<Index>(slices.size()), [&](Index i) {
        TextScanner scanner(whole, slices[i]);
        while (!scanner.next_keyword().empty())
            ++first[i + 1];
    });
    std::partial_sum(first.begin(), first.end(), first.begin());
    return first;
}

void append_faces(PolygonMesh& mesh, Index n, const Executor& exec,
                  const std::function<void(Index slice, PolygonMesh& faces)>& read)
{
    if (n == 1)
        return read(0, mesh);
    // The number of slices that are read at once: enough that few threads wait, and few enough that they need little
    // memory.
    constexpr Index at_once = 32;
    std::vector<PolygonMesh> parts;
    std::vector<PolygonMesh> parts_before;
    for (Index begin = 0; begin < n; begin += at_once) {
        parts.resize(usize(std::min(at_once, n - begin)));
        // One thread appends the parts that were read before, while other threads read the next parts.
        for_each(exec, static_cast<Index>(parts.size()) + 1, [&](Index i) {
            if (i == 0)
                return append(mesh, parts_before, n - begin);
            PolygonMesh& part = parts[i - 1];
            part.face_offsets.resize(1);
            part.face_vertices.clear();
            read(begin + i - 1, part);
        });
        std::swap(parts, parts_before);
    }
    append(mesh, parts_before, 0);
}

}  // namespace seamflow
