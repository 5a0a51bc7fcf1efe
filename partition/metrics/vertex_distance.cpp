#include "partition/metrics/vertex_distance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "partition/errors.h"

namespace seamflow {

double mean_edge_length(const PolygonMesh& mesh)
{
    return mean_edge_length(mesh, mesh.vertices);
}

VertexDistance vertex_distance(const PolygonMesh& mesh, const Points& reference, const Points& candidate)
{
    if (reference.rows() != candidate.rows())
        throw InputError(fmt::format("the reference has {} vertices, the candidate {}: only meshes with corresponding "
                                     "vertices can be compared",
                                     reference.rows(), candidate.rows()));
    if (reference.rows() != mesh.vertices.rows())
        throw InputError(fmt::format("there are {} positions, but the mesh has {} vertices", reference.rows(),
                                     mesh.vertices.rows()));
    VertexDistance distance;
    distance.mean_edge = mean_edge_length(mesh, reference);
    if (reference.rows() == 0)
        return distance;
    double sum = 0.0;
    double sum_of_squares = 0.0;
    const std::vector<std::uint8_t> is_used = used_by_faces(mesh);
    Index n_used = 0;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        if (is_used[v] == 0 && mesh.n_faces() > 0)
            continue;
        ++n_used;
        const double squared = (candidate.row(v) - reference.row(v)).squaredNorm();
        sum += std::sqrt(squared);
        sum_of_squares += squared;
        distance.max = std::max(distance.max, std::sqrt(squared));
    }
    const auto count = static_cast<double>(n_used);
    distance.mean = sum / count;
    distance.rms = std::sqrt(sum_of_squares / count);
    return distance;
}

}  // namespace seamflow
