#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/metrics/fast_marching.h"
#include "partition/metrics/feathered.h"
#include "samples/meshes/random_numbers.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

std::vector<Index> vertices_left_of(const PolygonMesh& mesh, double x)
{
    return select(run_serially, mesh.n_vertices(), [&](Index v) { return mesh.vertices(v, 0) <= x; });
}

std::vector<double> strengths_right_of(const PolygonMesh& mesh, double x)
{
    std::vector<double> strength;
    for (const auto& row : mesh.vertices.rowwise())
        strength.push_back(row.x() > x ? 1.0 : 0.0);
    return strength;
}

double rise(double t)
{
    t = std::min(t, 1.0);
    return 10.0 * std::pow(t, 3) - 15.0 * std::pow(t, 4) + 6.0 * std::pow(t, 5);
}

}  // namespace

TEST_CASE("distances from a straight rim are exact on flat grids, and infinite beyond the limit")
{
    for (const PolygonMesh& mesh : {triangle_grid(12, 9), quad_grid(12, 9)}) {
        const std::vector<double> distances =
            distances_from(mesh, make_topology(mesh), vertices_left_of(mesh, 3.0), 6.5);
        for (Index v = 0; v < mesh.n_vertices(); ++v) {
            const double expected = std::max(mesh.vertices(v, 0) - 3.0, 0.0);
            if (expected > 6.5)
                CHECK(distances[usize(v)] == std::numeric_limits<double>::infinity());
            else
                CHECK(std::abs(distances[usize(v)] - expected) < 1e-12);
        }
    }
}

TEST_CASE("distances from a point are at least straight, and at most a quarter longer than that, on a scattered mesh")
{
    PolygonMesh mesh = triangle_grid(40, 40);
    RandomNumbers random(3);
    for (auto row : mesh.vertices.rowwise())
        row.head<2>() += 0.2 * Eigen::RowVector2d(random.symmetric(), random.symmetric());
    const std::vector<Index> source{20 * 41 + 20};
    const std::vector<double> distances =
        distances_from(mesh, make_topology(mesh), source, std::numeric_limits<double>::infinity());
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const double straight = (mesh.vertices.row(v) - mesh.vertices.row(source.front())).norm();
        CHECK(distances[usize(v)] > straight - 1e-9);
        CHECK(distances[usize(v)] <= 1.25 * straight);
    }
}

TEST_CASE("strength rises smoothly from the rim of a region, and not from the boundary of the mesh")
{
    const PolygonMesh mesh = quad_grid(20, 5);
    std::vector<double> strength = strengths_right_of(mesh, 4.5);
    for (double& s : strength)
        s *= 0.75;
    const std::vector<double> soft = feathered(mesh, strength, 8.0);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        CHECK(std::abs(soft[usize(v)] - 0.75 * rise(std::max(mesh.vertices(v, 0) - 4.0, 0.0) / 8.0)) < 1e-12);
    CHECK(feathered(mesh, strength, 0.0) == strength);
    const std::vector<double> everywhere(strength.size(), 1.0);
    CHECK(feathered(mesh, everywhere, 3.0) == everywhere);
}

TEST_CASE("the distance from the rim continues across the seams of a texture, whose copies have one strength")
{
    const PolygonMesh whole = quad_grid(20, 5);
    const std::vector<Index> labels = halves(whole, 6.5);
    const PolygonMesh mesh = split(whole, labels);
    REQUIRE(mesh.n_vertices() > whole.n_vertices());
    const std::vector<double> soft = feathered(mesh, strengths_right_of(mesh, 4.5), 8.0);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        CHECK(std::abs(soft[usize(v)] - rise(std::max(mesh.vertices(v, 0) - 4.0, 0.0) / 8.0)) < 1e-12);
    // A rim that is a seam itself is seen from the other side.
    std::vector<double> one_side(usize(mesh.n_vertices()), 0.0);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (const Index v : mesh.face(f))
            one_side[usize(v)] = labels[usize(f)] == 1 ? 1.0 : one_side[usize(v)];
    const std::vector<double> from_seam = feathered(mesh, one_side, 8.0);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        CHECK(std::abs(from_seam[usize(v)] - rise(std::max(mesh.vertices(v, 0) - 7.0, 0.0) / 8.0)) < 1e-12);
}

TEST_CASE("strengths that do not fit, and lengths that are none, are refused")
{
    const PolygonMesh mesh = quad_grid(2, 2);
    CHECK_THROWS_WITH_AS(feathered(mesh, {1.0, 0.0}, 1.0),
                         "there are 2 strengths, but the mesh has 9 vertices: give one for each", InputError);
    CHECK_THROWS_AS(feathered(mesh, std::vector<double>(9, 1.0), -1.0), OptionError);
    CHECK_THROWS_AS(feathered(mesh, std::vector<double>(9, 1.0), std::numeric_limits<double>::infinity()), OptionError);
}
