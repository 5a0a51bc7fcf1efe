#include "solvers/denoising/position_filters.h"

#include <algorithm>

#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// Per vertex: its position times its weight, and the weight.
using WeightedPositions = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 1>;

/// The rounds over which the squared distances of vertices are averaged, and the fraction of this mean at which a
/// vertex has half the weight.
constexpr int rounds_of_spread = 4;
constexpr double half_weight = 0.25;

}  // namespace

PositionFilters::PositionFilters(const Topology& topology, const IndexLists& neighbours)
    : neighbours_(&neighbours)
    , is_interior_(usize(neighbours.size()))
{
    for (Index v = 0; v < neighbours.size(); ++v)
        is_interior_[v] = topology.kind[v] == VertexKind::Interior ? 1 : 0;
}

/// Makes each row the mean of itself and the mean of its neighbours' rows.
template <class Rows>
void PositionFilters::average(const Rows& from, Rows& to, const Executor& exec) const
{
    for_each(exec, static_cast<Index>(from.rows()), [&](Index v) {
        to.row(v) = from.row(v);
        const auto around = (*neighbours_)[v];
        if (around.empty())
            return;
        Eigen::Matrix<double, 1, Rows::ColsAtCompileTime> total = from.row(around[0]);
        for (std::size_t k = 1; k < around.size(); ++k)
            total += from.row(around[k]);
        to.row(v) += 0.5 * (total / static_cast<double>(around.size()) - from.row(v));
    });
}

std::vector<Points> PositionFilters::low_pass(const Points& positions, const std::vector<int>& rounds,
                                              const Executor& exec) const
{
    // 1 - (1 - S)³ = 3 S - 3 S² + S³
    std::vector<Points> results(rounds.size(), Points::Zero(positions.rows(), 3));
    Points before;
    Points now = positions;
    const auto n = static_cast<Index>(positions.rows());
    const int last = 3 * rounds.back();
    for (int round = 1; round <= last; ++round) {
        before = now;
        average(before, now, exec);
        for_each(exec, n, [&](Index v) {
            if (is_interior_[v] == 0)
                now.row(v) = positions.row(v);
        });
        for (std::size_t i = 0; i < rounds.size(); ++i)
            for (int power = 1; power <= 3; ++power)
                if (round == power * rounds[i]) {
                    const double factor = power == 1 ? 3.0 : power == 2 ? -3.0 : 1.0;
                    for_each(exec, n, [&](Index v) { results[i].row(v) += factor * now.row(v); });
                }
    }
    return results;
}

std::vector<Points> PositionFilters::robust_low_pass(const Points& positions, const Points& filtered,
                                                     const Points& normals, const std::vector<int>& rounds,
                                                     const Executor& exec) const
{
    const auto n = static_cast<Index>(positions.rows());
    Numbers squares(n);
    for_each(exec, n, [&](Index v) {
        const double distance = (positions.row(v) - filtered.row(v)).dot(normals.row(v));
        squares[v] = distance * distance;
    });
    Numbers around = squares;
    for (int round = 0; round < rounds_of_spread; ++round) {
        const Numbers before = around;
        for_each(exec, n, [&](Index v) {
            for (const Index w : (*neighbours_)[v])
                around[v] += before[w];
            around[v] /= static_cast<double>(1 + (*neighbours_)[v].size());
        });
    }
    Numbers weights(n);
    for_each(exec, n, [&](Index v) {
        weights[v] = squares[v] > 0.0 ? 1.0 / (1.0 + squares[v] / (half_weight * around[v])) : 1.0;
    });
    WeightedPositions before;
    WeightedPositions now(n, 4);
    std::vector<Points> results;
    for (const int rounds_of_step : rounds) {
        // 1 - (1 - S)³, where S takes weighted means: S is applied to the positions, then twice to the difference.
        Points result = Points::Zero(n, 3);
        for (int step = 0; step < 3; ++step) {
            for_each(exec, n, [&](Index v) {
                now.row(v).head<3>() = weights[v] * (positions.row(v) - result.row(v));
                now(v, 3) = weights[v];
            });
            for (int round = 0; round < rounds_of_step; ++round) {
                before = now;
                average(before, now, exec);
            }
            for_each(exec, n, [&](Index v) { result.row(v) += now.row(v).head<3>() / now(v, 3); });
        }
        for_each(exec, n, [&](Index v) {
            if (is_interior_[v] == 0)
                result.row(v) = positions.row(v);
        });
        results.push_back(std::move(result));
    }
    return results;
}

}  // namespace seamflow
