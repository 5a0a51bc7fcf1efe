#include "solvers/systems/whole_mesh_system.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "partition/errors.h"
#include "solvers/laplacian/vertex_row.h"

namespace seamflow {

namespace {

/// The data on which the rows of K depend.
struct RowGeometry {
    const PolygonMesh& mesh;
    const Topology& topology;
    /// The positions, by vertices, and the same by rows: in the order of the rows of the matrix.
    const Points& positions;
    const Points& of_rows;
    const WholeMeshRows& rows;
    BlockRowMatrix& matrix;
    /// The K and M to use; null: those of the Laplacian.
    const GivenStiffness* given;
};

/// Calls entry(find, j, K_ij) for the entries of row i; find() returns the entry of the matrix. An entry may be visited
/// in several terms that add up. The rows of K sum to zero.
/// @returns M_i.
template <class Kernel, class Entry>
double visit_matrix_row(Kernel kernel, const RowGeometry& g, const BlockRowMatrix::BlockRow& row, Entry&& entry)
{
    const Index v = g.rows.vertices.values[row.row];
    if constexpr (EdgeKernel<Kernel>)
        // At an interior vertex, the entries of the matrix are the edges, each of two faces.
        if (g.topology.kind[v] == VertexKind::Interior) {
            const Point here = g.of_rows.row(row.row);
            double mass = 0.0;
            int n_edges = 0;
            g.matrix.for_each_entry(row, [&](Index j, const BlockRowMatrix::Entry& of_edge) {
                const auto edge = kernel.edge(here - g.of_rows.row(j));
                entry([&] { return of_edge; }, j, -edge.weight(1.0));
                mass += edge.mass();
                ++n_edges;
            });
            return Kernel::averages_mass ? mass / n_edges : mass;
        }
    return visit_row(kernel, g.mesh, g.topology, g.positions, v, [&](Index w, double k) {
        const Index j = g.rows.row_of[w];
        entry([&] { return g.matrix.entry(row, j); }, j, k);
    });
}

/// Calls action(visit), where visit(row, entry) is visit_matrix_row of the Laplacian.
template <class Action>
void with_rows(const ScaledLaplacian& laplacian, const RowGeometry& geometry, Action&& action)
{
    if (geometry.given != nullptr)
        return action([&](const BlockRowMatrix::BlockRow& row, auto&& entry) {
            const GivenStiffness& given = *geometry.given;
            const Index v = geometry.rows.vertices.values[row.row];
            for (Index i = given.neighbours.offsets[v]; i < given.neighbours.offsets[v + 1]; ++i) {
                const Index j = geometry.rows.row_of[given.neighbours.values[i]];
                entry([&] { return geometry.matrix.entry(row, j); }, j, -given.weights[i]);
            }
            return given.mass[v];
        });
    with_kernel(laplacian, [&]<class Kernel>(Kernel kernel) {
        if constexpr (EdgeKernel<Kernel> || FaceKernel<Kernel>)
            action([&](const BlockRowMatrix::BlockRow& row, auto&& entry) {
                return visit_matrix_row(kernel, geometry, row, entry);
            });
        else
            throw OptionError("the Laplacian is not symmetric");
    });
}

// A step is solved in passes: iterations in single precision from a residual on. After a pass the residual of the
// solution so far is recomputed in double precision, and the next pass begins from it.

/// The least fraction of a residual that a pass can leave, because of its single precision; and the most that a pass
/// leaves that makes enough progress.
constexpr double least_left_by_pass = 1e-4;
constexpr double most_left_by_pass = 0.5;
/// The distance of the vertex that is farthest from the solution is underestimated by mean rates of convergence, by
/// this factor: there, iterations converge more slowly.
constexpr double slower_somewhere = 2.5;
/// A pass that leaves more than this fraction of the residual is too short to show at which rate updates decrease.
constexpr double most_left_for_rate = 0.1;

Eigen::Array4f to_row(const Point& point)
{
    return {static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]), 0.0F};
}

}  // namespace

