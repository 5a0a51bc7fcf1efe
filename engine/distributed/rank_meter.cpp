#include "engine/distributed/rank_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <xxhash.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/labels.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// The sums.
enum Sum : std::uint8_t { Area, Cones, EdgeLength, Edges, Vertices, Distance, SquaredDistance };
constexpr std::size_t n_sums = SquaredDistance + 1;
using Sums = std::array<double, n_sums>;

void add_face(std::span<const Index> corners, const Points& positions, Sums& sums)
{
    const Point area = vector_area(corners, positions);
    Point mean = Point::Zero();
    Index from = corners.back();
    for (const Index to : corners) {
        mean += positions.row(to);
        sums[EdgeLength] += (positions.row(to) - positions.row(from)).norm();
        from = to;
    }
    sums[Area] += area.norm();
    sums[Cones] += area.dot(mean) / (3.0 * static_cast<double>(corners.size()));
    sums[Edges] += static_cast<double>(corners.size());
}

/// Of vertices as numbered in the whole mesh; that of the opposite half-edge is the negative.
std::uint64_t hash_of_half_edge(std::int64_t from, std::int64_t to)
{
    const std::array ends{std::min(from, to), std::max(from, to)};
    const std::uint64_t hash = XXH3_64bits(ends.data(), sizeof ends);
    return from < to ? hash : std::uint64_t{0} - hash;
}

/// See partition/metrics/volume.h: half-edges and their opposites cancel each other, whichever ranks have them.
bool encloses_volume(Communicator& comm, const RankMesh& mesh)
{
    std::uint64_t own = 0;
    for (Index f = 0; f < mesh.part.mesh.n_faces(); ++f) {
        if (mesh.is_own[mesh.part.labels[f]] == 0)
            continue;
        Index from = mesh.part.mesh.face(f).back();
        for (const Index to : mesh.part.mesh.face(f)) {
            own += hash_of_half_edge(mesh.part.vertex_numbers[from], mesh.part.vertex_numbers[to]);
            from = to;
        }
    }
    const auto of_all = comm.gather_all(std::vector<std::uint64_t>{own});
    return std::accumulate(of_all.begin(), of_all.end(), std::uint64_t{0}) == 0 && !mesh.all.empty();
}

}  // namespace

RankMeter::RankMeter(Communicator& comm, const RankMesh& mesh)
    : mesh_(&mesh)
    , peers_(make_rank_peers(comm, mesh))
    , tree_(*peers_)
    , encloses_volume_(encloses_volume(comm, mesh))
{
    const auto n = static_cast<Index>(mesh.known.size());
    faces_ = make_lists(n, [&](auto&& add) {
        for (Index f = 0; f < mesh.part.mesh.n_faces(); ++f)
            if (const Index s = mesh.part.labels[f]; mesh.is_own[s] != 0)
                add(s, f);
    });
    std::vector<Index> around;
    vertices_ = make_lists(n, [&](auto&& add) {
        for (Index v = 0; v < mesh.part.mesh.n_vertices(); ++v) {
            labels_around(mesh.topology, mesh.part.labels, v, around);
            if (!around.empty() && mesh.is_own[around.front()] != 0)
                add(around.front(), v);
        }
    });
}

RankMeasures RankMeter::measure(const Points& before, const Points& after)
{
    std::vector<double> rows(at(peers_->n_places()) * n_sums);
    std::vector<double> farthest(mesh_->known.size(), 0.0);
    for_each(run_in_parallel, faces_.size(), [&](Index s) {
        if (!peers_->is_own(s))
            return;
        Sums sums{};
        for (const Index f : faces_[s])
            add_face(mesh_->part.mesh.face(f), after, sums);
        for (const Index v : vertices_[s]) {
            const double distance = (after.row(v) - before.row(v)).norm();
            sums[Distance] += distance;
            sums[SquaredDistance] += distance * distance;
            farthest[s] = std::max(farthest[s], distance);
        }
        sums[Vertices] = static_cast<double>(vertices_[s].size());
        std::ranges::copy(sums, rows.begin() + static_cast<std::ptrdiff_t>(at(peers_->places()[s]) * n_sums));
    });
    const std::vector<double> sums = tree_.add_up(rows, n_sums);
    const double largest = farthest.empty() ? 0.0 : std::ranges::max(farthest);
    RankMeasures measures{.area = sums[Area]};
    if (encloses_volume_)
        measures.volume = sums[Cones];
    if (sums[Edges] > 0.0)
        measures.mean_edge = sums[EdgeLength] / sums[Edges];
    measures.displacement.max = peers_->largest({largest}).front();
    if (sums[Vertices] > 0.0) {
        measures.displacement.mean = sums[Distance] / sums[Vertices];
        measures.displacement.rms = std::sqrt(sums[SquaredDistance] / sums[Vertices]);
    }
    return measures;
}

}  // namespace seamflow
