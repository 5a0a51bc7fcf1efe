#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "solvers/estimate/error_equation.h"
#include "solvers/interface/interface_ranks.h"
#include "tests/support/backwards.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/matrices.h"

using namespace seamflow;

namespace {

struct Case {
    test::CutMesh cut;
    Decomposition decomposition = test::decompose(cut);
};

Case in_two(const std::string& name, PolygonMesh mesh, double middle)
{
    return {test::cut_by_place(name, std::move(mesh),
                               [=](const Point& centroid) { return centroid.x() < middle ? 0 : 1; })};
}

/// On a flat grid of 24 by 24, Γ in the middle.
std::vector<Case> cases()
{
    std::vector<Case> all;
    all.push_back(in_two("quads", test::quad_grid(24, 24), 12.1));
    all.push_back(in_two("triangles", test::triangle_grid(24, 24), 12.1));
    return all;
}

/// Vᵏ + A⁻¹ r with r on Γ alone, a wave of so many half lengths along Γ, in the direction of z: flat meshes rest, so
/// that this is a result with the error A⁻¹ r.
Points disturbed(const Case& c, Laplacian laplacian, double time_step, double half_waves)
{
    const auto& [name, mesh, topology, labels, n_parts] = c.cut;
    const Index n = mesh.n_vertices();
    Eigen::MatrixXd system =
        Eigen::MatrixXd::Identity(n, n) + time_step * test::dense_laplacian(laplacian, mesh, topology);
    for (Index v = 0; v < n; ++v)
        if (topology.kind[v] != VertexKind::Interior)
            system.row(v) = Eigen::RowVectorXd::Unit(n, v);
    Eigen::VectorXd residual = Eigen::VectorXd::Zero(n);
    const SubMesh& sub_mesh = c.decomposition.sub_meshes[0];
    for (const Index i : sub_mesh.interface.vertices) {
        const Index v = sub_mesh.local_to_global[i];
        residual(v) = std::sin(M_PI * half_waves * mesh.vertices(v, 1) / 24.0);
    }
    Points after = mesh.vertices;
    after.col(2) += system.partialPivLu().solve(residual);
    return after;
}

void assemble(const Case& c, const Points& after, double time_step, ErrorEquation& equation)
{
    for (Index s = 0; s < 2; ++s) {
        const SubMesh& sub_mesh = c.decomposition.sub_meshes[s];
        const Points before = test::localised(sub_mesh, c.cut.mesh.vertices);
        equation.assemble(s, before, test::localised(sub_mesh, after), before, time_step);
    }
}

/// The highest wave numbers are those that Δ_A on quads, and Δ_P, hardly see: there the error is underestimated.
std::vector<double> half_waves_seen_by(Laplacian laplacian, const Case& c)
{
    if (laplacian == Laplacian::PtackovaVelho)
        return {1.0, 4.0};
    if (laplacian == Laplacian::AlexaWardetzky && c.cut.name == "quads")
        return {1.0, 4.0, 8.0, 12.0};
    return {1.0, 4.0, 8.0, 12.0, 23.0};
}

}  // namespace

TEST_CASE("the error on Γ is found from the residual, smooth and rough")
{
    for (const Case& c : cases())
        for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::PtackovaVelho})
            for (const double time_step : {0.5, 4.0, 16.0})
                for (const double half_waves : half_waves_seen_by(laplacian, c)) {
                    CAPTURE(c.cut.name);
                    CAPTURE(name_of(laplacian));
                    CAPTURE(time_step);
                    CAPTURE(half_waves);
                    const Points after = disturbed(c, laplacian, time_step, half_waves);
                    const double expected = after.col(2).cwiseAbs().maxCoeff();
                    OneRank ranks(2);
                    ErrorEquation equation(c.decomposition, c.cut.mesh, c.cut.topology, laplacian, ranks);
                    assemble(c, after, time_step, equation);
                    if (laplacian == Laplacian::PtackovaVelho)
                        equation.measure_whole_rows(c.cut.mesh, c.cut.topology, c.cut.mesh.vertices, after, time_step,
                                                    run_serially);
                    equation.solve(run_serially);
                    const double found = equation.error().rowwise().norm().maxCoeff();
                    CHECK(found < 2.5 * expected);
                    CHECK(found > 0.4 * expected);
                }
}

TEST_CASE("normals on Γ do not depend on how single faces are oriented")
{
    const auto normals_of = [](PolygonMesh mesh, Laplacian laplacian) {
        mesh.vertices.col(2) = 0.1 * mesh.vertices.col(0).cwiseProduct(mesh.vertices.col(1));
        const Case c = in_two("bent", std::move(mesh), 3.1);
        OneRank ranks(2);
        ErrorEquation equation(c.decomposition, c.cut.mesh, c.cut.topology, laplacian, ranks);
        assemble(c, c.cut.mesh.vertices, 1.0, equation);
        Points normals(equation.size(), 3);
        for (Index i = 0; i < equation.size(); ++i)
            normals.row(i) = equation.normal(i);
        return normals;
    };
    for (const PolygonMesh& mesh : {test::quad_grid(7, 7), test::triangle_grid(7, 7)})
        for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky}) {
            PolygonMesh turned = mesh;
            for (Index f = 1; f < turned.n_faces(); f += 3)
                std::reverse(turned.face_vertices.begin() + turned.face_offsets[f],
                             turned.face_vertices.begin() + turned.face_offsets[f + 1]);
            const Points expected = normals_of(mesh, laplacian);
            const Points found = normals_of(turned, laplacian);
            CHECK(expected.rows() == 6);
            REQUIRE(found.rows() == expected.rows());
            // Of either sign.
            CHECK((found.cwiseProduct(expected).rowwise().sum().cwiseAbs().array() > 1.0 - 1e-12).all());
        }
}

TEST_CASE("the order of the loop does not matter")
{
    for (const Case& c : cases()) {
        const Points after = disturbed(c, Laplacian::AlexaWardetzky, 4.0, 3.0);
        OneRank ranks(2);
        ErrorEquation forward(c.decomposition, c.cut.mesh, c.cut.topology, Laplacian::AlexaWardetzky, ranks);
        ErrorEquation backward(c.decomposition, c.cut.mesh, c.cut.topology, Laplacian::AlexaWardetzky, ranks);
        assemble(c, after, 4.0, forward);
        assemble(c, after, 4.0, backward);
        forward.solve(run_serially);
        backward.solve(test::run_backwards);
        CHECK(forward.error() == backward.error());
    }
}

TEST_CASE("without Γ there is nothing to solve")
{
    const PolygonMesh mesh = test::quad_grid(4, 4);
    const Topology topology = make_topology(mesh);
    const std::vector<Index> labels(mesh.n_faces(), 0);
    const Decomposition decomposition = decompose(mesh, topology, labels, 1);
    OneRank ranks(1);
    ErrorEquation equation(decomposition, mesh, topology, Laplacian::PtackovaVelho, ranks);
    equation.solve(run_serially);
    CHECK(equation.size() == 0);
}
