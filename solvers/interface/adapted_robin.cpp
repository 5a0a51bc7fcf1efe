#include "solvers/interface/adapted_robin.h"

#include <algorithm>

namespace seamflow {

Point adapted_robin_row(const SubMesh& sub_mesh, const DerivativeStencils& stencils, Index i, const Points& positions,
                        double dt_p, std::span<double> row)
{
    const Point v = positions.row(sub_mesh.interface.vertices[at(i)]);
    const auto own = own_conormal(sub_mesh, i, positions);
    const auto other = complement_conormal(sub_mesh, i, positions);
    if (!own || !other) {
        std::fill(row.begin(), row.end(), 0.0);
        row[at(stencils.centre[at(i)])] = 1.0;
        return v;
    }
    normal_derivative_row(sub_mesh, stencils, i, *own, row);
    for (double& coefficient : row)
        coefficient *= dt_p;
    row[at(stencils.centre[at(i)])] += 1.0;
    return v - dt_p * other->direction;
}

}  // namespace seamflow
