#include "solvers/systems/schwarz_block.h"

#include <algorithm>
#include <utility>

#include "partition/index_lists.h"
#include "solvers/systems/checks.h"

namespace seamflow {

namespace {

template <class Value>
void keep_one_of_each(std::vector<Value>& values)
{
    sort_unique(values);
}

}  // namespace

SchwarzBlock::SchwarzBlock(const GrownPart& part, Laplacian laplacian, Factorisation factorisation,
                           std::span<const double> strengths)
    : part_(&part)
    , right_hand_side_(static_cast<Eigen::Index>(part.unknowns.size()), 3)
{
    const auto n = static_cast<Index>(part.unknowns.size());
    std::vector<Index> unknown_of(part.sub_mesh.n_vertices, -1);
    for (Index u = 0; u < n; ++u)
        unknown_of[part.unknowns[u]] = u;
    auto assembler = make_assembler(laplacian, faces_of(part.sub_mesh));
    const std::vector<MatrixEntry> of_laplacian = assembler->entries();
    std::vector<MatrixEntry> entries;
    entries.reserve(of_laplacian.size());
    for (const auto& [column, row] : of_laplacian)
        if (unknown_of[row] >= 0 && unknown_of[column] >= 0)
            entries.push_back({unknown_of[column], unknown_of[row]});
    for (Index u = 0; u < n; ++u)
        entries.push_back({u, u});
    SparsePattern pattern = make_pattern(n, entries);
    list_couplings(of_laplacian, unknown_of);
    std::vector<Index> slots = make_slots(of_laplacian, unknown_of, pattern);
    matrix_.emplace(std::move(assembler), std::move(pattern), std::move(slots),
                    beyond_couplings_.size() + fixed_couplings_.size(), factorisation);
    if (strengths.empty())
        return;
    for (const Index v : part.unknowns)
        strengths_.push_back(strengths[at(part.sub_mesh.local_to_global[v])]);
    for (const auto* couplings : {&beyond_couplings_, &fixed_couplings_})
        for (const Coupling& coupling : *couplings)
            further_.push_back(coupling.unknown);
}

void SchwarzBlock::list_couplings(const std::vector<MatrixEntry>& entries, const std::vector<Index>& unknown_of)
{
    const auto& fixed = part_->sub_mesh.fixed;
    for (const auto& [column, row] : entries)
        if (unknown_of[row] >= 0 && unknown_of[column] < 0)
            (fixed[column] != 0 ? fixed_couplings_ : beyond_couplings_).push_back({unknown_of[row], column});
    keep_one_of_each(fixed_couplings_);
    keep_one_of_each(beyond_couplings_);
    for (const Coupling& coupling : beyond_couplings_)
        beyond_.push_back(coupling.vertex);
    keep_one_of_each(beyond_);
}

std::vector<Index> SchwarzBlock::make_slots(const std::vector<MatrixEntry>& entries,
                                            const std::vector<Index>& unknown_of, const SparsePattern& pattern)
{
    const Index first_beyond = pattern.n_entries();
    const Index first_fixed = first_beyond + static_cast<Index>(beyond_couplings_.size());
    const Index unread = first_fixed + static_cast<Index>(fixed_couplings_.size());
    std::vector<Index> slots;
    slots.reserve(entries.size());
    for (const auto& [column, row] : entries) {
        const Index unknown = unknown_of[row];
        if (unknown < 0)
            slots.push_back(unread);
        else if (unknown_of[column] >= 0)
            slots.push_back(pattern.slot({unknown_of[column], unknown}));
        else if (part_->sub_mesh.fixed[column] != 0)
            slots.push_back(first_fixed + place_in(fixed_couplings_, Coupling{unknown, column}));
        else
            slots.push_back(first_beyond + place_in(beyond_couplings_, Coupling{unknown, column}));
    }
    for (Coupling& coupling : beyond_couplings_)
        coupling.vertex = place_in(beyond_, coupling.vertex);
    return slots;
}

SchwarzBlock::Assembled SchwarzBlock::assemble(const Points& positions, double time_step)
{
    // (I + dt Δ) Vᵏ⁺¹ = Vᵏ
    const Assembled equations{matrix_->fill(positions, time_step)};
    if (!strengths_.empty())
        matrix_->scale_rows(strengths_, further_);
    for (Index u = 0; u < matrix_->n(); ++u) {
        matrix_->diagonal(u) += 1.0;
        right_hand_side_.row(u) = positions.row(part_->unknowns[u]);
    }
    const double* value = matrix_->further() + beyond_couplings_.size();
    for (const auto& [unknown, vertex] : fixed_couplings_)
        right_hand_side_.row(unknown) -= *value++ * positions.row(vertex);
    return equations;
}

void SchwarzBlock::solve(const Factor& factor, const Points& given, RightHandSide right_hand_side, Columns& solution,
                         SolverWorkspace& workspace) const
{
    set_rows(solution, right_hand_side_.rows());
    if (!factor)
        return;
    Columns& right = workspace.right_hand_side;
    set_rows(right, right_hand_side_.rows());
    if (right_hand_side == RightHandSide::Step)
        right = right_hand_side_;
    else
        right.setZero();
    const double* value = matrix_->further();
    for (const auto& [unknown, place] : beyond_couplings_)
        right.row(unknown) -= *value++ * given.row(place);
    factor->solve(right, solution, workspace);
    require_finite_result(solution.allFinite());
}

}  // namespace seamflow
