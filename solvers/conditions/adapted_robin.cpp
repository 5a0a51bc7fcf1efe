#include "solvers/conditions/adapted_robin.h"

#include <algorithm>
#include <cmath>

namespace seamflow {

namespace {

/// The mean length of the edges at the i-th vertex of Γ.
double mean_edge_at(const SubMesh& sub_mesh, Index i, const Points& positions)
{
    double sum = 0.0;
    for (const Index neighbour : sub_mesh.corrected.neighbours[i])
        sum += (positions.row(neighbour) - positions.row(sub_mesh.corrected.vertices[i])).norm();
    return sum / static_cast<double>(sub_mesh.corrected.neighbours[i].size());
}

/// Whether the coefficients of the fan's ∂n are neither nearly 0 nor huge relative to 1 / edge. The bounds are
/// measured.
bool is_in_proportion(std::span<const Index> fan, const IndexLists& faces, const Conormal& conormal, double edge)
{
    constexpr double least_diagonal = 0.2;
    constexpr double largest_coefficient = 6.0;
    double diagonal = 0.0;
    for (const Index f : fan)
        diagonal += 1.0 - 1.0 / static_cast<double>(faces[f].size());
    // A neighbour along Γ has ±α and, for each of its faces in the fan, -1/p with p at least 3: rarely more than |α| +
    // 1.
    const double largest = std::max(diagonal, std::abs(conormal.alpha) + 1.0) * edge / conormal.norm;
    return diagonal * edge / conormal.norm > least_diagonal && largest < largest_coefficient;
}

}  // namespace

AdaptedRobin::AdaptedRobin(const SubMesh& sub_mesh, double q, RightSide right_side)
    : sub_mesh_(&sub_mesh)
    , q_(q)
    , right_side_(right_side)
    , stencils_(make_derivative_stencils(sub_mesh))
    , conormals_(sub_mesh.interface.vertices.size())
    , others_weights_(conormals_.size())
{
}

void AdaptedRobin::begin_step(const Points& positions, const Points& other_side, double time_step, double p)
{
    dt_p_ = time_step * p;
    dt_q_ = time_step * q_;
    for (Index i = 0; i < sub_mesh_->interface.size(); ++i) {
        const auto own = own_conormal(*sub_mesh_, i, positions);
        const auto other = complement_conormal(*sub_mesh_, i, other_side);
        conormals_[i] = own && other ? std::optional(Conormals{*own, *other}) : std::nullopt;
        if (dt_q_ != 0.0 && right_side_ == RightSide::OthersCopy)
            others_weights_[i] = tangential_weights(*sub_mesh_, i, other_side);
    }
}

void AdaptedRobin::left_hand_side(Index i, const Points& positions, std::span<double> row) const
{
    if (conormals_[i]) {
        normal_derivative_row(*sub_mesh_, stencils_, i, conormals_[i]->own, row);
        for (double& coefficient : row)
            coefficient *= dt_p_;
    } else {
        std::fill(row.begin(), row.end(), 0.0);
    }
    row[stencils_.centre[i]] += 1.0;
    if (dt_q_ != 0.0)
        add_tangential_derivative(stencils_, i, tangential_weights(*sub_mesh_, i, positions), dt_q_, row);
}

Point AdaptedRobin::right_hand_side(Index i, const Points& positions, const Points& other_side) const
{
    const Points& on_interface = right_side_ == RightSide::Own ? positions : other_side;
    Point right = on_interface.row(sub_mesh_->interface.vertices[i]);
    if (conormals_[i])
        right -= dt_p_ * complement_normal_derivative(*sub_mesh_, i, conormals_[i]->other, other_side);
    if (dt_q_ != 0.0 && right_side_ == RightSide::OthersCopy)
        right += dt_q_ * tangential_derivative(*sub_mesh_, i, others_weights_[i], other_side);
    return right;
}

bool AdaptedRobin::is_well_defined(Index i, const Points& positions) const
{
    // The largest cosine of the angle between the conormals; and the least distance between the two neighbours along Γ,
    // in mean edge lengths.
    constexpr double most_aligned = -0.5;
    constexpr double shortest_tangent = 0.3;
    if (!conormals_[i])
        return false;
    const auto& [own, other] = *conormals_[i];
    const auto& interface = sub_mesh_->interface;
    const double edge = mean_edge_at(*sub_mesh_, i, positions);
    const double tangent = (positions.row(interface.after[i]) - positions.row(interface.before[i])).norm();
    return own.direction.dot(other.direction) < most_aligned && tangent > shortest_tangent * edge &&
           is_in_proportion(interface.own_faces[i], sub_mesh_->face_vertices, own, edge) &&
           is_in_proportion(interface.complement_faces[i], interface.halo_faces, other, edge);
}

std::unique_ptr<TransmissionCondition> make_adapted_ventcell(const SubMesh& sub_mesh, double q)
{
    return std::make_unique<AdaptedRobin>(sub_mesh, q);
}

std::unique_ptr<TransmissionCondition> make_ventcell(const SubMesh& sub_mesh, double q)
{
    return std::make_unique<AdaptedRobin>(sub_mesh, q, RightSide::OthersCopy);
}

}  // namespace seamflow
