#include "solvers/rounding/bounded_fairing.h"

#include <algorithm>
#include <vector>

namespace seamflow {

namespace {

/// The number of iterations in a row without a large motion, after which a fairing ends: the motions of an accelerated
/// gradient are small where it turns round.
constexpr int quiet_iterations = 5;

/// What one iteration has done, over all vertices.
struct IterationSums {
    /// The largest motion of a coordinate.
    double motion = 0.0;
    /// ⟨Y - X', X' - X⟩ with the extrapolated positions Y and the positions X before and X' after the iteration: above
    /// 0, it has gone back, as far as steps are alike at all vertices: a sign to begin anew.
    double against = 0.0;
};

/// Some of the coordinates of the vertices: #V by n, for n coordinates that may change.
template <int N>
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, N, N == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

/// The umbrella Laplacian and its use in iterations, on N coordinates.
template <int N>
class Fairing {
  public:
    /// @param columns the numbers of the coordinates.
    Fairing(const IndexLists& neighbours, const Boxes& boxes, const std::vector<int>& columns, const Executor& exec)
        : neighbours_(neighbours)
        , exec_(exec)
        , weight_(static_cast<double>(std::max<Index>(neighbours.size(), 1)) /
                  static_cast<double>(std::max<std::size_t>(neighbours.values.size(), 1)))
        , middles_(boxes.middles(Eigen::all, columns))
        , half_widths_(boxes.half_widths(Eigen::all, columns))
        , furthest_(boxes.furthest)
        , umbrellas_(neighbours.size(), N)
        , steps_(usize(neighbours.size()))
    {
        // By Gershgorin's theorem, a diagonal matrix with the sums of the absolute values of the rows of LᵀL is no
        // smaller than LᵀL: steps by its inverse are short enough at each vertex.
        std::vector<double> sums(usize(size()));
        for_each(exec_, size(), [&](Index v) { sums[usize(v)] = 2.0 * weight_ * degree(v); });
        for_each(exec_, size(), [&](Index v) {
            double total = degree(v) * sums[usize(v)];
            for (const Index w : neighbours_[v])
                total += sums[usize(w)];
            steps_[usize(v)] = total > 0.0 ? 1.0 / (weight_ * total) : 0.0;
        });
    }

    [[nodiscard]] FairingReport run(const FairingStop& stop, Coordinates<N>& positions)
    {
        Coordinates<N> extrapolated = positions;
        FairingReport report;
        // The number of iterations since the acceleration began.
        double accelerated = 0.0;
        for (int quiet = 0; report.iterations < stop.most_iterations && quiet < quiet_iterations; ++report.iterations) {
            // As in Nesterov's method: 0, 1/4, 2/5, 3/6, …
            const IterationSums sums = iterate(accelerated / (accelerated + 3.0), extrapolated, positions);
            accelerated += 1.0;
            if (sums.against > 0.0) {
                accelerated = 0.0;
                extrapolated = positions;
            }
            report.last_motion = sums.motion;
            quiet = sums.motion <= stop.motion ? quiet + 1 : 0;
        }
        return report;
    }

  private:
    using Row = Eigen::Matrix<double, 1, N>;

    [[nodiscard]] Index size() const { return neighbours_.size(); }

    [[nodiscard]] double degree(Index v) const { return static_cast<double>(neighbours_[v].size()); }

    [[nodiscard]] Row umbrella(const Coordinates<N>& values, Index v) const
    {
        Row total = degree(v) * values.row(v);
        for (const Index w : neighbours_[v])
            total -= values.row(w);
        return weight_ * total;
    }

    /// Takes an iteration from the extrapolated positions.
    /// @param momentum the fraction of the motion that is added for the next iteration.
    /// @param extrapolated Y; replaced by those of the next iteration. @param positions X; replaced by X'.
    IterationSums iterate(double momentum, Coordinates<N>& extrapolated, Coordinates<N>& positions)
    {
        for_each(exec_, size(), [&](Index v) { umbrellas_.row(v) = umbrella(extrapolated, v); });
        return reduce(
            exec_, size(), IterationSums(),
            [&](IterationSums& sums, Index v) {
                const Row from = extrapolated.row(v);
                const Row before = positions.row(v);
                const Row after = Boxes::nearest<N>(middles_.row(v), half_widths_.row(v),
                                                    from - steps_[usize(v)] * umbrella(umbrellas_, v), furthest_);
                const Row motion = after - before;
                sums.motion = std::max(sums.motion, motion.cwiseAbs().maxCoeff());
                sums.against += (from - after).dot(motion);
                positions.row(v) = after;
                extrapolated.row(v) = after + momentum * motion;
            },
            [](IterationSums& sums, const IterationSums& part) {
                sums.motion = std::max(sums.motion, part.motion);
                sums.against += part.against;
            });
    }

    const IndexLists& neighbours_;
    const Executor& exec_;
    /// 1 / d̄.
    double weight_;
    /// #V by N: those of the boxes.
    Coordinates<N> middles_;
    Coordinates<N> half_widths_;
    double furthest_;
    /// #V by N: L Y.
    Coordinates<N> umbrellas_;
    /// #V: the length of the gradient's step at each vertex.
    std::vector<double> steps_;
};

template <int N>
FairingReport fair_columns(const IndexLists& neighbours, const Boxes& boxes, const std::vector<int>& columns,
                           const FairingStop& stop, Points& positions, const Executor& exec)
{
    Coordinates<N> coordinates = positions(Eigen::all, columns);
    const FairingReport report = Fairing<N>(neighbours, boxes, columns, exec).run(stop, coordinates);
    positions(Eigen::all, columns) = coordinates;
    return report;
}

}  // namespace

FairingReport fair_in_boxes(const IndexLists& neighbours, const Boxes& boxes, const FairingStop& stop,
                            Points& positions, const Executor& exec)
{
    std::vector<int> columns;
    for (int axis = 0; axis < 3; ++axis)
        if (!boxes.half_widths.col(axis).isZero(0.0))
            columns.push_back(axis);
    switch (columns.size()) {
    case 0:
        return {};
    case 1:
        return fair_columns<1>(neighbours, boxes, columns, stop, positions, exec);
    case 2:
        return fair_columns<2>(neighbours, boxes, columns, stop, positions, exec);
    default:
        return fair_columns<3>(neighbours, boxes, columns, stop, positions, exec);
    }
}

}  // namespace seamflow
