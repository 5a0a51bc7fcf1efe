#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diffuse.h"
#include "engine/surface/flowing_mesh.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "solvers/laplacian/delaunay_stiffness.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::relative;

namespace {

/// With long triangles that lean.
PolygonMesh leaning(PolygonMesh mesh, double bumps = 0.0)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> part(-0.25, 0.25);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        mesh.vertices.row(v) += Point(part(random), part(random), bumps * part(random));
        mesh.vertices(v, 0) += 3.0 * mesh.vertices(v, 1);
    }
    return mesh;
}

Eigen::MatrixXd steps_of_zero_and_one(Index n, Eigen::Index columns)
{
    std::mt19937 random(4);
    return Eigen::MatrixXd::NullaryExpr(n, columns, [&] { return random() % 2 == 0 ? 0.0 : 1.0; });
}

FlowOptions amount(const PolygonMesh& mesh, double squared_edges, int steps)
{
    const double edge = mean_edge_length(mesh);
    return {.time_step = squared_edges * edge * edge, .steps = steps};
}

/// By a dense matrix.
Eigen::MatrixXd reference(const PolygonMesh& mesh, Eigen::MatrixXd fields, const FlowOptions& options)
{
    Topology topology = make_topology(mesh);
    free_boundary(topology);
    GivenStiffness given = make_delaunay(mesh, topology, Laplacian::VirtualRefinement, false)->stiffness;
    // Of vertices without faces.
    std::ranges::replace(given.mass, 0.0, 1.0);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(mesh.n_vertices(), mesh.n_vertices());
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        matrix(v, v) += given.mass[v];
        for (Index i = given.neighbours.offsets[v]; i < given.neighbours.offsets[v + 1]; ++i) {
            matrix(v, v) += options.time_step * given.weights[i];
            matrix(v, given.neighbours.values[i]) -= options.time_step * given.weights[i];
        }
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> factor(matrix);
    const Eigen::Map<const Eigen::VectorXd> mass(given.mass.data(), mesh.n_vertices());
    for (int step = 0; step < options.steps; ++step)
        fields = factor.solve(mass.asDiagonal() * fields);
    return fields;
}

}  // namespace

TEST_CASE("fields stay in their range on any faces, and every solver takes the same steps")
{
    for (const PolygonMesh& mesh : {leaning(test::triangle_grid(30, 12), 1.0), leaning(test::quad_grid(24, 10)),
                                    leaning(test::hexagon_sheet(14, 8), 0.5)})
        for (const auto& [squared_edges, n_steps] : {std::pair{0.01, 1}, {0.01, 5}, {5.0, 2}}) {
            FlowOptions options = amount(mesh, squared_edges, n_steps);
            const Eigen::MatrixXd before = steps_of_zero_and_one(mesh.n_vertices(), 4);
            const Eigen::MatrixXd expected = reference(mesh, before, options);
            CHECK(expected.minCoeff() > -1e-12);
            CHECK(expected.maxCoeff() < 1.0 + 1e-12);
            options.accuracy.tolerance = 1e-10;
            for (const auto& [approach, subdomains] :
                 {std::pair{Approach::Converged, 5}, {Approach::Undecomposed, 1}, {Approach::ConjugateGradients, 1}}) {
                options.accuracy.approach = approach;
                options.cut.subdomains = subdomains;
                if (approach == Approach::Undecomposed)
                    options.accuracy.tolerance.reset();
                else
                    options.accuracy.tolerance = 1e-10;
                Eigen::MatrixXd fields = before;
                diffuse(mesh, fields, options);
                CHECK((fields - expected).cwiseAbs().maxCoeff() < 1e-8);
                CHECK(fields.minCoeff() >= 0.0);
                CHECK(fields.maxCoeff() <= 1.0);
            }
        }
}

TEST_CASE("fields stay in their range where edges of theirs are kept, some are held, and others are filled")
{
    const PolygonMesh mesh = leaning(test::triangle_grid(30, 12), 1.0);
    FlowOptions options = amount(mesh, 0.3, 4);
    options.motion.fixed_vertices = {5, 100, 200};
    Eigen::MatrixXd before = steps_of_zero_and_one(mesh.n_vertices(), 2);
    for (Index v = 0; v < mesh.n_vertices(); v += 5)
        before.row(v).setConstant(std::numeric_limits<double>::quiet_NaN());
    for (const FieldOptions& of_fields :
         {FieldOptions{.fill = true}, {.keep_edges = 0.5, .fill = true}, {.fill = true, .boundary = Boundary::Fixed}}) {
        Eigen::MatrixXd fields = before;
        const FieldReport report = diffuse(mesh, fields, options, of_fields);
        CHECK(report.filled > 0);
        CHECK(fields.minCoeff() >= 0.0);
        CHECK(fields.maxCoeff() <= 1.0);
        // Of data that have one value alone, no weight says anything.
        fields = (before.array() * 0.0 + 0.1).matrix();
        diffuse(mesh, fields, options, of_fields);
        CHECK((fields.array() == 0.1).all());
    }
}

TEST_CASE("fields diffuse across seams of long triangles as without them, with labels of faces as they were given")
{
    const PolygonMesh whole = leaning(test::quad_grid(20, 10));
    std::vector<Index> labels;
    for (Index f = 0; f < whole.n_faces(); ++f)
        labels.push_back(f % 20 < 9 ? 0 : 1);
    const PolygonMesh seams = test::split(whole, labels);
    REQUIRE(seams.n_vertices() > whole.n_vertices());
    FlowOptions options = amount(whole, 1.0, 3);
    options.cut.labels = labels;
    Eigen::MatrixXd of_whole = steps_of_zero_and_one(whole.n_vertices(), 1);
    const std::vector<Index> original = test::originals(seams, whole);
    Eigen::MatrixXd across = of_whole(original, Eigen::all);
    const FieldReport report = diffuse(whole, of_whole, options);
    // Parts that flips have torn are mended.
    REQUIRE(report.flow.cut.labels.size() == labels.size());
    const auto n_kept = std::inner_product(labels.begin(), labels.end(), report.flow.cut.labels.begin(), 0,
                                           std::plus<>(), std::equal_to<>());
    CHECK(n_kept > 0.8 * static_cast<double>(labels.size()));
    diffuse(seams, across, options);
    CHECK((across - of_whole(original, Eigen::all)).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("the kernel of fields is as wide on long triangles as on others")
{
    for (const double shear : {0.0, 3.0}) {
        CAPTURE(shear);
        PolygonMesh mesh = test::triangle_grid(60, 60);
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            mesh.vertices(v, 0) += shear * (mesh.vertices(v, 1) - 30.0);
        const Index centre = 30 * 61 + 30;
        Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(mesh.n_vertices(), 1);
        fields(centre, 0) = 1.0;
        constexpr double time = 2.0;
        diffuse(mesh, fields, {.time_step = time / 10.0, .steps = 10});
        const Points offset = mesh.vertices.rowwise() - mesh.vertices.row(centre);
        const Eigen::RowVector2d variance = (fields.transpose() * offset.leftCols(2).cwiseAbs2()) / fields.sum();
        CHECK(variance[0] == relative(2.0 * time, 0.02));
        CHECK(variance[1] == relative(2.0 * time, 0.02));
    }
}
