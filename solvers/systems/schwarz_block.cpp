#include "solvers/systems/schwarz_block.h"

#include <algorithm>
#include <cmath>

#include "partition/errors.h"
#include "solvers/direct/columns.h"
#include "solvers/systems/messages.h"

namespace seamflow {

namespace {

template <class Value>
void keep_one_of_each(std::vector<Value>& values)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

template <class Value>
Index place_of(const std::vector<Value>& ascending, const Value& value)
{
    return static_cast<Index>(std::lower_bound(ascending.begin(), ascending.end(), value) - ascending.begin());
}

}  // namespace

SchwarzBlock::SchwarzBlock(const GrownPart& part, Laplacian laplacian, Factorisation factorisation)
    : part_(&part)
    , laplacian_(make_assembler(laplacian, faces_of(part.sub_mesh)))
    , unknown_of_(part.sub_mesh.n_vertices, -1)
    , right_hand_side_(static_cast<Eigen::Index>(part.unknowns.size()), 3)
{
    const auto n = static_cast<Index>(part.unknowns.size());
    for (Index u = 0; u < n; ++u)
        unknown_of_[part.unknowns[u]] = u;
    const std::vector<MatrixEntry> of_laplacian = laplacian_->entries();
    std::vector<MatrixEntry> entries;
    entries.reserve(of_laplacian.size());
    for (const auto& [column, row] : of_laplacian)
        if (unknown_of_[row] >= 0 && unknown_of_[column] >= 0)
            entries.push_back({unknown_of_[column], unknown_of_[row]});
    for (Index u = 0; u < n; ++u)
        entries.push_back({u, u});
    pattern_ = std::make_unique<SparsePattern>(make_pattern(n, entries));
    list_couplings(of_laplacian);
    make_slots(of_laplacian);
    if (n > 0)
        solver_ = make_general_solver(*pattern_, factorisation);
}

void SchwarzBlock::list_couplings(const std::vector<MatrixEntry>& entries)
{
    const auto& fixed = part_->sub_mesh.fixed;
    for (const auto& [column, row] : entries)
        if (unknown_of_[row] >= 0 && unknown_of_[column] < 0)
            (fixed[column] != 0 ? fixed_couplings_ : beyond_couplings_).push_back({unknown_of_[row], column});
    keep_one_of_each(fixed_couplings_);
    keep_one_of_each(beyond_couplings_);
    for (const Coupling& coupling : beyond_couplings_)
        beyond_.push_back(coupling.vertex);
    keep_one_of_each(beyond_);
}

void SchwarzBlock::make_slots(const std::vector<MatrixEntry>& entries)
{
    const Index first_beyond = pattern_->n_entries();
    const Index first_fixed = first_beyond + static_cast<Index>(beyond_couplings_.size());
    const Index unread = first_fixed + static_cast<Index>(fixed_couplings_.size());
    slots_.reserve(entries.size());
    for (const auto& [column, row] : entries) {
        const Index unknown = unknown_of_[row];
        if (unknown < 0)
            slots_.push_back(unread);
        else if (unknown_of_[column] >= 0)
            slots_.push_back(pattern_->slot({unknown_of_[column], unknown}));
        else if (part_->sub_mesh.fixed[column] != 0)
            slots_.push_back(first_fixed + place_of(fixed_couplings_, Coupling{unknown, column}));
        else
            slots_.push_back(first_beyond + place_of(beyond_couplings_, Coupling{unknown, column}));
    }
    for (Index u = 0; u < pattern_->n(); ++u)
        diagonal_slots_.push_back(pattern_->slot({u, u}));
    for (Coupling& coupling : beyond_couplings_)
        coupling.vertex = place_of(beyond_, coupling.vertex);
    values_.resize(at(unread) + 1);
}

void SchwarzBlock::assemble(const Points& positions, double time_step)
{
    std::fill(values_.begin(), values_.end(), 0.0);
    laplacian_->add(positions, time_step, slots_, values_);
    for (Index u = 0; u < pattern_->n(); ++u) {
        values_[diagonal_slots_[u]] += 1.0;
        right_hand_side_.row(u) = positions.row(part_->unknowns[u]);
    }
    const double* value = values_.data() + pattern_->rows.size() + beyond_couplings_.size();
    for (const auto& [unknown, vertex] : fixed_couplings_)
        right_hand_side_.row(unknown) -= *value++ * positions.row(vertex);
}

void SchwarzBlock::factorise(SolverWorkspace& workspace)
{
    if (!std::all_of(values_.begin(), values_.end() - 1, [](double value) { return std::isfinite(value); }))
        throw ComputationError(equations_not_finite);
    if (!solver_)
        return;
    if (!solver_->factorise(std::span<const double>(values_).first(pattern_->rows.size()), workspace))
        throw ComputationError(system_singular);
    n_nearly_singular_ += solver_->is_nearly_singular() ? 1 : 0;
}

void SchwarzBlock::solve(const Points& given, RightHandSide right_hand_side, Columns& solution,
                         SolverWorkspace& workspace)
{
    set_rows(solution, right_hand_side_.rows());
    if (!solver_)
        return;
    Columns& right = workspace.right_hand_side;
    set_rows(right, right_hand_side_.rows());
    if (right_hand_side == RightHandSide::Step)
        right = right_hand_side_;
    else
        right.setZero();
    const double* value = values_.data() + pattern_->rows.size();
    for (const auto& [unknown, place] : beyond_couplings_)
        right.row(unknown) -= *value++ * given.row(place);
    solver_->solve(right, solution, workspace);
    if (!solution.allFinite())
        throw ComputationError(result_not_finite);
}

}  // namespace seamflow
