#include "engine/steppers/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "engine/tasks/parallel_executor.h"
#include "partition/index_lists.h"
#include "solvers/direct/columns.h"

namespace seamflow {

namespace {

/// The fractions of a difference between two flows on Γ that are left after the next step.
struct Carried {
    /// The fraction left of tangential displacements of single vertices by a correction: all with Δ_A and Δ_P, which do
    /// not depend on the tangential position of vertices; with Δ_F (Laplacian::Fujiwara) half to all, less of a rough
    /// displacement. Normal displacements spread, and leave nothing at their vertex.
    double tangential_correction;
    /// The fractions left of the tangential error of a sweep, and of its normal error if this is smooth along Γ. Across
    /// Γ the error is smooth over √dt: the first step leaves a half of its largest value, the next one three quarters,
    /// then five sixths, and so on.
    double tangential_error;
    double normal_error;
};

/// The fractions that steps with a Laplacian leave.
Carried carried_by(Laplacian laplacian)
{
    return laplacian == Laplacian::Fujiwara ? Carried{0.65, 0.8, 0.8} : Carried{1.0, 1.0, 0.8};
}

/// A vector with its tangential and its normal component multiplied by one factor each.
Point scaled(const Point& vector, const Point& normal, double tangentially, double normally)
{
    const Point along_normal = vector.dot(normal) * normal;
    return tangentially * (vector - along_normal) + normally * along_normal;
}

}  // namespace

ErrorEstimate::ErrorEstimate(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                             const StepEquation& equation, bool has_copies, InterfaceRanks& ranks)
    : decomposition_(&decomposition)
    , mesh_(&mesh)
    , topology_(&topology)
    , laplacian_(equation.laplacian.kind)
    , time_step_(equation.time_step)
    , has_copies_(has_copies)
    , ranks_(&ranks)
    , equation_(decomposition, mesh, topology, equation.laplacian, ranks, run_in_parallel)
{
    for (Points* array : {&correction_, &corrected_, &swept_})
        array->setZero(equation_.size(), 3);
    if (equation.terms.keeps_stiffness)
        initial_ = mesh.vertices;
    store_attachment(equation.terms);
    if (laplacian_ == Laplacian::PtackovaVelho) {
        solved_ = mesh.vertices;
        list_remote_rows();
    }
}

/// Lists the corners of remote faces that share an edge with faces of this rank.
void ErrorEstimate::list_remote_rows()
{
    if (ranks_->has_all())
        return;
    remote_rows_.resize(decomposition_->sub_meshes.size());
    const std::vector<Index> labels = labels_by_face(*decomposition_, mesh_->n_faces());
    for (Index h = 0; h < mesh_->n_corners(); ++h) {
        const Index twin = topology_->twin[h];
        if (twin < 0 || !ranks_->is_own(labels[topology_->face_of[h]]))
            continue;
        const Index f = topology_->face_of[twin];
        if (const Index s = labels[f]; !ranks_->is_own(s))
            for (const Index v : mesh_->face(f))
                remote_rows_[s].push_back(local_index(decomposition_->sub_meshes[s], v));
    }
    for (auto& rows : remote_rows_)
        sort_unique(rows);
}

/// Stores V⁰ and dt w at each vertex of Γ, if the flow pulls vertices back to V⁰ with weights w (see FlowTerms).
void ErrorEstimate::store_attachment(const FlowTerms& terms)
{
    if (!terms.attaches())
        return;
    const std::vector<Index> global = vertices();
    attached_to_ = rows_of(*terms.initial, global);
    for (const Index v : global)
        attached_.push_back(time_step_ * terms.weight(v));
}

std::vector<Index> ErrorEstimate::vertices() const
{
    std::vector<Index> global;
    for (Index s = 0; s < static_cast<Index>(decomposition_->sub_meshes.size()); ++s)
        for (Index i = equation_.first(s); i < equation_.first(s + 1); ++i)
            global.push_back(decomposition_->sub_meshes[s].local_to_global[equation_.local_vertex(i)]);
    return global;
}

/// #local by 3: Vᵏ⁺¹ as solved by sub-mesh s; on Γ, the mean over all copies.
/// @param storage is overwritten with the result if sub-meshes have copies of Γ.
const Points& ErrorEstimate::joined(const std::vector<SubMeshState>& states, Index s, Points& storage) const
{
    const SubMeshState& state = states[s];
    if (!has_copies_)
        return state.solution;
    set_rows(storage, state.solution.rows());
    storage = state.solution;
    const auto& interface = state.sub_mesh->interface;
    for (Index i = 0; i < interface.size(); ++i)
        storage.row(interface.vertices[i]) = mean_of_copies(states, interface, i, &SubMeshState::solution);
    return storage;
}

/// #local by 3: the positions at which the K of the step is assembled: Vᵏ, or V⁰ if K is kept.
/// @param storage is overwritten with V⁰.
const Points& ErrorEstimate::stiffness_positions(const SubMeshState& state, Points& storage) const
{
    if (initial_.rows() == 0)
        return state.position;
    return gather_rows(state.sub_mesh->local_to_global, initial_, storage);
}

void ErrorEstimate::measure(const std::vector<SubMeshState>& states, Index s, SolverWorkspace& workspace)
{
    const SubMeshState& state = states[s];
    const Points& after = joined(states, s, workspace.other_side);
    equation_.assemble(s, state.position, after, stiffness_positions(state, workspace.positions), time_step_);
    for (Index i = equation_.first(s); !attached_.empty() && i < equation_.first(s + 1); ++i)
        equation_.attach(i, attached_[i], after.row(equation_.local_vertex(i)) - attached_to_.row(i));
    if (solved_.rows() > 0)
        for (Index v = 0; v < state.sub_mesh->n_vertices; ++v)
            if (state.sub_mesh->owned[v] != 0)
                solved_.row(state.sub_mesh->local_to_global[v]) = after.row(v);
}

void ErrorEstimate::note_correction(const std::vector<SubMeshState>& states, Index s)
{
    const SubMeshState& state = states[s];
    for (Index i = equation_.first(s); i < equation_.first(s + 1); ++i) {
        const Index v = equation_.local_vertex(i);
        correction_.row(i) = state.position.row(v) - state.solution.row(v);
    }
}

/// Carries the differences of earlier steps over this step. Their tangential parts, times the fractions in Carried,
/// stay at their vertices: in corrected_ (displacements by corrections) and swept_ (errors of sweeps). The rest of
/// corrected_, which the step spreads, and the normal part of swept_, times its fraction, go to the right-hand side of
/// this step. Then the correction of this step is added to corrected_.
void ErrorEstimate::carry_over()
{
    const Carried carried = carried_by(laplacian_);
    for_each(run_in_parallel, equation_.size(), [&](Index i) {
        const Point normal = equation_.normal(i);
        const Point kept = scaled(corrected_.row(i), normal, carried.tangential_correction, 0.0);
        equation_.add_displacement(i, corrected_.row(i) - kept);
        corrected_.row(i) = kept + correction_.row(i);
        equation_.add_error(i, scaled(swept_.row(i), normal, 0.0, carried.normal_error));
        swept_.row(i) = scaled(swept_.row(i), normal, carried.tangential_error, 0.0);
    });
}

/// Fills in Vᵏ⁺¹ as solved, and Vᵏ, at vertices of other ranks that this rank's rows reach.
/// @returns #V by 3: Vᵏ.
const Points& ErrorEstimate::fill_remote_rows(const std::vector<SubMeshState>& states, const Points& before)
{
    if (remote_rows_.empty())
        return before;
    before_ = before;
    for (std::size_t s = 0; s < remote_rows_.size(); ++s)
        for (const Index v : remote_rows_[s]) {
            const Index global = states[s].sub_mesh->local_to_global[v];
            before_.row(global) = states[s].position.row(v);
            solved_.row(global) = states[s].solution.row(v);
        }
    return before_;
}

void ErrorEstimate::add_step(const std::vector<SubMeshState>& states, const Points& before)
{
    if (laplacian_ == Laplacian::PtackovaVelho)
        equation_.measure_whole_rows(*mesh_, *topology_, fill_remote_rows(states, before), solved_, time_step_,
                                     run_in_parallel);
    carry_over();
    equation_.solve(run_in_parallel);
    swept_ += equation_.error();
    largest_ = find_largest();
}

void ErrorEstimate::save(StepMemory& memory) const
{
    memory.arrays.push_back(corrected_);
    memory.arrays.push_back(swept_);
}

void ErrorEstimate::restore(StepMemoryReader& memory)
{
    // The numbers need not be finite: an estimate that has overflowed must not stop a flow, nor keep it from being
    // resumed.
    corrected_ = memory.array_of_any(corrected_.rows());
    swept_ = memory.array_of_any(swept_.rows());
}

/// The largest error over all ranks; empty if it is not finite.
std::optional<double> ErrorEstimate::find_largest() const
{
    double squared = 0.0;
    // 1 if a number is not finite: a double, so that it can be compared between ranks.
    double is_lost = 0.0;
    for (Eigen::Index i = 0; i < swept_.rows(); ++i) {
        const Point error = swept_.row(i);
        // A correction may happen to cancel an error of sweeps: the larger of the two distances counts.
        const double here = std::max(error.squaredNorm(), (error + corrected_.row(i)).squaredNorm());
        if (std::isfinite(here))
            squared = std::max(squared, here);
        else
            is_lost = 1.0;
    }
    const std::vector<double> of_all = ranks_->largest({squared, is_lost});
    return of_all[1] > 0.0 ? std::nullopt : std::optional(std::sqrt(of_all[0]));
}

}  // namespace seamflow
