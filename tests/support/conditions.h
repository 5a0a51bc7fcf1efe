#pragma once

#include <vector>

#include "solvers/conditions/transmission_condition.h"

namespace seamflow::test {

/// Left-hand side, in `row`, and right-hand side of a row, nothing being predicted.
inline Point row_of(const TransmissionCondition& condition, Index i, const Points& positions, std::vector<double>& row)
{
    row.resize(condition.columns()[i].size());
    condition.left_hand_side(i, positions, row);
    return condition.right_hand_side(i, positions, positions);
}

/// A row applied to positions.
inline Point applied(std::span<const Index> columns, std::span<const double> row, const Points& positions)
{
    Point sum = Point::Zero();
    for (std::size_t k = 0; k < columns.size(); ++k)
        sum += row[k] * positions.row(columns[k]);
    return sum;
}

}  // namespace seamflow::test
