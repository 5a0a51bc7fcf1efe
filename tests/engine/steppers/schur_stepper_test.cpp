#include <array>
#include <cstring>
#include <limits>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/options/option_names.h"
#include "engine/setup/flow_plan.h"
#include "engine/steppers/schur_stepper.h"
#include "partition/cut/cut_into.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"

using namespace seamflow;
using test::flowed;

namespace {

FlowOptions converged(Laplacian laplacian, Index subdomains, double tolerance = 1e-11)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.time_step = 0.002;
    options.steps = 3;
    options.cut.subdomains = subdomains;
    options.accuracy.tolerance = tolerance;
    return options;
}

std::vector<PolygonMesh> converged_meshes()
{
    return {make_triangles(900), make_quads(900), make_hexagons(900), make_mixed_polygons(900), make_noisy_sphere(900)};
}

}  // namespace

TEST_CASE("converged, the flow in many sub-meshes is the undecomposed flow")
{
    for (const PolygonMesh& mesh : converged_meshes())
        for (const Laplacian laplacian : test::symmetric_laplacians) {
            CAPTURE(name_of(laplacian));
            FlowOptions undecomposed = converged(laplacian, 1);
            undecomposed.accuracy.tolerance.reset();
            const Points expected = flowed(mesh, undecomposed);
            for (const Index subdomains : {1, 2, 7, 30}) {
                CAPTURE(subdomains);
                PolygonMesh moved = mesh;
                const FlowReport report = mean_curvature_flow(moved, converged(laplacian, subdomains));
                CHECK(test::largest_difference(moved.vertices, expected) < 1e-9);
                for (const StepReport& step : report.steps) {
                    CHECK(step.residual.value() <= 1e-11);
                    CHECK(step.iterations.value() < 60);
                }
            }
        }
}

TEST_CASE("what the steps are short of the tolerance adds up")
{
    for (const PolygonMesh& mesh : converged_meshes())
        for (const Laplacian laplacian : test::symmetric_laplacians) {
            FlowOptions options = converged(laplacian, 12, 1e-2);
            options.steps = 6;
            PolygonMesh moved = mesh;
            double before = 0.0;
            mean_curvature_flow(moved, options, [&](const StepState& state) {
                const double now = state.report.estimated_v_max.value() * mean_edge_length(mesh, state.positions);
                CHECK(now >= before * (1.0 - 1e-12));
                before = now;
            });
            CHECK(before > 0.0);
        }
}

TEST_CASE("iterations do not grow with the number of sub-meshes, however long the step")
{
    const PolygonMesh mesh = make_triangles(8000);
    for (const Laplacian laplacian : test::symmetric_laplacians)
        for (const Index subdomains : {16, 64, 250}) {
            CAPTURE(name_of(laplacian));
            CAPTURE(subdomains);
            FlowOptions options = converged(laplacian, subdomains, 1e-8);
            options.time_step = 0.1;
            PolygonMesh moved = mesh;
            for (const StepReport& step : mean_curvature_flow(moved, options).steps)
                CHECK(step.iterations.value() <= (laplacian == Laplacian::Uniform ? 48 : 22));
        }
}

TEST_CASE("the estimated distance to the exact step is the true one within a factor of 3")
{
    for (const PolygonMesh& mesh : converged_meshes())
        for (const double tolerance : {1e-1, 1e-2, 1e-4}) {
            CAPTURE(tolerance);
            FlowOptions options = converged(Laplacian::Fujiwara, 12, tolerance);
            options.steps = 1;
            options.report.reference = true;
            PolygonMesh moved = mesh;
            const FlowReport report = mean_curvature_flow(moved, options);
            const VertexDistance distance = report.steps.front().distance.value();
            const double ratio = report.steps.front().estimated_v_max.value() * distance.mean_edge / distance.max;
            CHECK(ratio < 3.0);
            CHECK(ratio > 1.0 / 3.0);
        }
}

