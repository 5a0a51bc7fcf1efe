#include "solvers/conditions/derivatives.h"

#include <algorithm>
#include <limits>

#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// The conormal of the fan of the given faces at a vertex with neighbours `before` and `after` along the fan's
/// boundary.
std::optional<Conormal> conormal_of(std::span<const Index> fan, const IndexLists& faces, Index vertex, Index before,
                                    Index after, const Points& positions)
{
    const Point v = positions.row(vertex);
    Point sum = Point::Zero();
    for (const Index f : fan)
        sum += v - centroid(faces[f], positions);
    const Point tau = positions.row(after) - positions.row(before);
    const double squared = tau.squaredNorm();
    Conormal conormal;
    conormal.alpha = squared > 0.0 ? sum.dot(tau) / squared : 0.0;
    const Point normal = sum - conormal.alpha * tau;
    conormal.norm = normal.norm();
    const double rounding = 64 * std::numeric_limits<double>::epsilon() * (sum.norm() + v.norm());
    if (!(conormal.norm > rounding))
        return std::nullopt;
    conormal.direction = normal / conormal.norm;
    return conormal;
}

}  // namespace

DerivativeStencils make_derivative_stencils(const SubMesh& sub_mesh)
{
    const auto& interface = sub_mesh.interface;
    DerivativeStencils stencils;
    for (Index i = 0; i < interface.size(); ++i) {
        std::vector<Index> columns;
        for (const Index f : interface.own_faces[i])
            columns.insert(columns.end(), sub_mesh.face_vertices[f].begin(), sub_mesh.face_vertices[f].end());
        sort_unique(columns);
        for (const Index f : interface.own_faces[i])
            for (const Index v : sub_mesh.face_vertices[f])
                stencils.corner_columns.values.push_back(place_in(columns, v));
        stencils.centre.push_back(place_in(columns, interface.vertices[i]));
        stencils.before.push_back(place_in(columns, interface.before[i]));
        stencils.after.push_back(place_in(columns, interface.after[i]));
        stencils.columns.values.insert(stencils.columns.values.end(), columns.begin(), columns.end());
        stencils.columns.close();
        stencils.corner_columns.close();
    }
    return stencils;
}

std::optional<Conormal> own_conormal(const SubMesh& sub_mesh, Index i, const Points& positions)
{
    const auto& interface = sub_mesh.interface;
    return conormal_of(interface.own_faces[i], sub_mesh.face_vertices, interface.vertices[i], interface.before[i],
                       interface.after[i], positions);
}

std::optional<Conormal> complement_conormal(const SubMesh& sub_mesh, Index i, const Points& positions)
{
    const auto& interface = sub_mesh.interface;
    return conormal_of(interface.complement_faces[i], interface.halo_faces, interface.vertices[i], interface.before[i],
                       interface.after[i], positions);
}

void normal_derivative_row(const SubMesh& sub_mesh, const DerivativeStencils& stencils, Index i,
                           const Conormal& conormal, std::span<double> row)
{
    std::fill(row.begin(), row.end(), 0.0);
    auto column = stencils.corner_columns[i].begin();
    for (const Index f : sub_mesh.interface.own_faces[i]) {
        const std::size_t p = sub_mesh.face_vertices[f].size();
        row[stencils.centre[i]] += 1.0;
        for (std::size_t k = 0; k < p; ++k)
            row[*column++] -= 1.0 / static_cast<double>(p);
    }
    row[stencils.after[i]] -= conormal.alpha;
    row[stencils.before[i]] += conormal.alpha;
    for (double& coefficient : row)
        coefficient /= conormal.norm;
}

Point complement_normal_derivative(const SubMesh& sub_mesh, Index i, const Conormal& conormal, const Points& other_side)
{
    const auto& interface = sub_mesh.interface;
    const Point v = other_side.row(interface.vertices[i]);
    Point sum = Point::Zero();
    for (const Index f : interface.complement_faces[i])
        sum += v - centroid(interface.halo_faces[f], other_side);
    const Point tau = other_side.row(interface.after[i]) - other_side.row(interface.before[i]);
    return (sum - conormal.alpha * tau) / conormal.norm;
}

TangentialWeights tangential_weights(const SubMesh& sub_mesh, Index i, const Points& positions)
{
    const auto& interface = sub_mesh.interface;
    const Point v = positions.row(interface.vertices[i]);
    const double to_before = (v - positions.row(interface.before[i])).norm();
    const double to_after = (v - positions.row(interface.after[i])).norm();
    const double scale = 2.0 / (to_before + to_after);
    return {scale / to_before, scale / to_after};
}

void add_tangential_derivative(const DerivativeStencils& stencils, Index i, const TangentialWeights& weights,
                               double factor, std::span<double> row)
{
    row[stencils.before[i]] -= factor * weights.before;
    row[stencils.after[i]] -= factor * weights.after;
    row[stencils.centre[i]] += factor * (weights.before + weights.after);
}

Point tangential_derivative(const SubMesh& sub_mesh, Index i, const TangentialWeights& weights, const Points& positions)
{
    const auto& interface = sub_mesh.interface;
    const Point v = positions.row(interface.vertices[i]);
    return weights.before * (v - positions.row(interface.before[i])) +
           weights.after * (v - positions.row(interface.after[i]));
}

}  // namespace seamflow
