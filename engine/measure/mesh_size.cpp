#include "engine/measure/mesh_size.h"

#include <cmath>

#include "engine/tasks/parallel_executor.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

double total_area(const PolygonMesh& mesh)
{
    return sum(run_in_parallel, mesh.n_faces(), [&](Index f) { return area(mesh.face(f), mesh.vertices); });
}

MeshSize size_of(const PolygonMesh& mesh)
{
    struct Edges {
        double length = 0.0;
        bool have_lengths = true;
    };
    const auto add_face = [&](Edges& edges, Index f) {
        const auto corners = mesh.face(f);
        double around = 0.0;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Point edge =
                mesh.vertices.row(corners[k + 1 < corners.size() ? k + 1 : 0]) - mesh.vertices.row(corners[k]);
            const double length = edge.norm();
            edges.have_lengths &= std::isnormal(length);
            around += length;
        }
        edges.length += around;
    };
    const Edges edges = reduce(run_in_parallel, mesh.n_faces(), Edges{}, add_face, [](Edges& all, const Edges& part) {
        all.length += part.length;
        all.have_lengths &= part.have_lengths;
    });
    return {.vertices = mesh.n_vertices(),
            .area = total_area(mesh),
            .mean_edge = mesh.n_corners() > 0 ? edges.length / mesh.n_corners() : 0.0,
            .has_lengths = edges.have_lengths};
}

}  // namespace seamflow
