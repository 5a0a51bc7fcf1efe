#include "engine/distributed/parts/field_rows.h"

#include <algorithm>
#include <cstddef>

#include "engine/distributed/parts/number_set.h"
#include "engine/distributed/parts/still_faces.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/executor.h"

namespace seamflow {

Eigen::MatrixXd fetch_fields(Communicator& comm, const Eigen::MatrixXd& of_range, std::span<const std::int64_t> numbers,
                             std::span<const std::int64_t> bounds)
{
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto span_of = [](auto& rows) { return std::span(rows.data(), static_cast<std::size_t>(rows.size())); };
    const Rows own = of_range;
    Rows fetched(static_cast<Eigen::Index>(numbers.size()), own.cols());
    fetch_rows(comm, {span_of(own), own.cols()}, numbers, bounds, span_of(fetched));
    return fetched;
}

void leave_out_faces_without_data(Communicator& comm, std::span<const std::uint8_t> lacks, RankSlice& slice)
{
    const std::vector<double> own(lacks.begin(), lacks.end());
    const NumberSet<std::int64_t> corners(slice.corners);
    const std::vector<std::int64_t> numbers = corners.numbers();
    std::vector<double> of_corners(numbers.size());
    fetch_rows(comm, {own, 1}, numbers, gather_bounds(comm, slice).vertices, of_corners);
    const auto lacks_data = [&](std::int64_t corner) { return of_corners[at(corners.place_of(corner))] != 0.0; };
    leave_out(select(run_in_parallel, slice.n_faces(),
                     [&](Index f) {
                         return std::any_of(slice.corners.begin() + slice.face_offsets[f],
                                            slice.corners.begin() + slice.face_offsets[f + 1], lacks_data);
                     }),
              slice);
}

void collect_fields(Communicator& comm, std::span<const std::int64_t> numbers, const Eigen::MatrixXd& of_part,
                    Eigen::MatrixXd& of_range)
{
    constexpr Eigen::Index width = 3;
    for (Eigen::Index c = 0; c < of_range.cols(); c += width) {
        const Eigen::Index n = std::min(width, of_range.cols() - c);
        Points rows = Points::Zero(of_part.rows(), width);
        rows.leftCols(n) = of_part.middleCols(c, n);
        RankSlice slice;
        slice.vertices = Points::Zero(of_range.rows(), width);
        slice.vertices.leftCols(n) = of_range.middleCols(c, n);
        collect_positions(comm, numbers, rows, slice);
        of_range.middleCols(c, n) = slice.vertices.leftCols(n);
    }
}

}  // namespace seamflow
