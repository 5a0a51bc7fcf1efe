// The width of the kernel that fields are smoothed by.

#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "engine/diffuse.h"
#include "engine/fields/white_noise.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::relative;

TEST_CASE("a spike becomes as wide as it was asked to, on faces of any form")
{
    // The second moment grows by 4 t.
    for (const PolygonMesh& mesh : {make_triangles(1500), make_quads(1500), make_hexagons(1500)}) {
        PolygonMesh flat = mesh;
        flat.vertices.col(2).setZero();
        const Point middle = 0.5 * (flat.vertices.colwise().maxCoeff() + flat.vertices.colwise().minCoeff());
        Eigen::Index v = 0;
        (flat.vertices.rowwise() - middle).rowwise().squaredNorm().minCoeff(&v);
        Eigen::MatrixXd spike = Eigen::MatrixXd::Zero(flat.n_vertices(), 1);
        spike(v, 0) = 1.0;
        const double fwhm = 5.0 * mean_edge_length(flat);
        diffuse(flat, spike, {.steps = 4}, {.fwhm = fwhm});
        const Eigen::VectorXd squares = (flat.vertices.rowwise() - flat.vertices.row(v)).rowwise().squaredNorm();
        const double moment = spike.col(0).dot(squares) / spike.sum();
        CHECK(moment == relative(4.0 * time_for_fwhm(fwhm, {.steps = 4}), 0.02));
    }
}

TEST_CASE("a remark tells why the width that a diffusion reaches is far from that asked for")
{
    const PolygonMesh mesh = make_noisy_sphere(20000, {.amplitude = 0.0, .noise = 0.0});
    const double edge = mean_edge_length(mesh);
    const auto remarks_at = [&](double fwhm, int steps) {
        Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(mesh.n_vertices(), 1);
        const FieldReport report = diffuse(mesh, fields, {.steps = steps}, {.fwhm = fwhm});
        return report.remarks.empty() ? std::string() : sentence(report.remarks.front());
    };
    CHECK(remarks_at(8.0 * edge, 10).empty());
    CHECK(remarks_at(8.0 * edge, 1).find("more steps come nearer") != std::string::npos);
    CHECK(remarks_at(0.2 * edge, 10).find("less than four mean edge lengths") != std::string::npos);
    CHECK(remarks_at(400.0 * edge, 10).find("wide for this surface") != std::string::npos);
    Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(mesh.n_vertices(), 1);
    FlowOptions of_order{.steps = 10};
    of_order.order = 3;
    const FieldReport report = diffuse(mesh, fields, of_order, {.fwhm = 8.0 * edge});
    REQUIRE_FALSE(report.remarks.empty());
    CHECK(sentence(report.remarks.front()).find("filter diffusion of order 1") != std::string::npos);
}

TEST_CASE("the width that a diffusion reaches is the one asked for, in any number of steps but one")
{
    for (const Index n : {10000, 30000}) {
        const PolygonMesh mesh = make_noisy_sphere(n, {.amplitude = 0.0, .noise = 0.0});
        for (const double edges : {6.0, 10.0})
            for (const int steps : {2, 10, 40}) {
                CAPTURE(n);
                CAPTURE(edges);
                CAPTURE(steps);
                const double fwhm = edges * mean_edge_length(mesh);
                Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(mesh.n_vertices(), 1);
                const FieldReport report = diffuse(mesh, fields, {.steps = steps}, {.fwhm = fwhm});
                REQUIRE(report.fwhm);
                // From 0.95 in two steps to 0.99: without the part (m - 1) / m, two steps reach 0.68.
                CHECK(*report.fwhm == relative(0.97 * fwhm, 0.025));
            }
    }
    CHECK(time_for_fwhm(2.0, {.steps = 0}) == relative(4.0 / (16.0 * std::numbers::ln2), 1e-15));
    CHECK(time_for_fwhm(2.0, {.steps = 5}) == relative(5.0 / (16.0 * std::numbers::ln2), 1e-15));
    FlowOptions second_order{.steps = 5};
    second_order.order = 2;
    CHECK(time_for_fwhm(2.0, second_order) == relative(4.0 / (16.0 * std::numbers::ln2), 1e-15));
    for (const int steps : {0, 1, 2, 10})
        CHECK(fwhm_for_time(time_for_fwhm(0.3, {.steps = steps}), {.steps = steps}) == relative(0.3, 1e-15));
}

TEST_CASE("white noise has no width, and its numbers a variance of 1")
{
    const PolygonMesh mesh = test::triangle_torus(60, 60);
    const Eigen::MatrixXd noise = white_noise(mesh.n_vertices());
    CHECK(std::abs(noise.mean()) < 0.03);
    CHECK((noise.array() - noise.mean()).square().mean() == relative(1.0, 0.03));
    CHECK_FALSE(fwhm_of_noise(mesh, Eigen::MatrixXd::Ones(mesh.n_vertices(), 3)));
}

TEST_CASE("the width of noise is that of its correlation along edges, whatever its mean is")
{
    // Edges of length 1, 5 and √26, as many of each.
    PolygonMesh mesh = test::triangle_grid(30, 30);
    mesh.vertices.col(0) *= 5.0;
    Eigen::MatrixXd noise = white_noise(mesh.n_vertices());
    diffuse(mesh, noise, {.time_step = 3.0}, {.laplacian = Laplacian::Uniform});
    const Eigen::RowVectorXd means = noise.colwise().mean();
    double n = 0.0;
    double lengths = 0.0;
    Eigen::RowVectorXd squares = Eigen::RowVectorXd::Zero(3);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = mesh.face(f)[k];
            const Index w = mesh.face(f)[(k + 1) % 3];
            n += 1.0;
            lengths += (mesh.vertices.row(v) - mesh.vertices.row(w)).squaredNorm();
            squares += (noise.row(v) - noise.row(w)).cwiseAbs2();
        }
    const Eigen::RowVectorXd variances = (noise.rowwise() - means).cwiseAbs2().colwise().mean();
    const Eigen::ArrayXd correlations = 1.0 - squares.array() / n / (2.0 * variances.array());
    const double expected = std::sqrt(lengths / n) * (-2.0 * std::numbers::ln2 / correlations.log()).sqrt().mean();
    CHECK(fwhm_of_noise(mesh, noise).value() == relative(expected, 1e-9));
    CHECK(fwhm_of_noise(mesh, noise.array() + 7.0).value() == relative(expected, 1e-9));
}