WholeMeshSystem::WholeMeshSystem(const PolygonMesh& mesh, const Topology& topology, const ScaledLaplacian& laplacian,
                                 const FlowTerms& terms, const Executor& exec, bool is_applied_again)
    : mesh_(&mesh)
    , topology_(&topology)
    , laplacian_(laplacian)
    , rows_(make_whole_mesh_rows(mesh, topology, exec))
    , matrix_(make_matrix(mesh, topology, rows_, traits_of(laplacian).reach, exec))
    , moves_(rows_.vertices.values.size())
    , screening_(make_screening(terms, rows_.vertices.values))
    , masses_(is_applied_again ? moves_.size() : 0)
    , keeps_matrix_(terms.keeps_mass)
{
    for_each(exec, matrix_.n_rows(), [&](Index i) { moves_[i] = topology.moves(rows_.vertices.values[i]) ? 1 : 0; });
    if (keeps_matrix_) {
        kept_ = *terms.initial;
        kept_of_rows_.resize(matrix_.n_rows(), 3);
        list_by_rows(kept_, kept_of_rows_, exec);
    }
}

/// Assembles the matrix with its entries in single precision, if it keeps exact entries also these, and the residual at
/// Vᵏ⁺¹ = Vᵏ.
/// @param of_rows V, by rows.
WholeMeshSystem::Sizes WholeMeshSystem::assemble(const Points& of_rows, const Executor& exec)
{
    const RowGeometry geometry{*mesh_, *topology_, *before_, of_rows, rows_, matrix_, given_};
    using Sums = Eigen::Array<double, 8, 1>;
    Sums sums;
    const bool keeps_exact = matrix_.keeps_exact();
    with_rows(laplacian_, geometry, [&](auto&& visit) {
        sums = matrix_.sum_of_rows<Sums>(exec, [&](const BlockRowMatrix::BlockRow& row) -> Sums {
            const Index i = row.row;
            if (moves_[i] == 0)
                return Sums::Zero();
            matrix_.for_each_entry(row, [](Index, const BlockRowMatrix::Entry& entry) {
                entry.value = 0.0F;
                if (entry.exact != nullptr)
                    *entry.exact = 0.0;
            });
            const Point here = of_rows.row(i);
            double diagonal = 0.0;
            // The sums of the sizes of all terms of the residual, which bound its rounding error.
            Eigen::Array4d size = Eigen::Array4d::Zero();
            Point residual = Point::Zero();
            const double whole_mass = visit(row, [&](auto&& find, Index j, double k) {
                const double entry = units_.stiffness * k;
                const Point share = entry * (of_rows.row(j) - here);
                if (moves_[j] != 0 || keeps_exact) {
                    const BlockRowMatrix::Entry found = find();
                    // Vertices that do not move have no equation.
                    if (moves_[j] != 0)
                        found.value += static_cast<float>(entry);
                    if (keeps_exact)
                        *found.exact += entry;
                }
                diagonal -= entry;
                residual -= share;
                size.head<3>() += share.array().abs().transpose();
            });
            const double mass = whole_mass / screening_.strength(i);
            if (!masses_.empty())
                masses_[i] = units_.mass * mass;
            diagonal += units_.mass * mass * (1.0 + screening(i));
            if (screening(i) > 0.0) {
                const Point pull = units_.mass * mass * screening(i) * (screening_.initial.row(i) - here);
                residual += pull;
                size.head<3>() += pull.array().abs().transpose();
            }
            matrix_.set_diagonal(i, static_cast<float>(diagonal));
            const Eigen::Array4f scaled_residual = to_row(units_.length * residual);
            matrix_.set_residual(i, scaled_residual);
            Sums result;
            const double inverse = 1.0 / diagonal;
            result << size.square() * inverse, scaled_residual.cast<double>().square() * inverse;
            return result;
        });
    });
    const double unit = 4.0 * std::numeric_limits<double>::epsilon() * units_.length;
    return {.rounding = unit * unit * sums.head<4>(), .residual = sums.tail<4>()};
}

