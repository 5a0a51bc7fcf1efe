#include "partition/metrics/displacement.h"

#include <limits>
#include <string>

#include <fmt/format.h>

#include "partition/errors.h"

namespace seamflow {

Displacement split_displacement(const Point& displacement, const Point& normal_before, const Point& normal_after)
{
    const Point sum = normal_before + normal_after;
    // A sum of two unit vectors shorter than this is only rounding error: they are opposite.
    constexpr double shortest = 1e-12;
    const double length = sum.norm();
    if (!(length > shortest))
        return {};
    const Point normal = sum / length;
    const double along = displacement.dot(normal);
    return {.tangential = displacement - along * normal, .normal = along, .defined = true};
}

DisplacementField displacement_field(const PolygonMesh& mesh, const Points& before, const Points& after)
{
    if (before.rows() != mesh.n_vertices() || after.rows() != mesh.n_vertices())
        throw InputError(fmt::format("a mesh of {} vertices cannot have moved from {} positions to {}",
                                     mesh.n_vertices(), before.rows(), after.rows()));
    const Topology topology = make_topology(mesh);
    const VertexNormals normals(mesh, topology);
    constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
    DisplacementField field;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const Displacement d = split_displacement(after.row(v) - before.row(v), normals(v, before), normals(v, after));
        field.tangential.push_back(d.defined ? d.tangential.norm() : undefined);
        field.normal.push_back(d.defined ? d.normal : undefined);
    }
    return field;
}

DisplacementStatistics displacement_statistics(const DisplacementField& field)
{
    return {.tangential = length_statistics(field.tangential), .normal = length_statistics(field.normal)};
}

}  // namespace seamflow
