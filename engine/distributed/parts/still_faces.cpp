#include "engine/distributed/parts/still_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

#include "engine/distributed/parts/number_set.h"
#include "engine/distributed/ranks/packing.h"
#include "engine/options/flow_options.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// The box around the corners of the ranges of all ranks.
/// @param positions of the corners of this rank's range.
BoundingBox box_of(Communicator& comm, const Points& positions)
{
    std::vector<std::array<double, 3>> own;
    if (positions.rows() > 0)
        for (const Point& end : {Point(positions.colwise().minCoeff()), Point(positions.colwise().maxCoeff())})
            own.push_back({end[0], end[1], end[2]});
    BoundingBox box;
    bool is_first = true;
    for (const auto& end : comm.gather_all(own)) {
        const Point point(end[0], end[1], end[2]);
        box.low = is_first ? point : Point(box.low.cwiseMin(point));
        box.high = is_first ? point : Point(box.high.cwiseMax(point));
        is_first = false;
    }
    return box;
}

/// The area of some faces of all ranks, added up by blocks of faces, at multiples of which ranges begin.
/// @param faces of this rank's range, ascending. @param positions of all its corners, which are `corners`.
double area_of(Communicator& comm, const RankSlice& slice, std::span<const Index> faces,
               const NumberSet<std::int64_t>& corners, const Points& positions)
{
    std::vector<double> of_blocks(at(slice.n_faces() / block_size) + 1, 0.0);
    std::vector<Index> face;
    for (const Index f : faces) {
        face.clear();
        for (Index corner = slice.face_offsets[f]; corner < slice.face_offsets[f + 1]; ++corner)
            face.push_back(corners.place_of(slice.corners[corner]));
        of_blocks[f / block_size] += vector_area(face, positions).norm();
    }
    const std::vector<double> all = comm.gather_all(of_blocks);
    return std::accumulate(all.begin(), all.end(), 0.0);
}

/// How many vertices of this rank's range are corners of no face of any rank.
Index count_without_faces(Communicator& comm, const RankSlice& slice, std::span<const std::int64_t> bounds)
{
    std::vector<std::int64_t> corners = slice.corners;
    sort_unique(corners);
    std::vector<Bytes> to_each;
    for (auto begin = corners.begin(); const std::int64_t bound : bounds.subspan(1)) {
        const auto end = std::lower_bound(begin, corners.end(), bound);
        to_each.push_back(packed(std::span<const std::int64_t>(begin, end)));
        begin = end;
    }
    std::vector<std::uint8_t> has_face(at(static_cast<Index>(slice.vertices.rows())), 0);
    for (const Bytes& bytes : comm.exchange(std::move(to_each)))
        for (const std::int64_t corner : unpacked<std::int64_t>(bytes))
            has_face[static_cast<std::size_t>(corner - bounds[comm.rank()])] = 1;
    return static_cast<Index>(std::ranges::count(has_face, 0));
}

}  // namespace

std::vector<Index> labels_without(const std::vector<Index>& labels, std::span<const Index> faces)
{
    std::vector<Index> left;
    auto next = faces.begin();
    for (std::size_t f = 0; f < labels.size(); ++f)
        if (next != faces.end() && at(*next) == f)
            ++next;
        else
            left.push_back(labels[f]);
    return left;
}

std::vector<Index> labels_with(const std::vector<Index>& labels, std::span<const Index> faces, Index label)
{
    std::vector<Index> all(labels.size() + faces.size(), label);
    auto next = faces.begin();
    auto of_face = labels.begin();
    for (std::size_t f = 0; f < all.size(); ++f)
        if (next != faces.end() && at(*next) == f)
            ++next;
        else
            all[f] = *of_face++;
    return all;
}

void leave_out(std::span<const Index> faces, RankSlice& slice)
{
    RankSlice left;
    auto next = faces.begin();
    for (Index f = 0; f < slice.n_faces(); ++f) {
        if (next != faces.end() && *next == f) {
            ++next;
            continue;
        }
        left.corners.insert(left.corners.end(), slice.corners.begin() + slice.face_offsets[f],
                            slice.corners.begin() + slice.face_offsets[f + 1]);
        left.face_offsets.push_back(static_cast<Index>(left.corners.size()));
    }
    slice.labels = labels_without(slice.labels, faces);
    slice.face_offsets = std::move(left.face_offsets);
    slice.corners = std::move(left.corners);
}

StillFaces leave_out_still_faces(Communicator& comm, std::span<const double> strengths, RankSlice& slice)
{
    const SliceBounds bounds = gather_bounds(comm, slice);
    const NumberSet<std::int64_t> corners(slice.corners);
    const std::vector<std::int64_t> numbers = corners.numbers();
    std::vector<double> of_corners(numbers.size());
    fetch_rows(comm, {strengths, 1}, numbers, bounds.vertices, of_corners);
    const Points positions = fetch_positions(comm, slice, numbers, bounds.vertices);
    const auto is_still = [&](std::int64_t corner) {
        return of_corners[at(corners.place_of(corner))] < MotionOptions::least_strength;
    };
    StillFaces still{.faces = select(run_in_parallel, slice.n_faces(),
                                     [&](Index f) {
                                         return std::all_of(slice.corners.begin() + slice.face_offsets[f],
                                                            slice.corners.begin() + slice.face_offsets[f + 1],
                                                            is_still);
                                     }),
                     .box = box_of(comm, positions)};
    still.area = area_of(comm, slice, still.faces, corners, positions);
    leave_out(still.faces, slice);
    still.n_left = gather_bounds(comm, slice).faces.back();
    slice.n_still = still.n_left < bounds.faces.back() ? count_without_faces(comm, slice, bounds.vertices) : 0;
    return still;
}

}  // namespace seamflow
