#include "engine/distributed/slice_measures.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/index_lists.h"
#include "partition/loop.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// Sums over a block of faces.
struct BlockSums {
    double area = 0.0;
    double edges = 0.0;
};

void require_corners_in_range(const RankSlice& slice, const SliceBounds& bounds, int rank)
{
    for (Index f = 0; f < slice.n_faces(); ++f)
        for (Index c = slice.face_offsets[f]; c < slice.face_offsets[f + 1]; ++c)
            if (slice.corners[c] < 0 || slice.corners[c] >= bounds.vertices.back())
                throw InputError(fmt::format("face {} (numbered from 0) names vertex {}, but the mesh has {} vertices",
                                             bounds.faces[rank] + f, slice.corners[c], bounds.vertices.back()));
}

/// The faces of a stretch with the positions of their corners.
PolygonMesh mesh_of_faces(Conversation& talk, const RankSlice& slice, const SliceBounds& bounds)
{
    std::vector<std::int64_t> numbers = slice.corners;
    sort_unique(numbers);
    PolygonMesh mesh;
    mesh.vertices = fetch_positions(talk, slice, numbers, bounds.vertices);
    mesh.face_offsets = slice.face_offsets;
    mesh.face_vertices.reserve(slice.corners.size());
    for (const std::int64_t corner : slice.corners)
        mesh.face_vertices.push_back(static_cast<Index>(std::ranges::lower_bound(numbers, corner) - numbers.begin()));
    return mesh;
}

double length_around(std::span<const Index> corners, const Points& positions)
{
    double around = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k)
        around += (positions.row(corners[(k + 1) % corners.size()]) - positions.row(corners[k])).norm();
    return around;
}

std::vector<BlockSums> sum_blocks(const PolygonMesh& mesh)
{
    std::vector<BlockSums> blocks;
    for_each_block(run_serially, mesh.n_faces(), [&](Index, Index begin, Index end) {
        BlockSums sums;
        for (Index f = begin; f < end; ++f) {
            sums.area += area(mesh.face(f), mesh.vertices);
            sums.edges += length_around(mesh.face(f), mesh.vertices);
        }
        blocks.push_back(sums);
    });
    return blocks;
}

double extent_together(Conversation& talk, const Points& own)
{
    std::vector<std::array<double, 3>> corners;
    if (own.rows() > 0) {
        const Point low = own.colwise().minCoeff();
        const Point high = own.colwise().maxCoeff();
        corners = {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
    }
    corners = talk.gather_all(corners);
    if (corners.empty())
        return 0.0;
    const auto point = [](const std::array<double, 3>& corner) { return Point(corner[0], corner[1], corner[2]); };
    Point low = point(corners.front());
    Point high = low;
    for (const auto& corner : corners) {
        low = low.cwiseMin(point(corner));
        high = high.cwiseMax(point(corner));
    }
    return (high - low).norm();
}

}  // namespace

SharedMeshSize measure(Conversation& talk, const RankSlice& slice)
{
    const SliceBounds bounds = gather_bounds(talk, slice);
    talk.look_together([&] { require_corners_in_range(slice, bounds, talk.rank()); });
    SharedMeshSize size{.vertices = bounds.vertices.back(), .faces = bounds.faces.back()};
    double edges = 0.0;
    for (const BlockSums& sums : talk.gather_all(sum_blocks(mesh_of_faces(talk, slice, bounds)))) {
        size.area += sums.area;
        edges += sums.edges;
    }
    std::int64_t n_corners = 0;
    for (const std::size_t n : talk.gather_all(std::vector<std::size_t>{slice.corners.size()}))
        n_corners += static_cast<std::int64_t>(n);
    size.mean_edge = n_corners > 0 ? edges / static_cast<double>(n_corners) : 0.0;
    size.diagonal = extent_together(talk, slice.vertices);
    return size;
}

LengthStatistics measure_moves(Conversation& talk, const Points& before, const Points& after)
{
    std::vector<LengthSums> own;
    for_each_block(run_serially, static_cast<Index>(before.rows()), [&](Index, Index begin, Index end) {
        LengthSums& sums = own.emplace_back();
        for (Index v = begin; v < end; ++v)
            sums.add((after.row(v) - before.row(v)).norm());
    });
    LengthSums moved;
    for (const LengthSums& sums : talk.gather_all(own))
        moved.add(sums);
    return moved.statistics();
}

}  // namespace seamflow
