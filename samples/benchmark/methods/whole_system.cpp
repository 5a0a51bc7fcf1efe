#include "samples/benchmark/methods/whole_system.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "partition/errors.h"

namespace seamflow {

namespace {

FacesOnBothSides faces_of(const PolygonMesh& mesh, const Topology& topology)
{
    return {{mesh.face_offsets, mesh.face_vertices}, {}, topology.twin, mesh.n_vertices()};
}

/// The same as make_pattern, but sorted line by line: faster for a whole mesh.
/// @param entries may repeat; those with a negative index are ignored.
SparsePattern make_large_pattern(Index n, const std::vector<MatrixEntry>& entries)
{
    std::vector<std::size_t> begin(usize(n) + 1, 0);
    for (const MatrixEntry& entry : entries)
        if (entry.column >= 0)
            ++begin[entry.column + 1];
    for (std::size_t c = 0; c < usize(n); ++c)
        begin[c + 1] += begin[c];
    std::vector<Index> rows(begin.back());
    std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
    for (const MatrixEntry& entry : entries)
        if (entry.column >= 0)
            rows[end[entry.column]++] = entry.row;
    SparsePattern pattern;
    pattern.column_offsets.reserve(usize(n) + 1);
    std::size_t kept = 0;
    for (std::size_t c = 0; c < usize(n); ++c) {
        const auto first = rows.begin() + static_cast<std::ptrdiff_t>(begin[c]);
        const auto last = rows.begin() + static_cast<std::ptrdiff_t>(end[c]);
        std::sort(first, last);
        const auto unique_end = std::unique(first, last);
        std::move(first, unique_end, rows.begin() + static_cast<std::ptrdiff_t>(kept));
        kept += static_cast<std::size_t>(unique_end - first);
        if (kept > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
            throw ComputationError("a system of " + std::to_string(n) + " unknowns has too many entries");
        pattern.column_offsets.push_back(static_cast<Index>(kept));
    }
    rows.resize(kept);
    pattern.rows = std::move(rows);
    return pattern;
}

}  // namespace

WholeSystem::WholeSystem(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian)
    : topology_(&topology)
    , assembler_(make_assembler(laplacian, faces_of(mesh, topology)))
{
    assert(laplacian != Laplacian::PtackovaVelho);
    std::vector<Index> unknown_of(mesh.n_vertices(), -1);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (topology.moves(v)) {
            unknown_of[v] = static_cast<Index>(vertices_.size());
            vertices_.push_back(v);
        }
    make_slots(assembler_->entries(), unknown_of);
    right_hand_side_.resize(n(), 3);
}

void WholeSystem::make_slots(const std::vector<MatrixEntry>& entries, const std::vector<Index>& unknown_of)
{
    constexpr MatrixEntry none{-1, -1};
    const auto moves = [&](Index v) { return topology_->moves(v); };
    const auto placed = [&](const MatrixEntry& entry) -> MatrixEntry {
        if (!moves(entry.row) || unknown_of[entry.column] < 0)
            return none;
        return {unknown_of[entry.column], unknown_of[entry.row]};
    };
    std::vector<MatrixEntry> wanted;
    wanted.reserve(entries.size() + vertices_.size());
    std::transform(entries.begin(), entries.end(), std::back_inserter(wanted), placed);
    for (Index u = 0; u < static_cast<Index>(vertices_.size()); ++u)
        wanted.push_back({u, u});
    pattern_ = make_large_pattern(static_cast<Index>(vertices_.size()), wanted);

    slots_.reserve(entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (wanted[i].column >= 0) {
            slots_.push_back(pattern_.slot(wanted[i]));
        } else if (moves(entries[i].row)) {
            slots_.push_back(pattern_.n_entries() + static_cast<Index>(couplings_.size()));
            couplings_.push_back({unknown_of[entries[i].row], entries[i].column});
        } else {
            slots_.push_back(-1);
        }
    }
    const Index unread = pattern_.n_entries() + static_cast<Index>(couplings_.size());
    std::replace(slots_.begin(), slots_.end(), Index{-1}, unread);
    for (Index u = 0; u < n(); ++u)
        diagonal_slots_.push_back(pattern_.slot({u, u}));
    values_.resize(usize(unread) + 1);
}

void WholeSystem::assemble(const Points& positions, double time_step)
{
    std::fill(values_.begin(), values_.end(), 0.0);
    assembler_->add(positions, time_step, slots_, values_);
    for (const Index slot : diagonal_slots_)
        values_[slot] += 1.0;
    right_hand_side_ = unknowns_at(positions);
    make_symmetric(positions);
    if (!std::all_of(values_.begin(), values_.end() - 1, [](double value) { return std::isfinite(value); }))
        throw ComputationError("the equations are not finite: use a smaller time step or fewer steps");
}

void WholeSystem::make_symmetric(const Points& positions)
{
    row_factor_.resize(vertices_.size());
    std::transform(vertices_.begin(), vertices_.end(), row_factor_.begin(),
                   [&](Index v) { return assembler_->mass(v); });
    for (std::size_t i = 0; i < pattern_.rows.size(); ++i)
        values_[i] *= row_factor_[pattern_.rows[i]];
    for (Index u = 0; u < n(); ++u)
        right_hand_side_.row(u) *= row_factor_[u];
    for (std::size_t i = 0; i < couplings_.size(); ++i) {
        const auto& [row, fixed_vertex] = couplings_[i];
        const double value = values_[pattern_.n_entries() + i] * row_factor_[row];
        right_hand_side_.row(row) -= value * positions.row(fixed_vertex);
    }
}

std::span<const double> WholeSystem::values() const
{
    return std::span<const double>(values_).first(pattern_.n_entries());
}

Columns WholeSystem::unknowns_at(const Points& positions) const
{
    Columns unknowns(n(), 3);
    for (Index u = 0; u < n(); ++u)
        unknowns.row(u) = positions.row(vertices_[u]);
    return unknowns;
}

void WholeSystem::move(const Columns& solution, Points& positions) const
{
    if (!solution.allFinite())
        throw ComputationError("the result is not finite: use a smaller time step");
    for (Index u = 0; u < n(); ++u)
        positions.row(vertices_[u]) = solution.row(u);
}

}  // namespace seamflow
