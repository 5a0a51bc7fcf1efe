#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include "samples/meshes/meshes.h"
#include "solvers/laplacian/delaunay_stiffness.h"
#include "solvers/laplacian/laplacian_assembler.h"
#include "solvers/laplacian/symmetric_laplacian.h"
#include "tests/support/junction_meshes.h"
#include "tests/support/random_meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::relative;

namespace {

std::optional<DelaunaySurface> delaunay_of(const PolygonMesh& mesh, bool in_faces = false)
{
    Topology topology = make_topology(mesh);
    free_junctions(mesh, topology);
    free_boundary(topology);
    return make_delaunay(mesh, topology, Laplacian::VirtualRefinement, in_faces);
}

Eigen::MatrixXd dense(const GivenStiffness& given)
{
    const Index n = given.neighbours.size();
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
    for (Index v = 0; v < n; ++v)
        for (Index i = given.neighbours.offsets[v]; i < given.neighbours.offsets[v + 1]; ++i) {
            stiffness(v, given.neighbours.values[i]) -= given.weights[i];
            stiffness(v, v) += given.weights[i];
        }
    return stiffness;
}

/// That of Δ_B.
Eigen::MatrixXd stiffness_of(const PolygonMesh& mesh)
{
    const Topology topology = make_topology(mesh);
    const auto laplacian = make_symmetric_laplacian(
        Laplacian::VirtualRefinement,
        {{mesh.face_offsets, mesh.face_vertices}, {}, topology.twin, mesh.n_vertices(), Contributions::OwnFaces});
    const auto pairs = laplacian->pairs();
    std::vector<Index> slots(pairs.size());
    std::iota(slots.begin(), slots.end(), 0);
    std::vector<double> values(pairs.size(), 0.0);
    std::vector<double> diagonal(usize(mesh.n_vertices()));
    std::vector<double> mass(diagonal.size());
    laplacian->assemble(mesh.vertices, 1.0, slots, values, diagonal, mass);
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(mesh.n_vertices(), mesh.n_vertices());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        stiffness(pairs[i].first, pairs[i].second) += values[i];
        stiffness(pairs[i].second, pairs[i].first) += values[i];
    }
    stiffness.diagonal() = Eigen::Map<Eigen::VectorXd>(diagonal.data(), mesh.n_vertices());
    return stiffness;
}

/// Moves vertices of a flat grid at random, and then all along x, the more the greater y is.
PolygonMesh sheared(PolygonMesh mesh, double shear)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(-0.2, 0.2);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        mesh.vertices(v, 0) += part(random);
        mesh.vertices(v, 1) += part(random);
        mesh.vertices(v, 0) += shear * mesh.vertices(v, 1);
    }
    return mesh;
}

double whole_area(const PolygonMesh& mesh)
{
    double sum = 0.0;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        sum += area(mesh.face(f), mesh.vertices);
    return sum;
}

/// Bent along lines across its edges, which keeps lengths within it.
PolygonMesh rolled(const PolygonMesh& flat)
{
    PolygonMesh mesh = flat;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const double angle = flat.vertices(v, 0) / 3.0;
        mesh.vertices.row(v) << 3.0 * std::sin(angle), flat.vertices(v, 1), 3.0 * std::cos(angle);
    }
    return mesh;
}

}  // namespace

TEST_CASE("weights of any surface become at least 0, K no stiffer than it was, and M has its area")
{
    const std::vector<test::NamedMesh> meshes{
        {"sheared", sheared(test::triangle_grid(9, 7), 3.0), {}},
        {"rolled", rolled(sheared(test::triangle_grid(12, 7), 1.5)), {}},
        {"Möbius band", sheared(test::moebius_band(12, 3), 0.0), {}},
        {"turned round", test::with_faces_flipped(sheared(test::triangle_grid(9, 7), 3.0), 3), {}},
        {"polygons", sheared(test::hexagon_sheet(6, 5), 2.0), {}},
        {"sheets that meet", sheared(test::three_wings(), 4.0), {}}};
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (const test::NamedMesh& one : meshes) {
        CAPTURE(one.name);
        const PolygonMesh& mesh = one.mesh;
        const auto surface = delaunay_of(mesh);
        REQUIRE(surface);
        const GivenStiffness& given = surface->stiffness;
        CHECK(std::ranges::min(given.weights) >= 0.0);
        const Eigen::MatrixXd stiffness = dense(given);
        CHECK(stiffness == stiffness.transpose());
        const double area = std::accumulate(given.mass.begin(), given.mass.end(), 0.0);
        const bool is_polygonal = mesh.n_corners() != 3 * mesh.n_faces();
        CHECK(area == relative(whole_area(mesh), is_polygonal ? 0.1 : 1e-12));
        CHECK(surface->mesh.n_faces() == mesh.n_corners() - 2 * mesh.n_faces());
        CHECK(std::ranges::is_sorted(surface->face_of));
        // Of all triangulations within a surface, a Delaunay one has the least energy (Rippa 1990).
        const Eigen::MatrixXd before = stiffness_of(mesh);
        for (int i = 0; i < 20 && !is_polygonal; ++i) {
            const Eigen::VectorXd u =
                Eigen::VectorXd::NullaryExpr(mesh.n_vertices(), [&](Eigen::Index) { return normal(random); });
            CHECK(u.dot(stiffness * u) <= (1.0 + 1e-12) * u.dot(before * u));
        }
    }
}

