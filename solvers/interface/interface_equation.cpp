#include "solvers/interface/interface_equation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "partition/errors.h"
#include "solvers/interface/power_of_two.h"
#include "solvers/stagnation.h"
#include "solvers/systems/messages.h"

namespace seamflow {

namespace {

/// How much of the residual single precision may take away before it is measured anew.
constexpr double most_reduction_at_once = 1e-4;
/// And the same after so many iterations, however little they have taken away.
constexpr int most_iterations_at_once = 100;
/// A residual that is larger, relative to that at the beginning, need not be measured anew.
constexpr double largest_to_measure = 1e-3;
/// What may be left of the residual from one measurement to the next without the iteration having stalled.
constexpr double most_left = 0.5;

/// Not a number where a norm is none.
double largest_ratio(const std::array<double, 3>& norms, const std::array<double, 3>& first)
{
    double largest = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
        if (const double ratio = norms[c] / first[c]; first[c] != 0.0 && !(ratio <= largest))
            largest = std::isnan(largest) ? largest : ratio;
    return largest;
}

/// Where the denominator is 0, 0.
Point quotients(const std::array<double, 3>& numerators, const std::array<double, 3>& denominators)
{
    Point result = Point::Zero();
    for (std::size_t c = 0; c < 3; ++c)
        if (denominators[c] > 0.0)
            result[static_cast<Eigen::Index>(c)] = numerators[c] / denominators[c];
    return result;
}

}  // namespace

InterfaceEquation::InterfaceEquation(const Decomposition& decomposition, Balancing balancing)
    : copies_(decomposition)
    , weights_(at(copies_.n_copies()))
    , residual_copies_(copies_.n_copies(), 3)
    , right_hand_side_(copies_.n_vertices(), 3)
    , residual_(copies_.n_vertices(), 3)
    , direction_(copies_.n_vertices(), 3)
    , product_(copies_.n_vertices(), 3)
    , preconditioned_(copies_.n_vertices(), 3)
    , partial_(at(copies_.n_vertices() / block_size) + 1)
{
    std::size_t n_numbers = 0;
    for (Index s = 0; s < copies_.n_sub_meshes(); ++s) {
        first_product_.push_back(n_numbers);
        n_numbers += 6 * DenseFactor::room(copies_.n_in(s));
    }
    products_.assign(n_numbers);
    if (balancing == Balancing::Coarse)
        coarse_.emplace(copies_);
}

InterfaceResult InterfaceEquation::solve(std::span<const NeumannSystem* const> systems, const Points& right_hand_sides,
                                         const Points& guess, const InterfaceStop& stop, Points& x, const Loop& loop)
{
    x.setZero(copies_.n_vertices(), 3);
    weigh_copies(systems, loop);
    if (coarse_)
        coarse_->prepare(systems, weights_, loop);
    sum_copies(right_hand_sides, right_hand_side_, loop);
    const Point unit = measure_right_hand_side();
    residual_ = right_hand_side_;
    const Sums first = norms(loop);
    step_length_.setOnes();
    if (stop.iterations > 0)
        start(systems, guess.array().rowwise() / unit.array(), x, loop);
    Sums present = norms(loop);
    const auto measure_anew = [&] {
        if (largest_ratio(present, first) > largest_to_measure)
            return;
        measure_residual(systems, x, loop);
        present = norms(loop);
    };
    measure_anew();
    InterfaceResult result;
    Stagnation stagnation(most_left);
    while (result.iterations < stop.iterations && largest_ratio(present, first) > stop.tolerance &&
           !stagnation.is_reached()) {
        Sums goals;
        for (std::size_t c = 0; c < 3; ++c)
            goals[c] = std::max(stop.tolerance * first[c], most_reduction_at_once * present[c]);
        const int most = std::min(stop.iterations - result.iterations, most_iterations_at_once);
        result.iterations += iterate(systems, goals, most, x, loop);
        const Sums before = present;
        present = norms(loop);
        measure_anew();
        stagnation.note(largest_ratio(present, before));
        // Rounding can spoil the directions so much that they lead nowhere: new ones then.
        if (stagnation.is_stalling())
            curvature_ = {};
    }
    result.residual = largest_ratio(present, first);
    if (!std::isfinite(result.residual))
        throw ComputationError(result_not_finite);
    result.stagnated = stagnation.is_reached() && result.residual > stop.tolerance;
    result.estimated_distance = estimate_distance(systems, unit, loop);
    x.array().rowwise() *= unit.array();
    return result;
}

/// Columns are in units of their own while they are solved for, so that squares of their rows have room.
Point InterfaceEquation::measure_right_hand_side()
{
    Point unit = Point::Ones();
    if (right_hand_side_.rows() > 0)
        unit = Point(right_hand_side_.cwiseAbs().colwise().maxCoeff()).unaryExpr(&power_of_two_near);
    right_hand_side_.array().rowwise() /= unit.array();
    return unit;
}

/// As far as the next iteration would go if it were as long as the last one, not being conjugate to any.
double InterfaceEquation::estimate_distance(std::span<const NeumannSystem* const> systems, const Point& unit,
                                            const Loop& loop)
{
    precondition(systems, loop);
    double largest = 0.0;
    for (Index v = 0; v < copies_.n_vertices(); ++v)
        largest = std::max(largest, preconditioned_.row(v).cwiseProduct(step_length_).cwiseProduct(unit).norm());
    return largest;
}

/// By the diagonals of the Schur complements.
void InterfaceEquation::weigh_copies(std::span<const NeumannSystem* const> systems, const Loop& loop)
{
    for_each(loop, copies_.n_sub_meshes(), [&](Index s) {
        const std::vector<double>& diagonal = systems[at(s)]->schur().diagonal();
        std::copy(diagonal.begin(), diagonal.end(), weights_.begin() + copies_.first[at(s)]);
    });
    for_each(loop, copies_.n_vertices(), [&](Index v) {
        double sum = 0.0;
        for (const Index copy : copies_.of_vertex[v])
            sum += weights_[at(copy)];
        for (const Index copy : copies_.of_vertex[v])
            weights_[at(copy)] /= sum;
    });
}

/// In double precision. The shares of the right-hand side may cancel each other almost wholly: only their sum is used.
void InterfaceEquation::measure_residual(std::span<const NeumannSystem* const> systems, const Points& x,
                                         const Loop& loop)
{
    for_each(loop, copies_.n_sub_meshes(), [&](Index s) {
        const Index first = copies_.first[at(s)];
        const Index n = copies_.n_in(s);
        Points local(n, 3);
        for (Index i = 0; i < n; ++i)
            local.row(i) = x.row(copies_.vertex[at(first + i)]);
        auto change = residual_copies_.middleRows(first, n);
        change.setZero();
        systems[at(s)]->subtract_schur(local, change);
    });
    sum_copies(residual_copies_, residual_, loop);
    residual_ += right_hand_side_;
}

void InterfaceEquation::sum_copies(const Points& copies, Points& sums, const Loop& loop)
{
    for_each(loop, copies_.n_vertices(), [&](Index v) {
        Point sum = Point::Zero();
        for (const Index copy : copies_.of_vertex[v])
            sum += copies.row(copy);
        sums.row(v) = sum;
    });
}

/// Moves the coarse unknowns to where they have to be: only from there on is the preconditioner symmetric. Then goes as
/// far along the guess as pays.
void InterfaceEquation::start(std::span<const NeumannSystem* const> systems, const Points& guess, Points& x,
                              const Loop& loop)
{
    curvature_ = {};
    direction_.setZero();
    product_.setZero();
    if (coarse_) {
        coarse_->correct(residual_, direction_, loop);
        advance(systems, x, loop);
    }
    if (guess.size() > 0) {
        direction_ = guess;
        if (coarse_)
            coarse_->correct(residual_, direction_, loop);
        advance(systems, x, loop);
    }
    step_length_.setOnes();
}

/// Conjugate gradients; x and the residual are brought up to date.
/// @returns how many iterations.
int InterfaceEquation::iterate(std::span<const NeumannSystem* const> systems, const Sums& goals, int most, Points& x,
                               const Loop& loop)
{
    for (int iteration = 0; iteration < most; ++iteration) {
        precondition(systems, loop);
        // Conjugate to the direction before even where the residual has just been renewed.
        const Point beta = -quotients(dot(preconditioned_, product_, loop), curvature_);
        for_each(loop, copies_.n_vertices(),
                 [&](Index v) { direction_.row(v) = preconditioned_.row(v) + direction_.row(v).cwiseProduct(beta); });
        advance(systems, x, loop);
        const Sums lengths = norms(loop);
        if (lengths[0] <= goals[0] && lengths[1] <= goals[1] && lengths[2] <= goals[2])
            return iteration + 1;
    }
    return most;
}

/// Goes along the direction to where the energy is least.
void InterfaceEquation::advance(std::span<const NeumannSystem* const> systems, Points& x, const Loop& loop)
{
    multiply(systems, loop);
    curvature_ = dot(direction_, product_, loop);
    step_length_ = quotients(dot(direction_, residual_, loop), curvature_);
    for_each(loop, copies_.n_vertices(), [&](Index v) {
        x.row(v) += direction_.row(v).cwiseProduct(step_length_);
        residual_.row(v) -= product_.row(v).cwiseProduct(step_length_);
    });
}

void InterfaceEquation::multiply(std::span<const NeumannSystem* const> systems, const Loop& loop)
{
    on_each(systems, direction_, false, product_, loop,
            [](const DenseFactor& schur, FloatColumns columns, FloatColumns result) {
                schur.multiply(columns, result);
                return std::pair(result, schur.scale());
            });
}

void InterfaceEquation::precondition(std::span<const NeumannSystem* const> systems, const Loop& loop)
{
    on_each(systems, residual_, true, preconditioned_, loop,
            [](const DenseFactor& schur, FloatColumns columns, FloatColumns scratch) {
                schur.solve(columns, scratch);
                return std::pair(columns, 1.0 / schur.scale());
            });
    if (coarse_)
        coarse_->correct(residual_, preconditioned_, loop);
}

/// target = Σ W_i apply(W_i source) over the sub-meshes, W_i = 1 where not weighted. Applied to columns in units of
/// their own, so that single precision has room for lengths of any unit; `apply` returns which columns have its result,
/// and by what that is to be multiplied.
template <class Apply>
void InterfaceEquation::on_each(std::span<const NeumannSystem* const> systems, const Points& source, bool weighted,
                                Points& target, const Loop& loop, Apply&& apply)
{
    const auto weight = [&](Index copy) { return weighted ? weights_[at(copy)] : 1.0; };
    for_each(loop, copies_.n_sub_meshes(), [&](Index s) {
        if (s + 1 < copies_.n_sub_meshes())
            systems[at(s + 1)]->schur().prefetch();
        const Index n = copies_.n_in(s);
        const Index first = copies_.first[at(s)];
        const std::size_t room = DenseFactor::room(n);
        const FloatColumns columns = columns_at(products_.data() + first_product_[at(s)], room);
        const FloatColumns scratch = columns_at(columns.x + 3 * room, room);
        // In plain numbers, which takes less time than expressions of rows.
        double* const rows = residual_copies_.data() + Eigen::Index{3} * first;
        double largest[3] = {};
        for (Index i = 0; i < n; ++i) {
            const double* const row = source.row(copies_.vertex[at(first + i)]).data();
            const double w = weight(first + i);
            for (Index c = 0; c < 3; ++c) {
                rows[3 * i + c] = w * row[c];
                largest[c] = std::max(largest[c], std::abs(rows[3 * i + c]));
            }
        }
        Point unit;
        Point inverse;
        for (Index c = 0; c < 3; ++c) {
            unit[c] = power_of_two_near(largest[c]);
            inverse[c] = 1.0 / unit[c];
        }
        for (Index i = 0; i < n; ++i) {
            columns.x[i] = static_cast<float>(rows[3 * i] * inverse[0]);
            columns.y[i] = static_cast<float>(rows[3 * i + 1] * inverse[1]);
            columns.z[i] = static_cast<float>(rows[3 * i + 2] * inverse[2]);
        }
        // What was not finite may have been in a solution before.
        for (std::size_t c = 0; c < 6; ++c)
            std::fill(columns.x + c * room + at(n), columns.x + (c + 1) * room, 0.0F);
        const std::pair<FloatColumns, double> applied = apply(systems[at(s)]->schur(), columns, scratch);
        const FloatColumns& result = applied.first;
        const Point factor = applied.second * unit;
        for (Index i = 0; i < n; ++i) {
            rows[3 * i] = factor[0] * result.x[i];
            rows[3 * i + 1] = factor[1] * result.y[i];
            rows[3 * i + 2] = factor[2] * result.z[i];
        }
    });
    for_each(loop, copies_.n_vertices(), [&](Index v) {
        Point sum = Point::Zero();
        for (const Index copy : copies_.of_vertex[v])
            sum += weight(copy) * residual_copies_.row(copy);
        target.row(v) = sum;
    });
}

InterfaceEquation::Sums InterfaceEquation::dot(const Points& a, const Points& b, const Loop& loop)
{
    const Index n = copies_.n_vertices();
    for_each_block(loop, n, [&](Index block, Index begin, Index end) {
        Point sum = Point::Zero();
        for (Index v = begin; v < end; ++v)
            sum += a.row(v).cwiseProduct(b.row(v));
        partial_[at(block)] = {sum[0], sum[1], sum[2]};
    });
    Sums total{};
    const Index n_blocks = n / block_size + (n % block_size > 0 ? 1 : 0);
    for (Index block = 0; block < n_blocks; ++block)
        for (std::size_t c = 0; c < 3; ++c)
            total[c] += partial_[at(block)][c];
    return total;
}

/// Of the residual's three columns.
InterfaceEquation::Sums InterfaceEquation::norms(const Loop& loop)
{
    Sums lengths = dot(residual_, residual_, loop);
    for (double& length : lengths)
        length = std::sqrt(length);
    return lengths;
}

}  // namespace seamflow
