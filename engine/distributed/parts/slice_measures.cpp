#include "engine/distributed/parts/slice_measures.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "engine/distributed/parts/corner_positions.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/executor.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// Sums over a block of faces.
struct BlockSums {
    double area = 0.0;
    double edges = 0.0;
};

double length_around(const Points& corners)
{
    const auto n = corners.rows();
    double around = 0.0;
    for (Eigen::Index k = 0; k < n; ++k)
        around += (corners.row((k + 1) % n) - corners.row(k)).norm();
    return around;
}

/// Blocks of the faces of a range.
std::vector<BlockSums> sum_blocks(const RankSlice& slice, const CornerPositions& positions)
{
    std::vector<BlockSums> blocks(at(slice.n_faces() / block_size) + (slice.n_faces() % block_size > 0 ? 1 : 0));
    for_each_block(run_in_parallel, slice.n_faces(), [&](Index block, Index begin, Index end) {
        BlockSums& sums = blocks[block];
        Points corners;
        std::vector<Index> numbers;
        for (Index f = begin; f < end; ++f) {
            const Index n = slice.face_offsets[f + 1] - slice.face_offsets[f];
            corners.resize(n, 3);
            numbers.resize(at(n));
            std::iota(numbers.begin(), numbers.end(), 0);
            for (Index k = 0; k < n; ++k)
                corners.row(k) = positions[slice.corners[slice.face_offsets[f] + k]];
            sums.area += area(numbers, corners);
            sums.edges += length_around(corners);
        }
    });
    return blocks;
}

double extent_together(Communicator& comm, const Points& own)
{
    std::vector<std::array<double, 3>> corners;
    if (own.rows() > 0) {
        const Point low = own.colwise().minCoeff();
        const Point high = own.colwise().maxCoeff();
        corners = {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
    }
    corners = comm.gather_all(corners);
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

SharedMeshSize measure(Communicator& comm, const RankSlice& slice)
{
    const SliceBounds bounds = gather_bounds(comm, slice);
    comm.look_together([&] { require_corners(slice, bounds, comm.rank()); });
    SharedMeshSize size{.vertices = bounds.vertices.back(), .faces = bounds.faces.back()};
    double edges = 0.0;
    for (const BlockSums& sums : comm.gather_all(sum_blocks(slice, CornerPositions(comm, slice, bounds)))) {
        size.area += sums.area;
        edges += sums.edges;
    }
    std::int64_t n_corners = 0;
    for (const std::size_t n : comm.gather_all(std::vector<std::size_t>{slice.corners.size()}))
        n_corners += static_cast<std::int64_t>(n);
    size.mean_edge = n_corners > 0 ? edges / static_cast<double>(n_corners) : 0.0;
    size.diagonal = extent_together(comm, slice.vertices);
    return size;
}

LengthStatistics measure_moves(Communicator& comm, const Points& before, const Points& after)
{
    std::vector<LengthSums> own;
    for_each_block(run_serially, static_cast<Index>(before.rows()), [&](Index, Index begin, Index end) {
        LengthSums& sums = own.emplace_back();
        for (Index v = begin; v < end; ++v)
            sums.add((after.row(v) - before.row(v)).norm());
    });
    LengthSums moved;
    for (const LengthSums& sums : comm.gather_all(own))
        moved.add(sums);
    return moved.statistics();
}

}  // namespace seamflow
