#include "solvers/normals/vertex_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/LU>

#include "partition/vector_area.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// The most relaxation in a round (measured, like the default numbers of rounds: see engine/accuracy.md).
constexpr double most_relaxation = 0.1;
/// The fraction of the previous step that is added to each step, which saves most of the iterations (Polyak's heavy
/// ball).
constexpr double fit_momentum = 0.5;
/// The mean squared cosine between a direction and the normals at a vertex at which the vertex is half free in that
/// direction.
constexpr double half_free = 1e-3;
/// A face counts less at a vertex if its centroid is further away than this many times the nearest centroid.
constexpr double far_away = 6.0;

/// Per corner, the weight of its face at the vertex: 1, or less where its centroid is far away (as in fans of slivers).
/// An error of the face's normal, and relaxation, move the vertex in proportion to that distance.
/// @returns empty if all weights are 1.
std::vector<float> weights_of_corners(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                      const Points& centroids, const Executor& exec)
{
    // Per vertex: the squared distance beyond which a face counts less.
    std::vector<double> reach(usize(mesh.n_vertices()), std::numeric_limits<double>::infinity());
    const auto squared_distance = [&](Index v, Index corner) {
        return (centroids.row(topology.face_of[corner]) - positions.row(v)).squaredNorm();
    };
    // Faces without area may have their centroid at the vertex, as for a vertex in the middle of an edge.
    const auto has_area = [&](Index corner) {
        return area_above_rounding(mesh.face(topology.face_of[corner]), positions) > 0.0;
    };
    const auto reach_at = [&](Index v, auto&& counts) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Index corner : topology.corners_at(v))
            if (const double squared = squared_distance(v, corner); squared < nearest && counts(corner))
                nearest = squared;
        return far_away * far_away * nearest;
    };
    const bool none = sum(exec, mesh.n_vertices(), [&](Index v) {
                          double furthest = 0.0;
                          for (const Index corner : topology.corners_at(v))
                              furthest = std::max(furthest, squared_distance(v, corner));
                          // Areas, which take time, are computed only if a face without them is far away.
                          if (furthest <= reach_at(v, [](Index) { return true; }))
                              return 0.0;
                          reach[v] = reach_at(v, has_area);
                          return furthest > reach[v] ? 1.0 : 0.0;
                      }) == 0.0;
    std::vector<float> weights;
    if (none)
        return weights;
    weights.resize(usize(mesh.n_corners()), 1.0F);
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        for (const Index corner : topology.corners_at(v))
            if (const double squared = squared_distance(v, corner); squared > reach[v])
                weights[corner] = static_cast<float>(std::pow(reach[v] / squared, 2));
    });
    return weights;
}

/// The faces that vertices are fitted to.
struct WantedFaces {
    const PolygonMesh& mesh;
    const Topology& topology;
    const Points& normals;
    Points centroids;
    /// Per corner: the weight of its face at the vertex, 1 or less (see weights_of_corners); empty: 1.
    std::vector<float> weights;
};

/// How little a vertex resists relaxation in each direction: the inverse of 1 in directions along all of its faces, and
/// more where it would leave them.
Eigen::Matrix3d yielding(const WantedFaces& faces, Index v)
{
    Eigen::Matrix3d squared_cosines = Eigen::Matrix3d::Zero();
    const auto corners = faces.topology.corners_at(v);
    for (const Index corner : corners) {
        const Point normal = faces.normals.row(faces.topology.face_of[corner]);
        squared_cosines += normal.transpose() * normal;
    }
    const auto n = static_cast<double>(corners.size());
    const Eigen::Matrix3d resistance = Eigen::Matrix3d::Identity() + squared_cosines / (n * half_free);
    return resistance.inverse();
}

/// The sum over the faces of one vertex of its motions to them.
Point fitting_sum(const WantedFaces& faces, const Points& positions, Index v)
{
    const Point here = positions.row(v);
    Point fit = Point::Zero();
    for (const Index corner : faces.topology.corners_at(v)) {
        const Index f = faces.topology.face_of[corner];
        const Point normal = faces.normals.row(f);
        const double weight = faces.weights.empty() ? 1.0 : faces.weights[corner];
        fit += weight * normal.dot(faces.centroids.row(f) - here) * normal;
    }
    return fit;
}

/// The sum of the motions towards the neighbours. @param relaxation the fraction of the way.
Point relaxing_sum(const WantedFaces& faces, const Points& positions, Index v, double relaxation,
                   const Eigen::Matrix3d& yields)
{
    const Point here = positions.row(v);
    Point towards_neighbours = Point::Zero();
    for (const Index corner : faces.topology.corners_at(v)) {
        const double weight = faces.weights.empty() ? 1.0 : faces.weights[corner];
        for (const Index end : {faces.topology.next(faces.mesh, corner), faces.topology.previous(faces.mesh, corner)})
            towards_neighbours += 0.5 * weight * (positions.row(faces.mesh.face_vertices[end]) - here);
    }
    return relaxation * towards_neighbours * yields;
}

}  // namespace

void fit_vertices(const PolygonMesh& mesh, const Topology& topology, const FeatureLines& lines,
                  const NoisyNormals& wanted, Points& vertices, const Executor& exec)
{
    // The relaxation equals the chord of the noise, up to a limit at which hardly any face folds.
    const double relaxation = std::min(wanted.noise, most_relaxation);
    WantedFaces faces{mesh, topology, wanted.normals, Points(mesh.n_faces(), 3), {}};
    const auto relaxes = [&](Index v) {
        return relaxation > 0.0 && topology.moves(v) && topology.kind[v] == VertexKind::Interior;
    };
    // It depends on normals alone, and takes longer than a round.
    std::vector<Eigen::Matrix3d> yieldings(usize(mesh.n_vertices()));
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        if (relaxes(v))
            yieldings[v] = yielding(faces, v);
    });
    Points before = vertices;
    for (int i = 0; i < wanted.relaxing_rounds + wanted.plain_rounds; ++i) {
        for_each(exec, mesh.n_faces(), [&](Index f) { faces.centroids.row(f) = centroid(mesh.face(f), vertices); });
        if (i == 0)
            faces.weights = weights_of_corners(mesh, topology, vertices, faces.centroids, exec);
        before.swap(vertices);
        for_each(exec, mesh.n_vertices(), [&](Index v) {
            if (!topology.moves(v))
                return;
            Point motions = fitting_sum(faces, before, v);
            if (i < wanted.relaxing_rounds && relaxes(v))
                motions += relaxing_sum(faces, before, v, relaxation, yieldings[v]);
            const auto n = static_cast<double>(topology.corners_at(v).size());
            // `vertices` has the positions of the iteration before the last.
            vertices.row(v) =
                lines.on_line(v, before.row(v) + fit_momentum * (before.row(v) - vertices.row(v)) + motions / n);
        });
    }
}

}  // namespace seamflow
