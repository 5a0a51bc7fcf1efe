#include "solvers/normals/vertex_fit.h"

#include <algorithm>

#include <Eigen/LU>

#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// The most relaxation at once (measured, like the default numbers of rounds: see engine/accuracy.md).
constexpr double most_relaxation = 0.1;
/// Of the step before, which makes the iterations worth several times as many (Polyak's heavy ball).
constexpr double fit_momentum = 0.5;
/// A direction is half free at a vertex where the mean of the squared cosines between it and the normals is this much.
constexpr double half_free = 1e-3;

/// The faces to fit vertices to.
struct WantedFaces {
    const PolygonMesh& mesh;
    const Topology& topology;
    const Points& normals;
    Points centroids;
};

/// The step of one vertex.
Point fitting_step(const WantedFaces& faces, const Points& positions, Index v, double relaxation)
{
    const auto& [mesh, topology, normals, centroids] = faces;
    const Point here = positions.row(v);
    Point fit = Point::Zero();
    Point towards_neighbours = Point::Zero();
    Eigen::Matrix3d squared_cosines = Eigen::Matrix3d::Zero();
    const auto corners = topology.corners_at(v);
    for (const Index corner : corners) {
        const Index f = topology.face_of[corner];
        const Point normal = normals.row(f);
        fit += normal * normal.dot(centroids.row(f) - here);
        if (relaxation == 0.0)
            continue;
        squared_cosines += normal.transpose() * normal;
        for (const Index end : {topology.next(mesh, corner), topology.previous(mesh, corner)})
            towards_neighbours += 0.5 * (positions.row(mesh.face_vertices[end]) - here);
    }
    const auto n = static_cast<double>(corners.size());
    if (relaxation == 0.0)
        return fit / n;
    const Eigen::Matrix3d resistance = Eigen::Matrix3d::Identity() + squared_cosines / (n * half_free);
    return (fit + relaxation * towards_neighbours * resistance.inverse()) / n;
}

}  // namespace

void fit_vertices(const PolygonMesh& mesh, const Topology& topology, const FeatureLines& lines,
                  const NoisyNormals& wanted, Points& vertices, const Executor& exec)
{
    // Relaxation goes as far as chords of noise are long, up to a limit that folds hardly any face.
    const double relaxation = std::min(wanted.noise, most_relaxation);
    WantedFaces faces{mesh, topology, wanted.normals, Points(mesh.n_faces(), 3)};
    Points before = vertices;
    for (int i = 0; i < wanted.relaxing_rounds + wanted.plain_rounds; ++i) {
        for_each(exec, mesh.n_faces(), [&](Index f) { faces.centroids.row(f) = centroid(mesh.face(f), vertices); });
        before.swap(vertices);
        for_each(exec, mesh.n_vertices(), [&](Index v) {
            if (!topology.moves(v))
                return;
            const bool relaxes = i < wanted.relaxing_rounds && topology.kind[v] == VertexKind::Interior;
            // `vertices` has the positions of the iteration before the last.
            vertices.row(v) = lines.on_line(v, before.row(v) + fit_momentum * (before.row(v) - vertices.row(v)) +
                                                   fitting_step(faces, before, v, relaxes ? relaxation : 0.0));
        });
    }
}

}  // namespace seamflow