TEST_CASE("linear functions on a plane are harmonic away from the boundary")
{
    const PolygonMesh mesh = sheared(test::triangle_grid(16, 12), 2.5);
    const auto surface = delaunay_of(mesh);
    REQUIRE(surface);
    const Eigen::MatrixXd product = dense(surface->stiffness) * mesh.vertices.leftCols(2);
    for (Index i = 4; i < 13; ++i)
        for (Index j = 4; j < 9; ++j)
            CHECK(product.row(j * 17 + i).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a triangulation within a surface does not depend on the order of faces and vertices")
{
    const PolygonMesh mesh = rolled(sheared(test::triangle_grid(12, 7), 1.5));
    const auto [shuffled, number] = test::shuffled(mesh, 3);
    const PolygonMesh other = test::with_faces_flipped(shuffled, 3);
    const Eigen::MatrixXd of_mesh = dense(delaunay_of(mesh)->stiffness);
    const Eigen::MatrixXd of_other = dense(delaunay_of(other)->stiffness);
    CHECK((of_other(number, number) - of_mesh).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("surfaces whose weights are at least 0 stay as they are, and so do weights that nothing depends on")
{
    CHECK_FALSE(delaunay_of(test::triangle_grid(5, 4)));
    CHECK_FALSE(delaunay_of(test::quad_grid(5, 4)));
    CHECK_FALSE(delaunay_of(test::hexagon_sheet(4, 4)));
    // An edge that is Delaunay, between an obtuse angle and an acute one.
    PolygonMesh kite;
    kite.vertices.resize(4, 3);
    kite.vertices << 0, 0, 0, 1, 0, 0, 0.5, 0.4, 0, 0.5, -1, 0;
    kite.add_face(std::array<Index, 3>{0, 1, 2});
    kite.add_face(std::array<Index, 3>{1, 0, 3});
    CHECK_FALSE(delaunay_of(kite));
    REQUIRE(delaunay_of(kite, true));
    CHECK((dense(delaunay_of(kite, true)->stiffness) - stiffness_of(kite)).cwiseAbs().maxCoeff() < 1e-15);

    // At a boundary that is held, its own edges have no part in any equation.
    const PolygonMesh triangle = [] {
        PolygonMesh mesh;
        mesh.vertices.resize(4, 3);
        mesh.vertices << 0, 0, 0, 1, 0, 0, 0.5, 0.8, 0, 0.5, 0.1, 0;
        for (Index k = 0; k < 3; ++k)
            mesh.add_face(std::array{k, (k + 1) % 3, Index{3}});
        return mesh;
    }();
    CHECK(delaunay_of(triangle));
    CHECK_FALSE(make_delaunay(triangle, make_topology(triangle), Laplacian::VirtualRefinement, false));
}

TEST_CASE("rectangles much longer than wide have the weights of five points")
{
    PolygonMesh mesh = test::quad_grid(6, 6);
    mesh.vertices.col(0) *= 4.0;
    const auto surface = delaunay_of(mesh);
    REQUIRE(surface);
    const Eigen::MatrixXd stiffness = dense(surface->stiffness);
    const Index v = 3 * 7 + 3;
    CHECK(stiffness(v, v + 1) == relative(-0.25, 1e-9));
    CHECK(stiffness(v, v - 7) == relative(-4.0, 1e-9));
    CHECK(std::abs(stiffness(v, v + 8)) + std::abs(stiffness(v, v + 6)) < 1e-9);
}

TEST_CASE("an obtuse triangle at the boundary leads along it as before, and its weights are no longer below 0")
{
    PolygonMesh mesh;
    mesh.vertices.resize(3, 3);
    mesh.vertices << 0, 0, 0, 5, 0, 0, 2, 0.5, 0;
    mesh.add_face(std::array<Index, 3>{0, 1, 2});
    const auto surface = delaunay_of(mesh);
    REQUIRE(surface);
    const Eigen::MatrixXd stiffness = dense(surface->stiffness);
    // Two conductors of half its height.
    CHECK(stiffness(0, 2) == relative(-0.5 / (2.0 * 2.0), 1e-12));
    CHECK(stiffness(1, 2) == relative(-0.5 / (2.0 * 3.0), 1e-12));
    CHECK(stiffness(0, 1) == 0.0);
    const Eigen::VectorXd x = mesh.vertices.col(0);
    CHECK(x.dot(stiffness * x) == relative(whole_area(mesh), 1e-12));
}
