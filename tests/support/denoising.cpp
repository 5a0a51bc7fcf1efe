#include "tests/support/denoising.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/surface_distance.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/topology.h"
#include "samples/meshes/random_numbers.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/normals/face_neighbours.h"

namespace seamflow::test {

namespace {

/// Two at once, by the method of Box and Muller.
Eigen::RowVector2d normal_numbers(RandomNumbers& random)
{
    const double length = std::sqrt(-2.0 * std::log(1.0 - random.unit()));
    const double angle = 2.0 * std::numbers::pi * random.unit();
    return {length * std::cos(angle), length * std::sin(angle)};
}

double volume(const PolygonMesh& mesh)
{
    double sum = 0.0;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        sum += centroid(mesh.face(f), mesh.vertices).dot(vector_area(mesh.face(f), mesh.vertices)) / 3.0;
    return sum;
}

Points face_normals(const PolygonMesh& mesh)
{
    Points normals(mesh.n_faces(), 3);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        normals.row(f) = vector_area(mesh.face(f), mesh.vertices).normalized();
    return normals;
}

/// The filter on one mesh, whose normals resume from call to call.
class Bilateral {
  public:
    explicit Bilateral(const PolygonMesh& mesh, double sigma)
        : mesh_(mesh)
        , topology_(make_topology(mesh))
        , neighbours_(make_face_neighbours(mesh, topology_))
        , normals_(face_normals(mesh))
        , sigma_(sigma)
    {
        Points centroids(mesh.n_faces(), 3);
        for (Index f = 0; f < mesh.n_faces(); ++f)
            centroids.row(f) = centroid(mesh.face(f), mesh.vertices);
        double distances = 0.0;
        for (Index h = 0; h < mesh.n_corners(); ++h)
            if (topology_.twin[h] >= 0)
                distances +=
                    (centroids.row(topology_.face_of[h]) - centroids.row(topology_.face_of[topology_.twin[h]])).norm();
        const double sigma_c = distances / mesh.n_corners();
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            areas_.push_back(area(mesh.face(f), mesh.vertices));
            for (const Index g : neighbours_[f])
                weights_.push_back(
                    std::exp(-(centroids.row(f) - centroids.row(g)).squaredNorm() / (2.0 * sigma_c * sigma_c)));
        }
    }

    void smooth_normals(int iterations)
    {
        for (int i = 0; i < iterations; ++i) {
            Points next(normals_.rows(), 3);
            for_each(run_in_parallel, mesh_.n_faces(), [&](Index f) {
                Point sum = areas_[f] * normals_.row(f);
                for (std::size_t k = neighbours_.offsets[f]; k < neighbours_.offsets[f + 1]; ++k) {
                    const Index g = neighbours_.faces[k];
                    const double chord = (normals_.row(f) - normals_.row(g)).squaredNorm();
                    sum += areas_[g] * weights_[k] * std::exp(-chord / (2.0 * sigma_ * sigma_)) * normals_.row(g);
                }
                next.row(f) = sum.normalized();
            });
            normals_.swap(next);
        }
    }

    [[nodiscard]] PolygonMesh fitted(int iterations) const
    {
        PolygonMesh mesh = mesh_;
        for (int i = 0; i < iterations; ++i) {
            const Points before = mesh.vertices;
            for_each(run_in_parallel, mesh.n_vertices(), [&](Index v) {
                Point step = Point::Zero();
                for (const Index corner : topology_.corners_at(v)) {
                    const Index f = topology_.face_of[corner];
                    step += normals_.row(f) * normals_.row(f).dot(centroid(mesh.face(f), before) - before.row(v));
                }
                mesh.vertices.row(v) += step / static_cast<double>(topology_.corners_at(v).size());
            });
        }
        return mesh;
    }

  private:
    const PolygonMesh& mesh_;
    Topology topology_;
    FaceNeighbours neighbours_;
    std::vector<double> areas_;
    std::vector<double> weights_;
    Points normals_;
    double sigma_;
};

}  // namespace

