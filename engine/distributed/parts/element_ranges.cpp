#include "engine/distributed/parts/element_ranges.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include "engine/distributed/parts/whole_mesh.h"

namespace seamflow {

namespace {

void move_faces(Communicator& comm, const RankSlice& found, const std::vector<std::int64_t>& from,
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
    for (const Bytes& bytes : move_elements(comm, from, to, pack)) {
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

std::vector<std::int64_t> gather_bounds_of(Communicator& comm, std::int64_t n_own)
{
    const auto counts = comm.gather_all(std::vector<std::int64_t>{n_own});
    std::vector<std::int64_t> bounds{0};
    std::partial_sum(counts.begin(), counts.end(), std::back_inserter(bounds));
    return bounds;
}

std::vector<std::int64_t> bounds_of_ranges(std::int64_t n, int n_ranks, std::int64_t block)
{
    std::vector<std::int64_t> bounds;
    for (int r = 0; r <= n_ranks; ++r)
        bounds.push_back(begin_of_range(n, r, n_ranks, block));
    return bounds;
}

std::vector<Bytes> move_elements(Communicator& comm, const std::vector<std::int64_t>& from,
                                 const std::vector<std::int64_t>& to,
                                 const std::function<Bytes(Index begin, Index end)>& pack)
{
    std::vector<Bytes> to_each(static_cast<std::size_t>(comm.size()));
    const std::int64_t first = from[comm.rank()];
    for (int r = 0; r < comm.size(); ++r) {
        const std::int64_t begin = std::max(first, to[r]);
        const std::int64_t end = std::min(from[comm.rank() + 1], to[r + 1]);
        if (begin < end)
            to_each[r] = pack(static_cast<Index>(begin - first), static_cast<Index>(end - first));
    }
    return comm.exchange(std::move(to_each));
}

Points move_rows(Communicator& comm, const Points& own, const std::vector<std::int64_t>& from,
                 const std::vector<std::int64_t>& to)
{
    const auto pack = [&](Index begin, Index end) {
        Packer packer;
        packer.put_all(std::span<const double>(own.data() + std::ptrdiff_t{3} * begin, at(end - begin) * 3));
        return packer.take();
    };
    Points rows(to[comm.rank() + 1] - to[comm.rank()], 3);
    double* next = rows.data();
    for (const Bytes& bytes : move_elements(comm, from, to, pack))
        if (!bytes.empty())
            next = std::ranges::copy(unpacked<double>(bytes), next).out;
    return rows;
}

RankSlice move_to_ranges(Communicator& comm, RankSlice found, Index block)
{
    const SliceBounds from = gather_bounds(comm, found);
    const auto vertices = bounds_of_ranges(from.vertices.back(), comm.size(), block);
    const auto faces = bounds_of_ranges(from.faces.back(), comm.size(), block);
    if (vertices != from.vertices)
        found.vertices = move_rows(comm, found.vertices, from.vertices, vertices);
    if (faces == from.faces)
        return found;
    RankSlice slice;
    slice.vertices = std::move(found.vertices);
    move_faces(comm, found, from.faces, faces, slice);
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
