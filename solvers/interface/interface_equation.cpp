#include "solvers/interface/interface_equation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solvers/direct/dense_factor.h"
#include "solvers/systems/checks.h"

namespace seamflow {

InterfaceEquation::InterfaceEquation(const Decomposition& decomposition, Balancing balancing, InterfaceRanks& ranks)
    : ranks_(&ranks)
    , copies_(decomposition)
    , shared_(shared_copies(copies_, ranks))
    , weights_(copies_.n_copies())
    , residual_copies_(copies_.n_copies(), 3)
    , right_hand_side_(copies_.n_vertices(), 3)
    , sums_(copies_, ranks)
    , vectors_(copies_.n_vertices(), [this](std::initializer_list<VectorPair> pairs, const Executor& exec) {
        return sums_.products(pairs, exec);
    })
{
    std::size_t n_numbers = 0;
    for (Index s = 0; s < copies_.n_sub_meshes(); ++s) {
        first_product_.push_back(n_numbers);
        n_numbers += 6 * DenseFactor::room(copies_.n_in(s));
    }
    products_.assign(n_numbers);
    if (balancing == Balancing::Coarse)
        coarse_.emplace(copies_, ranks);
}

void InterfaceEquation::set_fixed(Index vertex, bool is_fixed)
{
    is_fixed_.resize(usize(copies_.n_vertices()), 0);
    is_fixed_[vertex] = is_fixed ? 1 : 0;
}

InterfaceResult InterfaceEquation::solve(std::span<const DenseFactor> complements, bool are_known,
                                         Points& right_hand_sides, const Residuals& residuals, const Points* guess,
                                         const IterationStop& stop, Points& x, const Executor& exec)
{
    x.setZero(copies_.n_vertices(), 3);
    if (!are_known) {
        weigh_copies(complements, exec);
        if (coarse_)
            coarse_->prepare(complements, weights_, exec);
    }
    sum_copies(right_hand_sides, right_hand_side_, exec);
    const Point unit = measure_right_hand_side();
    vectors_.begin(right_hand_side_, exec);
    const MapPoints multiply = [&](const Points& p, Points& product) { this->multiply(complements, p, product, exec); };
    const MapPoints precondition = [&](const Points& r, Points& z) { this->precondition(complements, r, z, exec); };
    const MapPoints measure = [&](const Points& at_x, Points& r) {
        sum_copies(residuals((at_x.array().rowwise() * unit.array()).matrix()), r, exec);
        r.array().rowwise() /= unit.array();
    };
    if (stop.iterations > 0)
        set_initial_solution(multiply, guess, unit, x, exec);
    InterfaceResult result{
        conjugate_gradients(PreconditionedEquations{multiply, precondition, measure}, stop, x, vectors_, exec)};
    require_finite_result(std::isfinite(result.residual));
    result.residuals = quotients(vectors_.norms(vectors_.r, exec), vectors_.b_norms);
    precondition(vectors_.r, vectors_.z);
    result.estimated_distance = estimate_distance(unit);
    x.array().rowwise() *= unit.array();
    return result;
}

/// Divides each column of the right-hand side by a unit of its own, so that squares of its rows do not overflow.
/// @returns the units: powers of two.
Point InterfaceEquation::measure_right_hand_side()
{
    Point largest = Point::Zero();
    if (right_hand_side_.rows() > 0)
        largest = right_hand_side_.cwiseAbs().colwise().maxCoeff();
    const std::vector<double> of_all = ranks_->largest({largest[0], largest[1], largest[2]});
    const Point unit = Point(of_all[0], of_all[1], of_all[2]).unaryExpr(&power_of_two_near);
    right_hand_side_.array().rowwise() /= unit.array();
    return unit;
}

/// The farthest that the next step of conjugate gradients would move a vertex of Γ, on any rank, if it had the step
/// size of the last one and its direction were the preconditioned residual alone.
double InterfaceEquation::estimate_distance(const Point& unit)
{
    double largest = 0.0;
    for (Index v = 0; v < copies_.n_vertices(); ++v)
        largest = std::max(largest, vectors_.z.row(v).cwiseProduct(vectors_.alpha).cwiseProduct(unit).norm());
    return ranks_->largest({largest}).front();
}

/// Sets weights_: the weights of the copies of a vertex are in proportion to their diagonal entries of the Schur
/// complements, and add up to 1.
void InterfaceEquation::weigh_copies(std::span<const DenseFactor> complements, const Executor& exec)
{
    for_each(exec, copies_.n_sub_meshes(), [&](Index s) {
        if (!ranks_->is_own(s))
            return;
        const std::vector<double>& diagonal = complements[s].diagonal();
        std::copy(diagonal.begin(), diagonal.end(), weights_.begin() + copies_.offsets[s]);
    });
    shared_.exchange(weights_.data(), 1);
    for_each(exec, copies_.n_vertices(), [&](Index v) {
        double sum = 0.0;
        for (const Index copy : copies_.of_vertex[v])
            sum += weights_[copy];
        for (const Index copy : copies_.of_vertex[v])
            weights_[copy] = is_fixed(v) ? 0.0 : weights_[copy] / sum;
    });
}

/// Replaces the rows of all copies of a vertex by their sum. The shares may cancel each other almost completely: only
/// their sum is meaningful.
void InterfaceEquation::sum_copies(Points& copies, Points& sums, const Executor& exec)
{
    shared_.exchange(copies.data(), 3);
    for_each(exec, copies_.n_vertices(), [&](Index v) {
        Point sum = Point::Zero();
        for (const Index copy : copies_.of_vertex[v])
            sum += copies.row(copy);
        sums.row(v) = sum;
    });
}

/// Begins with an x that satisfies the coarse equations: the balanced preconditioner is symmetric only from there. Then
/// moves x along the guess to the least error.
void InterfaceEquation::set_initial_solution(const MapPoints& multiply, const Points* guess, const Point& unit,
                                             Points& x, const Executor& exec)
{
    if (coarse_) {
        coarse_->correct(vectors_.r, vectors_.p, exec);
        advance(multiply, x, vectors_, exec);
    }
    if (guess != nullptr) {
        vectors_.p = guess->array().rowwise() / unit.array();
        for (Index v = 0; v < copies_.n_vertices(); ++v)
            if (is_fixed(v))
                vectors_.p.row(v).setZero();
        if (coarse_)
            coarse_->correct(vectors_.r, vectors_.p, exec);
        advance(multiply, x, vectors_, exec);
    }
    // Until now, α was the step size along the guess. If no iteration follows, estimate_distance uses 1.
    vectors_.alpha.setOnes();
}

/// product = S direction.
void InterfaceEquation::multiply(std::span<const DenseFactor> complements, const Points& direction, Points& product,
                                 const Executor& exec)
{
    sum_over_sub_meshes(complements, direction, false, product, exec,
                        [](const DenseFactor& schur, FloatColumns columns, FloatColumns result) {
                            schur.multiply(columns, result);
                            return std::pair(result, schur.scale());
                        });
}

/// preconditioned = Σ W_i S_i⁻¹ W_i residual, balanced if there is a coarse space.
void InterfaceEquation::precondition(std::span<const DenseFactor> complements, const Points& residual,
                                     Points& preconditioned, const Executor& exec)
{
    sum_over_sub_meshes(complements, residual, true, preconditioned, exec,
                        [](const DenseFactor& schur, FloatColumns columns, FloatColumns scratch) {
                            schur.solve(columns, scratch);
                            return std::pair(columns, 1.0 / schur.scale());
                        });
    if (coarse_)
        coarse_->correct(residual, preconditioned, exec);
}

/// target = Σ W_i apply(W_i source) over the sub-meshes, W_i = 1 where not weighted. `apply` gets columns in units of
/// their own, so that single precision can represent lengths of any unit. It returns the columns with its result, and
/// the factor to multiply the result by.
template <class Apply>
void InterfaceEquation::sum_over_sub_meshes(std::span<const DenseFactor> complements, const Points& source,
                                            bool weighted, Points& target, const Executor& exec, Apply&& apply)
{
    const auto weight = [&](Index copy) { return weighted ? weights_[copy] : 1.0; };
    for_each(exec, copies_.n_sub_meshes(), [&](Index s) {
        if (!ranks_->is_own(s))
            return;
        if (s + 1 < copies_.n_sub_meshes())
            complements[s + 1].prefetch();
        const Index n = copies_.n_in(s);
        const Index first = copies_.offsets[s];
        const std::size_t room = DenseFactor::room(n);
        const FloatColumns columns = columns_at(products_.data() + first_product_[s], room);
        const FloatColumns scratch = columns_at(columns.x + 3 * room, room);
        // Plain numbers, because expressions of Eigen's rows are slower here.
        double* const rows = residual_copies_.data() + Eigen::Index{3} * first;
        double largest[3] = {};
        for (Index i = 0; i < n; ++i) {
            const double* const row = source.row(copies_.vertex[first + i]).data();
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
        // A previous solution may have left values that are not finite.
        for (std::size_t c = 0; c < 6; ++c)
            std::fill(columns.x + c * room + usize(n), columns.x + (c + 1) * room, 0.0F);
        const std::pair<FloatColumns, double> applied = apply(complements[s], columns, scratch);
        const FloatColumns& result = applied.first;
        const Point factor = applied.second * unit;
        for (Index i = 0; i < n; ++i) {
            rows[3 * i] = factor[0] * result.x[i];
            rows[3 * i + 1] = factor[1] * result.y[i];
            rows[3 * i + 2] = factor[2] * result.z[i];
        }
    });
    shared_.exchange(residual_copies_.data(), 3);
    for_each(exec, copies_.n_vertices(), [&](Index v) {
        Point sum = Point::Zero();
        for (const Index copy : copies_.of_vertex[v])
            sum += weight(copy) * residual_copies_.row(copy);
        target.row(v) = sum;
    });
}

}  // namespace seamflow