/// residual = -dt K V' - M (V' - D), plus dt M w (V⁰ - V') with an attachment, V' being the current solution, with the
/// weights at V.
/// @param of_rows V, by rows.
/// @param data D, by rows: V, or other data that the step is applied to.
/// @param is_pulled whether the attachment pulls to V⁰; otherwise it pulls to 0.
/// @returns the sum of the squared residuals, each divided by the diagonal entry.
double WholeMeshSystem::measure(const Points& of_rows, const Points& data, bool is_pulled, const Executor& exec)
{
    if (!matrix_.keeps_exact()) {
        keep_exact();
        assemble(of_rows, exec);
    }
    using Sum = Eigen::Array<double, 1, 1>;
    return matrix_
        .sum_of_rows<Sum>(exec,
                          [&](const BlockRowMatrix::BlockRow& row) -> Sum {
                              const Index i = row.row;
                              if (moves_[i] == 0)
                                  return Sum::Zero();
                              const Point there = after_.row(i);
                              Point residual = -masses_[i] * (there - data.row(i));
                              matrix_.for_each_entry(row, [&](Index j, const BlockRowMatrix::Entry& entry) {
                                  residual -= *entry.exact * (after_.row(j) - there);
                              });
                              if (screening(i) > 0.0)
                                  residual += masses_[i] * screening(i) *
                                              ((is_pulled ? Point(screening_.initial.row(i)) : Point::Zero()) - there);
                              residual *= units_.length;
                              matrix_.set_residual(i, to_row(residual));
                              return Sum::Constant(residual.squaredNorm() / matrix_.diagonal(i));
                          })
        .value();
}

/// Lets the matrix also keep its entries in double precision, with which residuals are recomputed, from the next call
/// of `assemble` on.
void WholeMeshSystem::keep_exact()
{
    matrix_.keep_exact();
    masses_.resize(moves_.size());
}

/// Begins a pass from the residual that the matrix has.
/// @param squared the sum of the squared residuals, each divided by the diagonal entry.
WholeMeshSystem::PassStart WholeMeshSystem::start_pass(double squared, const Executor& exec)
{
    PassStart start;
    // With this scale, the residual is about 1 at each vertex.
    start.scale = std::exp2(-std::ilogb(std::sqrt(squared / matrix_.n_rows())));
    start.squared = matrix_.start(static_cast<float>(start.scale), exec);
    start.norm = std::sqrt(start.squared.sum()) / start.scale;
    return start;
}

/// The largest distance of a vertex between V and the current solution, in units of length.
double WholeMeshSystem::farthest_move(const Executor& exec) const
{
    const auto keep_larger = [](double& largest, double other) { largest = std::max(largest, other); };
    return std::sqrt(reduce(
        exec, matrix_.n_rows(), 0.0,
        [&](double& largest, Index i) {
            keep_larger(largest, (after_.row(i) - before_->row(rows_.vertices.values[i])).squaredNorm());
        },
        keep_larger));
}

/// The estimated largest distance of a vertex to its position in the exact step, in units of length, after a pass: the
/// sum of the updates that are still to come, if they decrease at the mean rate of this pass (a geometric series),
/// times the ratio of the recomputed residual to that at which the pass arrived. After a pass too short to show a rate:
/// the previous estimate, if there is one, scaled like the residual.
/// @param length the unit of pass.last_update. @param before_pass, left the residuals before and after the pass, as
///        fractions of the first residual. @param distance_before the estimate after the previous pass; 0: none.
double WholeMeshSystem::estimate_distance_after(const BlockRowMatrix::Result& pass, double length, double before_pass,
                                                double left, double distance_before)
{
    if (pass.residual > most_left_for_rate && distance_before > 0.0)
        return distance_before * left / before_pass;
    const double rate = std::pow(pass.residual, 1.0 / pass.iterations);
    const double distance = slower_somewhere * (rate < 1.0 ? pass.last_update * rate / (1.0 - rate) : pass.last_update);
    return length * distance * left / (before_pass * pass.residual);
}