TEST_CASE("components with and without Γ converge side by side")
{
    const PolygonMesh mesh = test::side_by_side({make_quads(900), make_triangles(100), make_noisy_sphere(700)});
    FlowOptions undecomposed = converged(Laplacian::AlexaWardetzky, 1);
    undecomposed.accuracy.tolerance.reset();
    CHECK(test::largest_difference(flowed(mesh, converged(Laplacian::AlexaWardetzky, 9)), flowed(mesh, undecomposed)) <
          1e-8);
}

TEST_CASE("the tighter the tolerance the nearer, and iterations that run out are said")
{
    const PolygonMesh mesh = make_triangles(2000);
    FlowOptions undecomposed = converged(Laplacian::Fujiwara, 1);
    undecomposed.accuracy.tolerance.reset();
    const Points expected = flowed(mesh, undecomposed);
    double before = 1.0;
    for (const double tolerance : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9}) {
        const double distance =
            test::largest_difference(flowed(mesh, converged(Laplacian::Fujiwara, 12, tolerance)), expected);
        CHECK(distance < 0.2 * before);
        before = distance;
    }
    PolygonMesh moved = mesh;
    FlowOptions few = converged(Laplacian::Fujiwara, 12, 1e-9);
    few.accuracy.converge_iterations = 2;
    const FlowReport report = mean_curvature_flow(moved, few);
    CHECK(report.steps.back().iterations == 2);
    CHECK(report.steps.back().residual > 1e-9);
    REQUIRE_FALSE(report.remarks.empty());
    CHECK(sentence(report.remarks.back()).find("not reached in 3 steps") != std::string::npos);
    CHECK(report.convergence.steps_short_of_tolerance == 3);
    CHECK(report.convergence.steps_stagnated == 0);
    few.accuracy.converge_iterations = 1000;
    few.accuracy.tolerance = 1e-100;
    const FlowReport stagnant = mean_curvature_flow(moved, few);
    CHECK(stagnant.convergence.steps_stagnated == 3);
    CHECK(stagnant.steps.back().iterations < 500);
}

TEST_CASE("in any precision converged steps reach the same tolerance, with Γ and without")
{
    const PolygonMesh mesh = make_noisy_sphere(3000);
    for (const Laplacian laplacian : test::symmetric_laplacians)
        for (const double time_step : {0.002, 0.5})
            for (const Index subdomains : {1, 24}) {
                FlowOptions options = converged(laplacian, subdomains);
                options.time_step = time_step;
                options.resources.precision = Precision::Double;
                const Points expected = flowed(mesh, options);
                for (const Precision precision : {Precision::Automatic, Precision::Single, Precision::Double}) {
                    CAPTURE(option_name(precision));
                    options.resources.precision = precision;
                    PolygonMesh moved = mesh;
                    const FlowReport report = mean_curvature_flow(moved, options);
                    CHECK(report.convergence.steps_short_of_tolerance == 0);
                    CHECK(test::largest_difference(moved.vertices, expected) < 1e-11);
                    const bool is_double =
                        precision == Precision::Double || (precision == Precision::Automatic && subdomains == 1);
                    CHECK((moved.vertices == expected) == is_double);
                    CHECK(report.resources.single_factors == (is_double ? 0 : subdomains));
                }
            }
}

TEST_CASE("only sub-meshes in which single precision would lose too many digits are factorised in double precision")
{
    PolygonMesh mesh = make_triangles(3000);
    // A sliver: far from the boundary one vertex comes very near another.
    const auto corners = mesh.face(mesh.n_faces() / 2 + 50);
    mesh.vertices.row(corners[0]) =
        mesh.vertices.row(corners[1]) + 1e-6 * (mesh.vertices.row(corners[0]) - mesh.vertices.row(corners[1]));
    const FlowOptions options = converged(Laplacian::Fujiwara, 24, 1e-8);
    FlowOptions undecomposed = converged(Laplacian::Fujiwara, 1);
    undecomposed.accuracy.tolerance.reset();
    PolygonMesh moved = mesh;
    const FlowReport report = mean_curvature_flow(moved, options);
    CHECK(report.convergence.steps_short_of_tolerance == 0);
    CHECK(report.resources.single_factors < 24);
    CHECK(report.resources.single_factors >= 20);
    CHECK(test::largest_difference(moved.vertices, flowed(mesh, undecomposed)) < 1e-8);
}