PolygonMesh with_gaussian_noise(const PolygonMesh& mesh, double sigma, std::uint32_t seed)
{
    PolygonMesh noisy = mesh;
    RandomNumbers random(seed);
    const double unit = sigma * mean_edge_length(mesh, mesh.vertices);
    for (auto&& p : noisy.vertices.rowwise()) {
        const Eigen::RowVector2d first = normal_numbers(random);
        const Eigen::RowVector2d second = normal_numbers(random);
        p += unit * second.y() * Eigen::RowVector3d(first.x(), first.y(), second.x()).normalized();
    }
    return noisy;
}

double angle_to_truth(const PolygonMesh& truth, const PolygonMesh& result)
{
    double sum = 0.0;
    for (Index f = 0; f < truth.n_faces(); ++f) {
        const Point a = vector_area(truth.face(f), truth.vertices);
        const Point b = vector_area(result.face(f), result.vertices);
        sum += std::atan2(a.cross(b).norm(), a.dot(b));
    }
    return sum / truth.n_faces() * 180.0 / std::numbers::pi;
}

DenoiseReport denoise_in_place(PolygonMesh& mesh, const DenoiseOptions& options)
{
    return denoise(mesh, options);
}

bool names(const std::vector<Remark>& remarks, const std::string& kind)
{
    return std::ranges::any_of(remarks, [&](const Remark& remark) { return remark.kind == kind; });
}

double furthest(const PolygonMesh& mesh, const PolygonMesh& before)
{
    return (mesh.vertices - before.vertices).cwiseAbs().maxCoeff();
}

Denoised compare_with_truth(const PolygonMesh& truth, const PolygonMesh& result)
{
    return {.angle = angle_to_truth(truth, result),
            .distance = surface_distance(result, truth).mean / mean_edge_length(truth, truth.vertices),
            .volume = volume(result) / volume(truth) - 1.0};
}

PolygonMesh taubin_smoothed(PolygonMesh mesh, int iterations)
{
    const Topology topology = make_topology(mesh);
    for (int i = 0; i < iterations; ++i)
        for (const double factor : {0.5, -0.53}) {
            const Points before = mesh.vertices;
            for (Index v = 0; v < mesh.n_vertices(); ++v) {
                Point sum = Point::Zero();
                int n = 0;
                const auto add = [&](Index neighbour) {
                    sum += before.row(neighbour) - before.row(v);
                    ++n;
                };
                const bool is_inside = topology.kind[v] != VertexKind::Boundary;
                for (const Index corner : topology.corners_at(v)) {
                    if (is_inside || topology.twin[corner] < 0)
                        add(mesh.face_vertices[topology.next(mesh, corner)]);
                    const Index previous = topology.previous(mesh, corner);
                    if (!is_inside && topology.twin[previous] < 0)
                        add(mesh.face_vertices[previous]);
                }
                if (n > 0)
                    mesh.vertices.row(v) += factor * sum / n;
            }
        }
    return mesh;
}

PolygonMesh best_of_bilateral_filters(const PolygonMesh& truth, const PolygonMesh& noisy, const BilateralGrid& grid)
{
    PolygonMesh best = noisy;
    double least = angle_to_truth(truth, noisy);
    for (const double sigma : grid.sigmas) {
        Bilateral bilateral(noisy, sigma);
        int done = 0;
        for (const int normal_iterations : grid.normal_iterations) {
            bilateral.smooth_normals(normal_iterations - std::exchange(done, normal_iterations));
            for (const int vertex_iterations : grid.vertex_iterations) {
                PolygonMesh result = bilateral.fitted(vertex_iterations);
                const double angle = angle_to_truth(truth, result);
                if (angle < least) {
                    least = angle;
                    best = std::move(result);
                }
            }
        }
    }
    return best;
}

}  // namespace seamflow::test
