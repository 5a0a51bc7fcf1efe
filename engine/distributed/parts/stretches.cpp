#include "engine/distributed/parts/stretches.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include "engine/distributed/parts/whole_mesh.h"

namespace seamflow {

namespace {

void move_faces(Conversation& talk, const RankSlice& found, const std::vector<std::int64_t>& from,
                const std::vector<std::int64_t>& to, RankSlice& slice)
{
    const auto pack = [&](Index begin, Index end) {
        std::vector<Index> sizes;
        for (Index f = begin; f < end; ++f)
            sizes.push_back(found.face_offsets[f + 1] - found.face_offsets[f]);
        const Index first = found.face_offsets[begin];
        Packer packer;
        packer.put_all(std::span<const Index>(sizes));
        packer.put_all(
            std::span<const std::int64_t>(found.corners).subspan(at(first), at(found.face_offsets[end] - first)));
        return packer.take();
    };
    for (const Bytes& bytes : move_elements(talk, from, to, pack)) {
        if (bytes.empty())
            continue;
        Unpacker unpacker(bytes);
        for (const Index size : unpacker.get_all<Index>())
            slice.face_offsets.push_back(slice.face_offsets.back() + size);
        const auto corners = unpacker.get_all<std::int64_t>();
        slice.corners.insert(slice.corners.end(), corners.begin(), corners.end());
    }
}

}  // namespace

std::vector<std::int64_t> gather_bounds_of(Conversation& talk, std::int64_t n_own)
{
    const auto counts = talk.gather_all(std::vector<std::int64_t>{n_own});
    std::vector<std::int64_t> bounds{0};
    std::partial_sum(counts.begin(), counts.end(), std::back_inserter(bounds));
    return bounds;
}

std::vector<std::int64_t> bounds_of_stretches(std::int64_t n, int n_ranks, std::int64_t block)
{
    std::vector<std::int64_t> bounds;
    for (int r = 0; r <= n_ranks; ++r)
        bounds.push_back(begin_of_stretch(n, r, n_ranks, block));
    return bounds;
}

std::vector<Bytes> move_elements(Conversation& talk, const std::vector<std::int64_t>& from,
                                 const std::vector<std::int64_t>& to,
                                 const std::function<Bytes(Index begin, Index end)>& pack)
{
    std::vector<Bytes> to_each(static_cast<std::size_t>(talk.size()));
    const std::int64_t first = from[talk.rank()];
    for (int r = 0; r < talk.size(); ++r) {
        const std::int64_t begin = std::max(first, to[r]);
        const std::int64_t end = std::min(from[talk.rank() + 1], to[r + 1]);
        if (begin < end)
            to_each[r] = pack(static_cast<Index>(begin - first), static_cast<Index>(end - first));
    }
    return talk.exchange(std::move(to_each));
}

Points move_rows(Conversation& talk, const Points& own, const std::vector<std::int64_t>& from,
                 const std::vector<std::int64_t>& to)
{
    const auto pack = [&](Index begin, Index end) {
        Packer packer;
        packer.put_all(std::span<const double>(own.data() + std::ptrdiff_t{3} * begin, at(end - begin) * 3));
        return packer.take();
    };
    Points rows(to[talk.rank() + 1] - to[talk.rank()], 3);
    double* next = rows.data();
    for (const Bytes& bytes : move_elements(talk, from, to, pack))
        if (!bytes.empty())
            next = std::ranges::copy(unpacked<double>(bytes), next).out;
    return rows;
}

RankSlice move_to_stretches(Conversation& talk, RankSlice found, Index block)
{
    const SliceBounds from = gather_bounds(talk, found);
    const auto vertices = bounds_of_stretches(from.vertices.back(), talk.size(), block);
    const auto faces = bounds_of_stretches(from.faces.back(), talk.size(), block);
    if (vertices != from.vertices)
        found.vertices = move_rows(talk, found.vertices, from.vertices, vertices);
    if (faces == from.faces)
        return found;
    RankSlice slice;
    slice.vertices = std::move(found.vertices);
    move_faces(talk, found, from.faces, faces, slice);
    return slice;
}

PolygonMesh mesh_of(const RankSlice& slice)
{
    PolygonMesh mesh;
    mesh.vertices = slice.vertices;
    mesh.face_offsets = slice.face_offsets;
    mesh.face_vertices.assign(slice.corners.begin(), slice.corners.end());
    return mesh;
}

}  // namespace seamflow