/// Writes the rows of vertices that have no equation.
/// @param before #V by 3: the values that these vertices keep; null: they get 0.
void WholeMeshSystem::write_without_row(const Points* before, Points& after, const Executor& exec) const
{
    for_each(exec, static_cast<Index>(rows_.without_row.size()), [&](Index i) {
        const Index v = rows_.without_row[i];
        after.row(v) = before != nullptr ? Point(before->row(v)) : Point::Zero();
    });
}

/// Sets the time step and its units. A kept matrix of another time step does not count any more.
void WholeMeshSystem::take_units(double time_step)
{
    has_matrix_ &= time_step == time_step_;
    time_step_ = time_step;
    const double root = std::sqrt(time_step);
    const double mass_unit = traits_of(laplacian_).mass_is_length ? root : time_step;
    units_ = {.stiffness = time_step / mass_unit, .mass = 1.0 / mass_unit, .length = 1.0 / root};
}

/// Takes a step in a flow that keeps the matrix of V⁰. Iterations begin with Vᵏ; guesses are not used.
WholeMeshSystem::Result WholeMeshSystem::step_with_kept_matrix(const Points& before, const IterationStop& stop,
                                                               Points& after, const Executor& exec)
{
    before_ = &kept_;
    if (!has_matrix_) {
        keep_exact();
        assemble(kept_of_rows_, exec);
        matrix_.factorise(exec);
        has_matrix_ = true;
    }
    data_.resize(matrix_.n_rows(), 3);
    list_by_rows(before, data_, exec);
    after_ = data_;
    const double squared = measure(kept_of_rows_, data_, true, exec);
    if (squared == 0.0) {
        copy(exec, before, after);
        return {};
    }
    return solve({.squared = squared, .of_rows = kept_of_rows_, .data = data_, .before = &before, .is_in_rows = true},
                 stop, after, exec);
}

WholeMeshSystem::Result WholeMeshSystem::step(const Points& before, double time_step, const IterationStop& stop,
                                              Points& after, const Executor& exec, const Points* guess)
{
    take_units(time_step);
    if (keeps_matrix_)
        return step_with_kept_matrix(before, stop, after, exec);
    before_ = &before;
    // Until the result is written, the memory of `after` has Vᵏ by rows.
    const Points& before_by_rows = after;
    list_by_rows(before, after, exec);
    // These steps recompute residuals: that of the guess, or one that the first pass cannot reduce to the tolerance.
    if (guess != nullptr || stop.tolerance <= least_left_by_pass)
        keep_exact();
    const Sizes sizes = assemble(before_by_rows, exec);
    // The residual is rounding error alone: the surface is as smooth as it can be.
    if ((sizes.residual <= sizes.rounding).all()) {
        copy(exec, before, after);
        return {};
    }
    matrix_.factorise(exec);
    return solve({.squared = sizes.residual.sum(),
                  .of_rows = before_by_rows,
                  .data = before_by_rows,
                  .before = &before,
                  .is_in_rows = false,
                  .guess = guess},
                 stop, after, exec);
}

/// Lists numbers of vertices by rows.
/// @param by_rows at least #rows by 3. A result is written only later, so that its memory can be used for V until then.
void WholeMeshSystem::list_by_rows(const Points& by_vertices, Points& by_rows, const Executor& exec) const
{
    for_each(exec, matrix_.n_rows(), [&](Index i) { by_rows.row(i) = by_vertices.row(rows_.vertices.values[i]); });
}

