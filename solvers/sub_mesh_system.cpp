#include "solvers/sub_mesh_system.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "partition/errors.h"
#include "solvers/interface/adapted_robin.h"

namespace seamflow {

namespace {

FaceView faces_of(const SubMesh& sub_mesh)
{
    return {sub_mesh.face_vertices.offsets, sub_mesh.face_vertices.values, sub_mesh.twin, sub_mesh.n_vertices};
}

}  // namespace

SubMeshSystem::SubMeshSystem(const SubMesh& sub_mesh, Laplacian laplacian)
    : sub_mesh_(&sub_mesh)
    , stencils_(make_derivative_stencils(sub_mesh))
    , laplacian_(make_assembler(laplacian, faces_of(sub_mesh)))
    , right_hand_side_(sub_mesh.n_vertices, 3)
    , solution_(sub_mesh.n_vertices, 3)
{
    make_rows();
    const auto is_laplacian = [&](const MatrixEntry& entry) { return row_of_[at(entry.row)] == Row::Laplacian; };
    const std::vector<MatrixEntry> laplacian_entries = laplacian_->entries();

    std::vector<MatrixEntry> entries;
    entries.reserve(laplacian_entries.size());
    std::copy_if(laplacian_entries.begin(), laplacian_entries.end(), std::back_inserter(entries), is_laplacian);
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        entries.push_back({v, v});
    for (Index i = 0; i < stencils_.columns.size(); ++i)
        for (const Index column : stencils_.columns[i])
            entries.push_back({column, sub_mesh.interface.vertices[at(i)]});
    pattern_ = std::make_unique<SparsePattern>(make_pattern(sub_mesh.n_vertices, std::move(entries)));

    const Index unread = pattern_->n_entries();
    laplacian_slots_.reserve(laplacian_entries.size());
    for (const MatrixEntry& entry : laplacian_entries)
        laplacian_slots_.push_back(is_laplacian(entry) ? pattern_->slot(entry) : unread);
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        diagonal_slots_.push_back(pattern_->slot({v, v}));
    for (Index i = 0; i < stencils_.columns.size(); ++i)
        for (const Index column : stencils_.columns[i])
            interface_slots_.push_back(pattern_->slot({column, sub_mesh.interface.vertices[at(i)]}));
    values_.resize(at(unread) + 1);
    solver_ = std::make_unique<UmfpackSolver>(*pattern_);
}

void SubMeshSystem::make_rows()
{
    row_of_.assign(at(sub_mesh_->n_vertices), Row::Laplacian);
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        if (sub_mesh_->fixed[at(v)] != 0)
            row_of_[at(v)] = Row::Fixed;
    for (const Index v : sub_mesh_->interface.vertices)
        row_of_[at(v)] = Row::Interface;
}

void SubMeshSystem::assemble(const Points& positions, double time_step, double p, std::span<const InterfaceRole> roles)
{
    roles_.assign(roles.begin(), roles.end());
    std::fill(values_.begin(), values_.end(), 0.0);
    laplacian_->add(positions, time_step, laplacian_slots_, values_);
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v) {
        if (row_of_[at(v)] != Row::Interface)
            values_[at(diagonal_slots_[at(v)])] += 1.0;
        right_hand_side_.row(v) = positions.row(v);
    }
    assemble_interface(positions, time_step * p);
}

void SubMeshSystem::assemble_interface(const Points& positions, double dt_p)
{
    const auto& vertices = sub_mesh_->interface.vertices;
    for (Index i = 0; i < static_cast<Index>(vertices.size()); ++i) {
        const auto begin = at(stencils_.columns.offsets[at(i)]);
        if (roles_[at(i)] == InterfaceRole::Follows) {
            values_[at(diagonal_slots_[at(vertices[at(i)])])] = 1.0;
            continue;
        }
        row_.resize(stencils_.columns[i].size());
        right_hand_side_.row(vertices[at(i)]) = adapted_robin_row(*sub_mesh_, stencils_, i, positions, dt_p, row_);
        for (std::size_t k = 0; k < row_.size(); ++k)
            values_[at(interface_slots_[begin + k])] = row_[k];
    }
}

void SubMeshSystem::factorise()
{
    const auto values = std::span<const double>(values_).first(values_.size() - 1);
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
        throw ComputationError("the equations are not finite, because the time step is too large for the mesh or the "
                               "flow has taken a face's area or an "
                               "edge's length: use a smaller time step or fewer steps");
    solver_->factorise(values);
}

void SubMeshSystem::solve(Points& solution)
{
    const auto& vertices = sub_mesh_->interface.vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (roles_[i] == InterfaceRole::Follows)
            right_hand_side_.row(vertices[i]) = solution.row(vertices[i]);
    solver_->solve(std::span<const double>(values_).first(values_.size() - 1), right_hand_side_, solution_);
    if (!solution_.allFinite())
        throw ComputationError("the result is not finite: use a smaller time step");
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        solution.row(v) = row_of_[at(v)] == Row::Fixed ? right_hand_side_.row(v) : solution_.row(v);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (roles_[i] == InterfaceRole::Follows)
            solution.row(vertices[i]) = right_hand_side_.row(vertices[i]);
}

}  // namespace seamflow
