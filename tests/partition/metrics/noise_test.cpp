#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/noise.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/denoising.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

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

/// Rings of vertices around the z axis, closed by a face or a vertex at either end.
/// @param profile radius and height of each ring; radius 0: a vertex.
PolygonMesh turned(const std::vector<std::array<double, 2>>& profile, Index sides)
{
    PolygonMesh mesh;
    std::vector<std::vector<Index>> rings;
    std::vector<Eigen::RowVector3d> points;
    for (const auto& [radius, height] : profile) {
        rings.emplace_back();
        for (Index i = 0; i < (radius > 0.0 ? sides : 1); ++i) {
            const double angle = 2.0 * std::numbers::pi * i / sides;
            rings.back().push_back(static_cast<Index>(points.size()));
            points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
        }
    }
    mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
        mesh.vertices.row(static_cast<Eigen::Index>(i)) = points[i];
    if (rings.front().size() > 1)
        mesh.add_face(std::vector<Index>(rings.front().rbegin(), rings.front().rend()));
    for (std::size_t k = 1; k < rings.size(); ++k)
        for (Index i = 0; i < sides; ++i) {
            const auto& low = rings[k - 1];
            const auto& high = rings[k];
            const Index next = (i + 1) % sides;
            if (low.size() == 1)
                mesh.add_face(std::vector<Index>{low[0], high[next], high[i]});
            else if (high.size() == 1)
                mesh.add_face(std::vector<Index>{low[i], low[next], high[0]});
            else
                mesh.add_face(std::vector<Index>{low[i], low[next], high[next], high[i]});
        }
    if (rings.back().size() > 1)
        mesh.add_face(rings.back());
    return mesh;
}

PolygonMesh uv_sphere(Index sides, Index stacks)
{
    std::vector<std::array<double, 2>> profile;
    for (Index k = 0; k <= stacks; ++k) {
        const double angle = std::numbers::pi * k / stacks;
        profile.push_back({k % stacks == 0 ? 0.0 : std::sin(angle), -std::cos(angle)});
    }
    return turned(profile, sides);
}

/// A tube of `stacks` rings of faces of height 1.
PolygonMesh prism(Index sides, Index stacks)
{
    std::vector<std::array<double, 2>> profile;
    for (Index k = 0; k <= stacks; ++k)
        profile.push_back({1.0, static_cast<double>(k)});
    return turned(profile, sides);
}

}  // namespace

TEST_CASE("the noise of a mesh is estimated from itself, on any polygons, curved or with sharp edges")
{
    for (const PolygonMesh& mesh :
         {make_triangles(20000), make_quads(20000), make_hexagons(20000), make_mixed_polygons(20000), make_box(20000),
          make_box(3000), make_gear(20000), make_stepped_cylinder(20000, {.faces = PartFaces::Quads}),
          make_cylinder(20000), make_noisy_sphere(5000, {.noise = 0.0}), uv_sphere(96, 48)}) {
        CAPTURE(mesh.n_vertices());
        const double edge = mean_edge_length(mesh);
        for (const double noise : {0.03, 0.06, 0.12, 0.17}) {
            CAPTURE(noise);
            CHECK(std::abs(noise_of(with_noise(mesh, noise * edge)) / (noise * edge) - 1.0) < 0.15);
        }
        // Along random directions, by normally distributed lengths.
        CHECK(std::abs(noise_of(test::with_gaussian_noise(mesh, 0.2, 3)) / (0.2 / std::sqrt(3.0) * edge) - 1.0) < 0.15);
        CHECK(noise_of(mesh) == 0.0);
    }
}

TEST_CASE("surfaces without noise have none, however coarse they are and however sharply they bend")
{
    for (const MeshKind& kind : mesh_kinds())
        for (const Index vertices : {400, 900, 3000, 20000}) {
            // Steps of voxels are noise.
            if (kind.has_cells)
                continue;
            MeshVariation clean;
            if (kind.name == "noisy-sphere")
                clean.noise = 0.0;
            const PolygonMesh mesh = make_mesh(kind.name, vertices, clean);
            CAPTURE(kind.name);
            CAPTURE(vertices);
            CHECK(noise_of(mesh) < 0.01 * mean_edge_length(mesh));
        }
    for (const Index sides : {3, 4, 5, 6, 8, 12, 48, 96})
        for (const Index stacks : {2, 3, 6, 12, 24, 100}) {
            CAPTURE(sides);
            CAPTURE(stacks);
            CHECK(noise_of(uv_sphere(sides, stacks)) == 0.0);
            CHECK(noise_of(prism(sides, stacks)) == 0.0);
        }
}

TEST_CASE("meshes of few vertices have no noise, whatever they look like")
{
    for (const Index sides : {3, 4, 5, 6, 8, 12}) {
        for (const PolygonMesh& mesh :
             {turned({{1.0, 0.0}, {0.0, 1.0}}, sides), turned({{0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}}, sides),
              prism(sides, 1), prism(sides, 3), uv_sphere(sides, 4)}) {
            CHECK(noise_of(mesh) == 0.0);
            CHECK(noise_of(with_noise(mesh, 0.1)) == 0.0);
        }
    }
}

TEST_CASE("what is as large as the edges is not believed to be noise")
{
    const PolygonMesh mesh = make_noisy_sphere(5000, {.noise = 0.0});
    CHECK(noise_of(with_noise(mesh, 0.9 * mean_edge_length(mesh))) == 0.0);
}

TEST_CASE("the estimate of noise scales with the mesh, turns with it and does not depend on threads")
{
    const PolygonMesh mesh = with_noise(make_box(8000), 0.002);
    const double noise = noise_of(mesh);
    REQUIRE(noise > 0.0);
    PolygonMesh other = mesh;
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
    other.vertices = (1e6 * mesh.vertices * rotation.transpose()).rowwise() + Eigen::RowVector3d(3e6, -4e5, 7e6);
    CHECK(noise_of(other) / (1e6 * noise) == test::relative(1.0, 1e-6));
    CHECK(estimate_noise(mesh, make_topology(mesh), run_in_parallel) == noise);
    for (const double scale : {0x1p-40, 0x1p30}) {
        other.vertices = scale * mesh.vertices;
        CHECK(noise_of(other) == scale * noise);
    }
}

TEST_CASE("the estimate of noise hardly depends on the order of vertices, nor on whether there are two of a mesh")
{
    for (const Index vertices : {3000, 15000}) {
        const PolygonMesh mesh = make_triangles(vertices);
        const double deviation = 0.1 * mean_edge_length(mesh);
        const PolygonMesh noisy = with_noise(mesh, deviation);
        std::vector<Index> order(at(noisy.n_vertices()));
        std::iota(order.begin(), order.end(), Index{0});
        std::shuffle(order.begin(), order.end(), std::mt19937(5));
        PolygonMesh shuffled = noisy;
        for (Index v = 0; v < noisy.n_vertices(); ++v)
            shuffled.vertices.row(order[v]) = noisy.vertices.row(v);
        for (Index& v : shuffled.face_vertices)
            v = order[v];
        CHECK(std::abs(noise_of(shuffled) / noise_of(noisy) - 1.0) < 0.1);
        CHECK(std::abs(noise_of(test::side_by_side({noisy, noisy})) / noise_of(noisy) - 1.0) < 0.1);
    }
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
