#include "engine/distributed/cut/joined_seams.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>

#include "engine/distributed/cut/band.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/index_lists.h"
#include "partition/weld.h"

namespace seamflow {

namespace {

/// Joined vertices, and the number of pairs of edges.
struct Found {
    std::vector<SeamVertex> vertices;
    Index n_vertices = 0;
    Index n_edges = 0;
};

/// @param band of all faces at the boundary.
Found weld_band(const Band& band, double distance)
{
    Topology topology = make_topology(band.part.mesh, run_in_parallel);
    // The band ends where the mesh does not.
    for (std::size_t v = 0; v < band.is_whole.size(); ++v)
        if (band.is_whole[v] == 0)
            topology.kind[v] = VertexKind::NonManifold;
    Found found;
    const std::optional<Weld> welded = weld(band.part.mesh, topology, distance, run_in_parallel);
    if (!welded)
        return found;
    found.n_vertices = welded->n_vertices;
    found.n_edges = welded->n_edges;
    const auto& numbers = band.part.vertex_numbers;
    const Points& before = band.part.mesh.vertices;
    const auto size = 3 * sizeof(double);
    for (std::size_t v = 0; v < numbers.size(); ++v) {
        const Index first = welded->first[v];
        SeamVertex one{.vertex = numbers[v], .first = numbers[first], .own = {}, .joined = {}};
        std::memcpy(one.own, before.row(static_cast<Index>(v)).data(), size);
        std::memcpy(one.joined, welded->mesh.vertices.row(first).data(), size);
        if (one.first != one.vertex || std::memcmp(one.own, one.joined, size) != 0)
            found.vertices.push_back(one);
    }
    return found;
}

const SeamVertex* find(const std::vector<SeamVertex>& seam, std::int64_t vertex)
{
    const auto found = std::ranges::lower_bound(seam, vertex, {}, &SeamVertex::vertex);
    return found != seam.end() && found->vertex == vertex ? &*found : nullptr;
}

}  // namespace

JoinedSeams join_seams(Communicator& comm, RankSlice& slice, const SliceBounds& bounds,
                       const std::vector<std::int64_t>& boundary, double distance)
{
    std::vector<std::int64_t> vertices = comm.gather_at_first(boundary);
    sort_unique(vertices);
    JoinedSeams seams;
    seams.remark = remark_on_seams(0, 0, bounds.vertices.back(), distance);
    if (comm.broadcast(std::vector<std::int64_t>{std::ssize(vertices)}).front() == 0)
        return seams;
    slice.labels.assign(at(slice.n_faces()), 0);
    Found found;
    {
        const Band band = gather_band(comm, slice, bounds, vertices, 1);
        if (comm.rank() == 0)
            found = weld_band(band, distance);
    }
    seams.vertices = comm.broadcast(found.vertices);
    if (seams.vertices.empty())
        return seams;
    const auto counts = comm.broadcast(std::vector<Index>{found.n_vertices, found.n_edges});
    seams.remark = remark_on_seams(counts[0], counts[1], bounds.vertices.back(), distance);
    const std::int64_t begin = bounds.vertices[comm.rank()];
    for (const SeamVertex& one : seams.vertices) {
        seams.n_copies += one.first != one.vertex ? 1 : 0;
        if (one.first == one.vertex && one.vertex >= begin && one.vertex < bounds.vertices[comm.rank() + 1])
            slice.vertices.row(one.vertex - begin) = Eigen::Map<const Point>(one.joined);
    }
    for_each(run_in_parallel, static_cast<Index>(slice.corners.size()), [&](Index c) {
        if (const SeamVertex* const one = find(seams.vertices, slice.corners[c]))
            slice.corners[c] = one->first;
    });
    return seams;
}

void bring_back(Communicator& comm, const JoinedSeams& seams, RankSlice& slice)
{
    if (seams.vertices.empty())
        return;
    const SliceBounds bounds = gather_bounds(comm, slice);
    const std::int64_t begin = bounds.vertices[comm.rank()];
    const std::int64_t end = bounds.vertices[comm.rank() + 1];
    const auto first = std::ranges::lower_bound(seams.vertices, begin, {}, &SeamVertex::vertex);
    const auto last = std::ranges::lower_bound(seams.vertices, end, {}, &SeamVertex::vertex);
    const std::span<const SeamVertex> own(first, last);
    std::vector<std::int64_t> firsts;
    for (const SeamVertex& one : own)
        firsts.push_back(one.first);
    sort_unique(firsts);
    const Points moved = fetch_positions(comm, slice, firsts, bounds.vertices);
    for (const SeamVertex& one : own) {
        const Point now = moved.row(std::ranges::lower_bound(firsts, one.first) - firsts.begin());
        const Eigen::Map<const Point> joined(one.joined);
        slice.vertices.row(one.vertex - begin) = now == joined ? Point(Eigen::Map<const Point>(one.own)) : now;
    }
}

}  // namespace seamflow
