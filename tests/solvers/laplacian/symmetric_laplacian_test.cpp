#include <limits>
#include <numeric>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "samples/meshes/meshes.h"
#include "solvers/laplacian/kept_stiffness.h"
#include "solvers/laplacian/symmetric_laplacian.h"
#include "tests/support/flows.h"
#include "tests/support/matrices.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

constexpr double stiffness_factor = 0.3;
constexpr std::size_t no_auxiliary = std::numeric_limits<std::size_t>::max();

/// What `assemble` gives, written out, with the product by increments of 1, -1, … along x, y and z.
struct Assembled {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd mass;
    Points product;
};

Assembled assembled(SymmetricLaplacian& laplacian, const Points& positions, bool of_increments_alone)
{
    const std::vector<VertexPair> pairs = laplacian.pairs();
    const Index n = static_cast<Index>(positions.rows()) + laplacian.n_auxiliary();
    std::vector<Index> slots(pairs.size());
    std::iota(slots.begin(), slots.end(), 0);
    std::vector<double> values(pairs.size(), 0.0);
    std::vector<double> diagonal(usize(n));
    std::vector<double> mass(usize(n));
    Points increments(positions.rows(), 3);
    for (Index i = 0; i < increments.size(); ++i)
        increments.data()[i] = i * 29 % 7 - 3.0;
    Assembled result{Eigen::MatrixXd::Zero(n, n), {}, Points::Zero(positions.rows(), 3)};
    const StiffnessProduct product{increments, result.product, of_increments_alone};
    laplacian.assemble(positions, stiffness_factor, slots, values, diagonal, mass, &product);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        result.matrix(pairs[i].first, pairs[i].second) += values[i];
        result.matrix(pairs[i].second, pairs[i].first) += values[i];
    }
    for (Index v = 0; v < n; ++v)
        result.matrix(v, v) += diagonal[v];
    result.mass = Eigen::Map<Eigen::VectorXd>(mass.data(), positions.rows());
    return result;
}

/// K, from which the auxiliary unknowns have been eliminated.
Eigen::MatrixXd eliminated(const Eigen::MatrixXd& matrix, Index n_vertices)
{
    const Index n = static_cast<Index>(matrix.rows()) - n_vertices;
    const Eigen::MatrixXd coupling = matrix.topRightCorner(n_vertices, n);
    const Eigen::VectorXd divisors = matrix.diagonal().tail(n);
    return matrix.topLeftCorner(n_vertices, n_vertices) -
           coupling * divisors.cwiseInverse().asDiagonal() * coupling.transpose();
}

double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
    return (a - b).norm() / b.norm();
}

void check_equal(SymmetricLaplacian& with_auxiliary, SymmetricLaplacian& without, const Points& positions)
{
    REQUIRE(with_auxiliary.n_auxiliary() > 0);
    REQUIRE(without.n_auxiliary() == 0);
    for (const bool of_increments_alone : {false, true}) {
        const Assembled actual = assembled(with_auxiliary, positions, of_increments_alone);
        const Assembled expected = assembled(without, positions, of_increments_alone);
        CHECK(relative_difference(eliminated(actual.matrix, static_cast<Index>(positions.rows())), expected.matrix) <
              1e-12);
        CHECK(relative_difference(actual.product, expected.product) < 1e-12);
        CHECK(relative_difference(actual.mass, expected.mass) < 1e-15);
    }
}

}  // namespace

TEST_CASE("K of faces with auxiliary unknowns is the same as without, kept and weighed, too")
{
    for (const Laplacian laplacian : {Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement})
        for (const PolygonMesh& mesh : {cup(80, 3), make_hexagons(100), make_mixed_polygons(100)}) {
            CAPTURE(name_of(laplacian));
            const Topology topology = make_topology(mesh);
            const FacesOnBothSides faces{{mesh.face_offsets, mesh.face_vertices}, {}, topology.twin, mesh.n_vertices()};
            const auto make = [&](std::size_t most_corners) {
                return make_symmetric_laplacian(laplacian, faces, most_corners);
            };
            check_equal(*make(3), *make(no_auxiliary), mesh.vertices);
            const auto kept = keep_stiffness(make(3), mesh.n_vertices(), mesh.vertices);
            const auto expected = keep_stiffness(make(no_auxiliary), mesh.n_vertices(), mesh.vertices);
            const Points moved = mesh.vertices.array().sin();
            check_equal(*kept, *expected, moved);
            const auto squared = [&](Index v, Index w) { return (moved.row(v) - moved.row(w)).squaredNorm(); };
            for (const double scale : {1.0, 30.0}) {
                kept->weigh([&](Index v, Index w) { return scale * squared(v, w); });
                expected->weigh([&](Index v, Index w) { return scale * squared(v, w); });
                check_equal(*kept, *expected, moved);
            }
            for (const auto& of : {kept.get(), expected.get()})
                of->set_reference(moved);
            check_equal(*kept, *expected, moved);
            // Weights of the positions before leave no trace.
            const auto anew = keep_stiffness(make(no_auxiliary), mesh.n_vertices(), moved);
            for (const auto& of : {kept.get(), anew.get()})
                of->weigh(squared);
            check_equal(*kept, *anew, moved);
        }
}

TEST_CASE("a face of many corners has a few entries for each")
{
    const PolygonMesh mesh = cup(2000, 1);
    const Topology topology = make_topology(mesh);
    const FacesOnBothSides faces{{mesh.face_offsets, mesh.face_vertices}, {}, topology.twin, mesh.n_vertices()};
    for (const Laplacian laplacian : {Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement})
        CHECK(make_symmetric_laplacian(laplacian, faces, most_corners_without_auxiliary)->pairs().size() <
              10 * usize(mesh.n_vertices()));
}
