#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "engine/tasks/parallel_loop.h"
#include "partition/metrics/noise.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/common/meshes.h"

using namespace seamflow;

namespace {

/// Moves every vertex by normal noise of that deviation in each coordinate.
PolygonMesh with_noise(PolygonMesh mesh, double deviation)
{
    std::mt19937 random(11);
    // The sum of twelve even numbers has the variance 1 on any machine's library.
    const auto normal = [&] {
        double sum = -6.0;
        for (int i = 0; i < 12; ++i)
            sum += static_cast<double>(random()) / 4294967296.0;
        return sum;
    };
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        for (const Index axis : {0, 1, 2})
            mesh.vertices(v, axis) += deviation * normal();
    return mesh;
}

double noise_of(const PolygonMesh& mesh)
{
    return estimate_noise(mesh, make_topology(mesh));
}

}  // namespace

TEST_CASE("the noise of a mesh is estimated from itself, on any polygons, curved or with sharp edges")
{
    for (const PolygonMesh& mesh : {make_triangles(20000), make_quads(20000), make_hexagons(20000),
                                    make_mixed_polygons(20000), make_box(20000)}) {
        const double edge = mean_edge_length(mesh);
        for (const double noise : {0.03, 0.1, 0.3})
            CHECK(noise_of(with_noise(mesh, noise * edge)) == doctest::Approx(noise * edge).epsilon(0.2));
        CHECK(noise_of(mesh) < 0.01 * edge);
    }
}

TEST_CASE("the estimate of noise scales with the mesh, turns with it and does not depend on threads")
{
    const PolygonMesh mesh = with_noise(make_box(8000), 0.002);
    const double noise = noise_of(mesh);
    PolygonMesh other = mesh;
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
    other.vertices = (1e6 * mesh.vertices * rotation.transpose()).rowwise() + Eigen::RowVector3d(3e6, -4e5, 7e6);
    CHECK(noise_of(other) == doctest::Approx(1e6 * noise).epsilon(1e-6));
    CHECK(estimate_noise(mesh, make_topology(mesh), run_in_parallel) == noise);
}

TEST_CASE("a mesh without rings to fit to has no noise")
{
    CHECK(noise_of(PolygonMesh{}) == 0.0);
    PolygonMesh triangle;
    triangle.vertices = Points::Random(3, 3);
    triangle.face_offsets = {0, 3};
    triangle.face_vertices = {0, 1, 2};
    CHECK(noise_of(triangle) == 0.0);
    PolygonMesh point = make_box(600);
    point.vertices.setConstant(2.0);
    CHECK(noise_of(point) == 0.0);
}
