#include "engine/distributed/parts/field_rows.h"

#include <algorithm>
#include <cstddef>

#include "engine/distributed/parts/deal.h"

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