WholeMeshSystem::Result WholeMeshSystem::apply(const Points& data, const IterationStop& stop, Points& result,
                                               const Executor& exec)
{
    using Sum = Eigen::Array<double, 1, 1>;
    data_.resize(matrix_.n_rows(), 3);
    const Sum squared = matrix_.sum_of_rows<Sum>(exec, [&](const BlockRowMatrix::BlockRow& row) -> Sum {
        const Index i = row.row;
        data_.row(i) = data.row(rows_.vertices.values[i]);
        if (moves_[i] == 0)
            return Sum::Zero();
        const Point residual = units_.length * masses_[i] * data_.row(i);
        matrix_.set_residual(i, to_row(residual));
        return Sum::Constant(residual.squaredNorm() / matrix_.diagonal(i));
    });
    if (!(squared.value() > 0.0)) {
        for_each(exec, static_cast<Index>(result.rows()), [&](Index v) { result.row(v).setZero(); });
        return {};
    }
    list_by_rows(*before_, result, exec);
    after_.resize(matrix_.n_rows(), 3);
    for_each(exec, matrix_.n_rows(), [&](Index i) {
        if (moves_[i] == 0)
            after_.row(i) = data_.row(i);
        else
            after_.row(i).setZero();
    });
    // Until the result is written, its memory has Vᵏ by rows.
    const Points& before_by_rows = result;
    return solve(
        {.squared = squared.value(), .of_rows = before_by_rows, .data = data_, .before = nullptr, .is_in_rows = true},
        stop, result, exec);
}

/// Solves for the result of the step on V, or on other data, by passes.
/// @param after in: V, by rows, unless the matrix is kept. Out: the result, by vertices.
WholeMeshSystem::Result WholeMeshSystem::solve(const Beginning& beginning, const IterationStop& stop, Points& after,
                                               const Executor& exec)
{
    const double root = std::sqrt(time_step_);
    PassStart start = start_pass(beginning.squared, exec);
    const double first = start.norm;
    // The fraction of the first residual that is left.
    double left = 1.0;
    double distance = 0.0;
    bool is_in_rows = beginning.is_in_rows;
    bool is_written = false;
    // Recomputes the residual of the solution in after_, and begins a pass from it.
    const auto renew = [&] {
        const double renewed = measure(beginning.of_rows, beginning.data, beginning.before != nullptr, exec);
        if (renewed > 0.0)
            start = start_pass(renewed, exec);
        // `left` is not a number if the residual is none.
        left = renewed > 0.0 ? start.norm / first : renewed;
    };
    if (beginning.guess != nullptr) {
        after_.resize(matrix_.n_rows(), 3);
        list_by_rows(*beginning.guess, after_, exec);
        renew();
        is_in_rows = left < 1.0;
        if (is_in_rows) {
            distance = slower_somewhere * left * farthest_move(exec);
        } else {
            after_ = after;
            renew();
        }
    }
    StoppingCriterion criterion(stop, most_left_by_pass, left);
    const auto current = [&](Index i) {
        return is_in_rows ? Point(after_.row(i)) : Point(before_->row(rows_.vertices.values[i]));
    };
    while (!criterion.is_met()) {
        const BlockRowMatrix::Result pass = matrix_.iterate(
            start.squared, std::max(stop.tolerance / left, least_left_by_pass), criterion.iterations_left(), exec);
        const double length = root / start.scale;
        const double before_pass = std::exchange(left, left * pass.residual);
        // The residual after the first pass is known well enough without recomputing it; the residual after a later
        // pass is near the rounding error.
        const bool is_first = before_pass == 1.0;
        const bool is_last = is_first && left <= stop.tolerance && pass.residual > least_left_by_pass;
        const auto moved = [&](Index i) -> Point {
            return current(i) + length * matrix_.increment(i).head<3>().cast<double>().matrix().transpose();
        };
        if (is_last) {
            for_each(exec, matrix_.n_rows(), [&](Index i) { after.row(rows_.vertices.values[i]) = moved(i); });
            is_written = true;
        } else {
            after_.resize(matrix_.n_rows(), 3);
            for_each(exec, matrix_.n_rows(), [&](Index i) { after_.row(i) = moved(i); });
            is_in_rows = true;
            renew();
        }
        distance = estimate_distance_after(pass, length, before_pass, left, distance);
        criterion.note(pass.iterations, left, left / before_pass);
    }
    if (!is_written)
        for_each(exec, matrix_.n_rows(), [&](Index i) { after.row(rows_.vertices.values[i]) = current(i); });
    write_without_row(beginning.before, after, exec);
    return {criterion.result(left), distance};
}

}  // namespace seamflow
