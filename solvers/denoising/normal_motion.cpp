#include "solvers/denoising/normal_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/LU>

#include "partition/metrics/flipped_faces.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// The mean squared cosine between a direction and the wanted normals at which half of the motion in that direction is
/// kept.
constexpr double half_kept = 0.04;
/// A face whose cosine with its wanted normal is below this may have been folded; the motion along normals has folded
/// it if the cosine has become smaller by at least this loss.
constexpr double least_cosine = 0.7;
constexpr double loss_of_cosine = 0.02;
/// A face whose cosine with its wanted normal is below this may not turn further away from it. Wanted normals of
/// slivers with large noise are themselves off by some degrees.
constexpr double least_facing = 0.1;
/// The number of rounds by which the vertices that move freely spread around folded faces.
constexpr int freeing_rounds = 6;
/// The number of times that a motion is halved before its vertex stays.
constexpr int halvings = 9;

/// Compares faces with their wanted normals, which shows the folded ones.
class FoldedFaces {
  public:
    FoldedFaces(const PolygonMesh& mesh, const Topology& topology, const Points& wanted, const Executor& exec)
        : mesh_(mesh)
        , topology_(topology)
        , wanted_(wanted)
        , exec_(exec)
    {
    }

    /// #F: the cosine between each face and its wanted normal; 1 for faces without a wanted normal, 0 for faces without
    /// area.
    [[nodiscard]] std::vector<double> cosines(const Points& positions) const
    {
        std::vector<double> found(usize(mesh_.n_faces()));
        for_each(exec_, mesh_.n_faces(), [&](Index f) {
            const Point normal = vector_area(mesh_.face(f), positions);
            const double length = area_above_rounding(mesh_.face(f), positions);
            found[f] = wanted_.row(f).isZero() ? 1.0 : length > 0.0 ? normal.dot(wanted_.row(f)) / length : 0.0;
        });
        return found;
    }

    /// The vertices of the faces for which condition(f) is true.
    template <class Condition>
    [[nodiscard]] std::vector<Index> vertices_of(Condition&& condition) const
    {
        return select(exec_, mesh_.n_vertices(), [&](Index v) {
            for (const Index corner : topology_.corners_at(v))
                if (condition(topology_.face_of[corner]))
                    return true;
            return false;
        });
    }

  private:
    const PolygonMesh& mesh_;
    const Topology& topology_;
    const Points& wanted_;
    const Executor& exec_;
};

}  // namespace

double motion_along_normal(const Topology& topology, const Points& normals, Index v, const Point& motion)
{
    Point normal = Point::Zero();
    for (const Index corner : topology.corners_at(v)) {
        const Point of_face = normals.row(topology.face_of[corner]);
        normal += of_face.dot(normal) < 0.0 ? Point(-of_face) : of_face;
    }
    const double length = normal.norm();
    return length > 0.0 ? std::abs(motion.dot(normal)) / length : 0.0;
}

std::vector<double> edge_lengths_at_vertices(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                             const Executor& exec)
{
    std::vector<double> lengths(usize(mesh.n_vertices()));
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        double total = 0.0;
        const auto corners = topology.corners_at(v);
        for (const Index corner : corners) {
            const Index next = mesh.face_vertices[topology.next(mesh, corner)];
            total += (positions.row(next) - positions.row(v)).norm();
        }
        lengths[v] = total / static_cast<double>(std::max(corners.size(), std::size_t{1}));
    });
    return lengths;
}

Points along_normals(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                     const Points& wanted, const Executor& exec)
{
    Points positions(before.rows(), 3);
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        // The motion m becomes m S² (S² + δ² I)⁻¹, with S = mean n nᵀ and δ = half_kept.
        Eigen::Matrix3d squared_cosines = Eigen::Matrix3d::Zero();
        const auto corners = topology.corners_at(v);
        for (const Index corner : corners) {
            const Point normal = wanted.row(topology.face_of[corner]);
            squared_cosines += normal.transpose() * normal / static_cast<double>(corners.size());
        }
        const Eigen::Matrix3d squared = squared_cosines * squared_cosines;
        const Eigen::Matrix3d resistance = squared + half_kept * half_kept * Eigen::Matrix3d::Identity();
        const Point motion = after.row(v) - before.row(v);
        positions.row(v) = before.row(v) + motion * squared * resistance.inverse();
    });
    const FoldedFaces faces(mesh, topology, wanted, exec);
    const std::vector<double> of_after = faces.cosines(after);
    std::size_t n_free = 0;
    for (int round = 0; round < freeing_rounds; ++round) {
        const std::vector<double> cosines = faces.cosines(positions);
        const std::vector<Index> folded = faces.vertices_of(
            [&](Index f) { return cosines[f] < least_cosine && cosines[f] < of_after[f] - loss_of_cosine; });
        for (const Index v : folded)
            positions.row(v) = after.row(v);
        if (folded.size() == n_free)
            break;
        n_free = folded.size();
    }
    return positions;
}

void keep_facing(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& wanted,
                 Points& positions, const Executor& exec)
{
    const FoldedFaces faces(mesh, topology, wanted, exec);
    const std::vector<double> of_before = faces.cosines(before);
    // The loop ends, because a face whose vertices are all back has not turned.
    for (int round = 0;; ++round) {
        const std::vector<double> cosines = faces.cosines(positions);
        std::vector<std::uint8_t> is_folded(usize(mesh.n_faces()), 0);
        for (const Index f : folded_faces(mesh, before, positions, flipped_faces(mesh, before, positions, exec)))
            is_folded[f] = 1;
        const std::vector<Index> turned = faces.vertices_of([&](Index f) {
            return is_folded[f] != 0 || (of_before[f] > 0.0 && cosines[f] < std::min(least_facing, of_before[f]));
        });
        if (turned.empty())
            return;
        for (const Index v : turned)
            positions.row(v) = before.row(v) + (round < halvings ? 0.5 : 0.0) * (positions.row(v) - before.row(v));
    }
}

}  // namespace seamflow