TEST_CASE("where refinement stagnates, all is factorised in double precision")
{
    const PolygonMesh mesh = make_triangles(2000);
    FlowOptions options = converged(Laplacian::Fujiwara, 12, 1e-100);
    PolygonMesh moved = mesh;
    const FlowReport report = mean_curvature_flow(moved, options);
    CHECK(report.convergence.steps_stagnated == 3);
    CHECK(report.resources.single_factors == 0);
    options.resources.precision = Precision::Double;
    CHECK(flowed(mesh, options) == moved.vertices);
    options.resources.precision = Precision::Single;
    moved = mesh;
    CHECK(mean_curvature_flow(moved, options).resources.single_factors == 12);
}

TEST_CASE("the unit of length changes no bit of the result")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    for (const Laplacian laplacian : test::symmetric_laplacians)
        for (const double time_step : {0.002, 0.1}) {
            FlowOptions options = converged(laplacian, 24, 1e-8);
            options.time_step = time_step;
            const Points expected = flowed(mesh, options);
            for (const double unit : {0x1p-220, 0x1p-30, 0x1p30, 0x1p220}) {
                CAPTURE(unit);
                PolygonMesh scaled = mesh;
                scaled.vertices *= unit;
                options.time_step = time_step * unit * unit;
                const FlowReport report = mean_curvature_flow(scaled, options);
                CHECK(report.convergence.steps_short_of_tolerance == 0);
                CHECK(scaled.vertices == unit * expected);
            }
        }
}

TEST_CASE("vertices that are fixed between steps keep their values in many columns, and the others have those of three")
{
    const PolygonMesh mesh = make_triangles(900);
    Topology topology = make_topology(mesh);
    free_boundary(topology);
    FlowOptions options = converged(Laplacian::VirtualRefinement, 1);
    options.flow = FlowEquation::Linear;
    const FlowControl control;
    Progress progress(control);
    SchurStepper stepper(mesh, topology, cut_into(mesh, topology, 1),
                         settings_of(options, UndecomposedSteps(), mesh.vertices), UndecomposedSteps().stop(),
                         progress);
    stepper.set_fixed(std::array<Index, 2>{200, 201}, true);
    const Eigen::MatrixXd before = Eigen::MatrixXd::Random(mesh.n_vertices(), 40);
    Eigen::MatrixXd expected = before;
    for (Eigen::Index c = 0; c < before.cols(); ++c) {
        Points column = Points::Zero(mesh.n_vertices(), 3);
        column.col(0) = before.col(c);
        stepper.set_data(column, DataSteps::Further);
        stepper.step(column);
        expected.col(c) = stepper.positions().col(0);
    }
    REQUIRE(stepper.can_take_columns());
    Eigen::MatrixXd fields = before;
    stepper.take_columns(fields, 1, progress.exec());
    CHECK((fields - expected).cwiseAbs().maxCoeff() < 1e-12);
    CHECK(fields.row(200) == before.row(200));
    CHECK(fields.row(201) == before.row(201));
    CHECK(fields.row(202) != before.row(202));
}

TEST_CASE("undecomposed steps in single precision are refined to the tolerance that is given, not further")
{
    FlowOptions options = converged(Laplacian::VirtualRefinement, 1);
    options.cut.subdomains = 0;
    options.accuracy.approach = Approach::Undecomposed;
    const auto moved = [&](double tolerance, Precision precision) {
        options.accuracy.tolerance = tolerance;
        options.resources.precision = precision;
        PolygonMesh mesh = make_triangles(900);
        CHECK(mean_curvature_flow(mesh, options).convergence.steps_short_of_tolerance == 0);
        return mesh.vertices;
    };
    const Points exact = moved(1e-3, Precision::Double);
    const double rough = (moved(1e-3, Precision::Single) - exact).cwiseAbs().maxCoeff();
    const double fine = (moved(1e-12, Precision::Single) - exact).cwiseAbs().maxCoeff();
    CHECK(fine < 1e-11);
    CHECK(rough < 1e-3);
    CHECK(rough > 10.0 * fine);
}
