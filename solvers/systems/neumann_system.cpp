#include "solvers/systems/neumann_system.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "solvers/direct/columns.h"
#include "solvers/sparse/elimination_ordering.h"
#include "solvers/systems/checks.h"

namespace seamflow {

namespace {

/// The least pivot in single precision, relative to the matrix's diagonal: with a smaller pivot, fewer than four digits
/// may be left.
constexpr float least_pivot_of_single = 1e-3F;

}  // namespace

NeumannSystem::NeumannSystem(const SubMesh& sub_mesh, IndexLists faces, const ScaledLaplacian& laplacian,
                             const FlowTerms& terms, const Executor& exec)
    : n_interface_(sub_mesh.interface.size())
    , faces_(std::move(faces))
    , matrix_(make_symmetric_matrix(sub_mesh, laplacian,
                                    {faces_, sub_mesh.interface.halo_faces, sub_mesh.twin,
                                     sub_mesh.n_vertices + sub_mesh.n_halo, Contributions::OwnFaces},
                                    terms))
    , solver_(number_unknowns(sub_mesh), n_interface_, {}, n_interface_ == 0 ? exec : Executor(), matrix_.pivots())
{
    if (!matrix_.laplacian->uses_faces())
        faces_ = {};
}

/// Numbers the interior in the elimination ordering, then Γ.
/// @returns the pattern of the upper triangle.
SparsePattern NeumannSystem::number_unknowns(const SubMesh& sub_mesh)
{
    const std::vector<VertexPair> pairs = matrix_.laplacian->pairs();
    const std::vector<Index> unknown_of = matrix_.number_unknowns(pairs, sub_mesh.fixed);
    std::vector<bool> is_last(matrix_.vertex_of.size(), false);
    for (const Index v : sub_mesh.interface.vertices)
        is_last[unknown_of[v]] = true;
    const PairsOfUnknowns pairs_of = pairs_of_unknowns(pairs, unknown_of, matrix_.n());
    std::vector<Index> order(is_last.size());
    std::iota(order.begin(), order.end(), 0);
    order = elimination_ordering(upper_pattern(pairs_of, order).pattern, is_last);
    std::erase_if(order, [&](Index u) { return is_last[u]; });
    for (const Index v : sub_mesh.interface.vertices)
        order.push_back(unknown_of[v]);
    matrix_.reorder(order);
    if (matrix_.laplacian->n_auxiliary() > 0)
        std::ranges::copy_if(matrix_.vertex_of, std::back_inserter(unknown_vertices_),
                             [&](Index v) { return matrix_.is_vertex(v); });
    auto [pattern, slots] = upper_pattern(pairs_of, order);
    matrix_.column_offsets = pattern.column_offsets;
    std::replace(slots.begin(), slots.end(), Index{-1}, matrix_.n_entries());
    matrix_.slots = std::move(slots);
    return std::move(pattern);
}

NeumannSystem::Assembled NeumannSystem::assemble(const Points& positions, const Points& increments, double time_step,
                                                 SolverWorkspace& workspace, const Points* data) const
{
    Points& residual = workspace.residual;
    set_rows(residual, matrix_.n_vertices);
    const StiffnessProduct product{increments, residual, data != nullptr};
    const std::span<double> matrix = matrix_.fill(positions, time_step, 0, workspace, &product);
    const Screening& screening = matrix_.screening;
    for (const Index v : unknowns()) {
        const double mass = workspace.mass[v];
        if (data != nullptr) {
            // r = M D - dt K X - M X - dt M w X
            residual.row(v) =
                -residual.row(v) - mass * ((1.0 + time_step * screening.weight(v)) * increments.row(v) - data->row(v));
            continue;
        }
        // r = -dt K (Vᵏ + X) - M X - dt M w (Vᵏ + X - V⁰)
        residual.row(v) = -residual.row(v) - mass * increments.row(v);
        if (screening.exists())
            residual.row(v) -= mass * time_step * screening.weight(v) *
                               ((positions.row(v) - screening.initial.row(v)) + increments.row(v));
    }
    leave_out_fixed(matrix, increments, residual);
    return {matrix, residual, power_of_two_near(std::sqrt(time_step))};
}

void NeumannSystem::set_fixed(Index v, bool is_fixed)
{
    is_fixed_.resize(usize(matrix_.n_vertices), 0);
    n_fixed_ += (is_fixed ? 1 : 0) - is_fixed_[v];
    is_fixed_[v] = is_fixed ? 1 : 0;
}

void NeumannSystem::set_reference(const Points& initial)
{
    matrix_.laplacian->set_reference(initial);
    if (matrix_.screening.exists())
        matrix_.screening.initial = initial.topRows(matrix_.screening.initial.rows());
}

/// The rows and columns of fixed vertices become those of a diagonal matrix, with right-hand sides of 0. The residual
/// of their neighbours is that for the fixed positions.
void NeumannSystem::leave_out_fixed(std::span<double> matrix, const Points& increments, Points& residual) const
{
    if (n_fixed_ == 0)
        return;
    const std::vector<VertexPair> pairs = matrix_.laplacian->pairs();
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (matrix_.slots[i] < matrix_.n_entries() &&
            (is_fixed_[pairs[i].first] != 0 || is_fixed_[pairs[i].second] != 0))
            matrix[matrix_.slots[i]] = 0.0;
    for (Index u = 0; u < matrix_.n(); ++u)
        if (const Index v = matrix_.vertex_of[u]; is_fixed_[v] != 0)
            residual.row(v) = -matrix[matrix_.diagonal_slot(u)] * increments.row(v);
}

std::optional<NeumannSystem::Factor> NeumannSystem::factorise(const Assembled& equations, Precision precision,
                                                              FactorMemory& memory, LdlWorkspace& workspace) const
{
    require_finite_equations(equations.matrix);
    if (precision == Precision::Double)
        return Factor(require_factor(solver_.factorise<double>(equations.matrix, memory, workspace)), equations.unit);
    auto single = solver_.factorise<float>(equations.matrix, memory, workspace,
                                           precision == Precision::Automatic ? least_pivot_of_single : 0.0F);
    if (!single && precision == Precision::Automatic)
        return std::nullopt;
    return Factor(require_factor(std::move(single)), equations.unit);
}

void NeumannSystem::take_schur_complement(const Factor& factor, const LdlWorkspace& workspace,
                                          DenseFactor& complement) const
{
    std::visit(
        [&]<class Number>(const LdlFactor<Number>& numbers) {
            complement.take(solver_.last<Number>(workspace), numbers.scale());
        },
        factor.numbers_);
}

/// The remainder on Γ itself stays in double precision: sub-meshes' shares of it cancel each other almost completely.
void NeumannSystem::condense(const Assembled& equations, Factor& factor, Eigen::Ref<Points> on_interface) const
{
    std::visit(
        [&]<class Number>(LdlFactor<Number>& numbers) {
            const double scale = numbers.scale() * factor.unit_;
            const double inverse = 1.0 / scale;
            Number* const rows = numbers.rows();
            std::fill_n(rows, usize(ldl_row) * usize(matrix_.n()), Number{});
            for (Index u = 0; u < n_before_interface(); ++u) {
                const double* const residual = equations.residual.row(matrix_.vertex_of[u]).data();
                for (Index c = 0; c < 3; ++c)
                    rows[ldl_row * u + c] = static_cast<Number>(inverse * residual[c]);
            }
            numbers.forward_substitute();
            for (Index u = n_before_interface(); u < matrix_.n(); ++u)
                for (Index c = 0; c < 3; ++c)
                    on_interface(u - n_before_interface(), c) =
                        equations.residual(matrix_.vertex_of[u], c) + scale * rows[ldl_row * u + c];
        },
        factor.numbers_);
}

void NeumannSystem::back_substitute(Factor& factor, const Points& on_interface, Points& increments) const
{
    std::visit(
        [&]<class Number>(LdlFactor<Number>& numbers) {
            const double inverse = 1.0 / factor.unit_;
            Number* const rows = numbers.rows();
            for (Index i = 0; i < n_interface_; ++i)
                for (Index c = 0; c < 3; ++c)
                    rows[ldl_row * (n_before_interface() + i) + c] = static_cast<Number>(inverse * on_interface(i, c));
            numbers.back_substitute();
            bool is_finite = true;
            for (Index u = 0; u < n_before_interface(); ++u) {
                if (!matrix_.is_vertex(matrix_.vertex_of[u]))
                    continue;
                double* const row = increments.row(matrix_.vertex_of[u]).data();
                for (Index c = 0; c < 3; ++c) {
                    row[c] += factor.unit_ * rows[ldl_row * u + c];
                    is_finite &= std::isfinite(row[c]);
                }
            }
            require_finite_result(is_finite);
        },
        factor.numbers_);
}

}  // namespace seamflow
