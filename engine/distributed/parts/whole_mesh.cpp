#include "engine/distributed/parts/whole_mesh.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

namespace seamflow {

namespace {

std::vector<double> coordinates_of(const Points& points)
{
    return {points.data(), points.data() + points.size()};
}

Points points_of(const std::vector<double>& coordinates)
{
    Points points(static_cast<Eigen::Index>(coordinates.size() / 3), 3);
    std::ranges::copy(coordinates, points.data());
    return points;
}

/// The vertices and faces of a rank's range.
Bytes packed_range(const PolygonMesh& mesh, int rank, int n_ranks, Index block)
{
    const auto bound = [&](Index n, int r) { return static_cast<Index>(begin_of_range(n, r, n_ranks, block)); };
    const Index vertex = bound(mesh.n_vertices(), rank);
    const Index n_vertices = bound(mesh.n_vertices(), rank + 1) - vertex;
    const Index face = bound(mesh.n_faces(), rank);
    const Index end = bound(mesh.n_faces(), rank + 1);
    const Index corner = mesh.face_offsets[face];
    std::vector<Index> offsets(mesh.face_offsets.begin() + face, mesh.face_offsets.begin() + end + 1);
    for (Index& offset : offsets)
        offset -= corner;
    Packer packer;
    packer.put_all(std::span<const double>(mesh.vertices.data() + std::ptrdiff_t{3} * vertex, at(n_vertices) * 3));
    packer.put_all(std::span<const Index>(offsets));
    packer.put_all(std::span<const Index>(mesh.face_vertices).subspan(at(corner), at(mesh.face_offsets[end] - corner)));
    return packer.take();
}

}  // namespace

std::int64_t begin_of_range(std::int64_t n, int rank, int n_ranks, std::int64_t block)
{
    const std::int64_t n_blocks = n / block + (n % block > 0 ? 1 : 0);
    return std::min(n, n_blocks * rank / n_ranks * block);
}

RankSlice hand_out(Communicator& comm, const PolygonMesh& mesh, Index block)
{
    std::vector<Bytes> to_each(comm.size());
    if (comm.rank() == 0)
        for (int r = 0; r < comm.size(); ++r)
            to_each[r] = packed_range(mesh, r, comm.size(), block);
    const Bytes received = std::move(comm.exchange(std::move(to_each)).front());
    Unpacker unpacker(received);
    RankSlice slice;
    slice.vertices = points_of(unpacker.get_all<double>());
    slice.face_offsets = unpacker.get_all<Index>();
    const auto corners = unpacker.get_all<Index>();
    slice.corners.assign(corners.begin(), corners.end());
    return slice;
}

Points gather_positions(Communicator& comm, const Points& own)
{
    return points_of(comm.gather_at_first(coordinates_of(own)));
}

PolygonMesh gather_mesh(Communicator& comm, const RankSlice& slice)
{
    PolygonMesh mesh;
    mesh.vertices = gather_positions(comm, slice.vertices);
    std::vector<Index> sizes;
    for (Index f = 0; f < slice.n_faces(); ++f)
        sizes.push_back(slice.face_offsets[f + 1] - slice.face_offsets[f]);
    for (const Index size : comm.gather_at_first(sizes))
        mesh.face_offsets.push_back(mesh.face_offsets.back() + size);
    mesh.face_vertices = comm.gather_at_first(std::vector<Index>(slice.corners.begin(), slice.corners.end()));
    return mesh;
}

}  // namespace seamflow
