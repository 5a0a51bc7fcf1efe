#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/random_meshes.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::flowed;

namespace {

FlowOptions by_conjugate_gradients(Laplacian laplacian, double tolerance)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.time_step = 0.002;
    options.steps = 3;
    options.accuracy = {.tolerance = tolerance, .approach = Approach::ConjugateGradients};
    return options;
}

FlowOptions undecomposed(FlowOptions options)
{
    options.cut.subdomains = 1;
    options.accuracy = {.approach = Approach::Sweep};
    return options;
}

/// The last one has several blocks of rows, and numbers at random.
std::vector<PolygonMesh> meshes()
{
    return {make_triangles(900),      make_quads(900),        make_hexagons(900),
            make_mixed_polygons(900), make_noisy_sphere(900), test::shuffled(make_triangles(6000), 5).mesh};
}

}  // namespace

TEST_CASE("conjugate gradients take the undecomposed step, attached or not, with a weight for each vertex, too")
{
    for (const PolygonMesh& mesh : meshes())
        for (const Laplacian laplacian : test::symmetric_laplacians)
            for (const double weight : {0.0, 1000.0}) {
                CAPTURE(name_of(laplacian));
                FlowOptions options = by_conjugate_gradients(laplacian, 1e-10);
                options.motion.fixed_vertices = {7, 31};
                for (Index v = 0; v < mesh.n_vertices(); ++v)
                    options.motion.attachment_weights.push_back(v % 3 == 0 ? 0.0 : weight * (v % 5));
                for (const Boundary boundary : {Boundary::Fixed, Boundary::Free}) {
                    options.motion.boundary = boundary;
                    const Points expected = flowed(mesh, undecomposed(options));
                    PolygonMesh moved = mesh;
                    const FlowReport report = mean_curvature_flow(moved, options);
                    CHECK(test::largest_difference(moved.vertices, expected) < 1e-9);
                    CHECK(moved.vertices.row(7) == mesh.vertices.row(7));
                    for (const StepReport& step : report.steps)
                        CHECK(step.residual.value() <= 1e-10);
                }
                options.motion.attachment_weights.clear();
                options.motion.attachment = 0.3 * weight;
                CHECK(test::largest_difference(flowed(mesh, options), flowed(mesh, undecomposed(options))) < 1e-9);
            }
}

TEST_CASE("without a tolerance conjugate gradients leave less than sub-meshes do by their own choice")
{
    for (const PolygonMesh& mesh : {make_triangles(9000), make_hexagons(9000), make_mixed_polygons(9000)})
        for (const double step : {1.0, 5.0, 50.0}) {
            const double edge = mean_edge_length(mesh);
            FlowOptions options;
            options.time_step = step * edge * edge;
            const auto distance_by = [&](Approach approach) {
                FlowOptions by = options;
                by.accuracy.approach = approach;
                by.report.reference = true;
                PolygonMesh moved = mesh;
                const VertexDistance distance = *mean_curvature_flow(moved, by).steps[0].distance;
                return std::pair{distance.max / edge, distance.mean / edge};
            };
            const auto [largest, mean] = distance_by(Approach::ConjugateGradients);
            const auto [most, most_on_average] = distance_by(Approach::Decomposed);
            CHECK(largest <= most);
            CHECK(mean <= std::max(most_on_average, 3e-4));
        }
}

TEST_CASE("the estimated distance of conjugate gradients is near the true one, and rather above it")
{
    for (const PolygonMesh& mesh : meshes())
        for (const Laplacian laplacian : test::symmetric_laplacians)
            for (const double tolerance : {1e-1, 1e-2, 1e-4, 1e-8}) {
                CAPTURE(name_of(laplacian));
                CAPTURE(tolerance);
                FlowOptions options = by_conjugate_gradients(laplacian, tolerance);
                options.steps = 1;
                PolygonMesh moved = mesh;
                const FlowReport report = mean_curvature_flow(moved, options);
                const Points expected = flowed(mesh, undecomposed(options));
                const double distance = (moved.vertices - expected).rowwise().norm().maxCoeff();
                const double estimated =
                    report.steps[0].estimated_v_max.value() * mean_edge_length(mesh, moved.vertices);
                CHECK(estimated > 0.5 * distance);
                CHECK(estimated < 20.0 * distance);
            }
}

TEST_CASE("single precision does not limit the size of a mesh, nor how little there is to smooth")
{
    for (const Laplacian laplacian : test::symmetric_laplacians)
        for (const double size : {1e-60, 1e60}) {
            const PolygonMesh mesh = make_noisy_sphere(900);
            const FlowOptions options = by_conjugate_gradients(laplacian, 1e-6);
            const Points expected = flowed(mesh, options);
            PolygonMesh scaled = mesh;
            scaled.vertices *= size;
            FlowOptions of_scaled = options;
            of_scaled.time_step *= size * size;
            CHECK(test::largest_difference(flowed(scaled, of_scaled) / size, expected) < 1e-7);
        }
    // Almost flat: bumps of 1e-30.
    PolygonMesh flat = make_quads(900);
    flat.vertices.col(2) *= 1e-30;
    const FlowOptions options = by_conjugate_gradients(Laplacian::AlexaWardetzky, 1e-10);
    const Points expected = flowed(flat, undecomposed(options));
    CHECK((flowed(flat, options) - expected).col(2).cwiseAbs().maxCoeff() < 1e-36);
}

TEST_CASE("the order of the vertices makes no difference to the number of iterations")
{
    const PolygonMesh mesh = make_triangles(20000);
    const auto iterations = [](PolygonMesh flowing) {
        FlowOptions options = by_conjugate_gradients(Laplacian::Fujiwara, 1e-4);
        options.steps = 1;
        return mean_curvature_flow(flowing, options).steps[0].iterations.value();
    };
    const int as_made = iterations(mesh);
    CHECK(as_made > 20);
    CHECK(iterations(test::shuffled(mesh, 3).mesh) == test::relative(as_made, 0.2));
}

TEST_CASE("few iterations are told as such, and iterations that lead nowhere as stagnation")
{
    FlowOptions options = by_conjugate_gradients(Laplacian::Fujiwara, 1e-9);
    options.accuracy.converge_iterations = 3;
    PolygonMesh mesh = make_noisy_sphere(900);
    FlowReport report = mean_curvature_flow(mesh, options);
    CHECK(report.convergence.steps_short_of_tolerance == 3);
    CHECK(report.convergence.steps_stagnated == 0);
    CHECK(report.steps[0].iterations == 3);
    options.accuracy = {.tolerance = 1e-18, .approach = Approach::ConjugateGradients};
    mesh = make_noisy_sphere(900);
    report = mean_curvature_flow(mesh, options);
    CHECK(report.convergence.steps_stagnated == 3);
    CHECK(report.steps[0].residual.value() < 1e-13);
}

TEST_CASE("where there is nothing to smooth, conjugate gradients are at once as near as asked")
{
    // A flat mesh that is not parallel to an axis: its residual is rounding.
    PolygonMesh mesh = make_triangles(900);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        mesh.vertices(v, 2) = 0.3 * mesh.vertices(v, 0) - 0.7 * mesh.vertices(v, 1);
    const Points before = mesh.vertices;
    const FlowReport report = mean_curvature_flow(mesh, by_conjugate_gradients(Laplacian::AlexaWardetzky, 1e-8));
    CHECK(report.convergence.steps_short_of_tolerance == 0);
    CHECK(test::largest_difference(mesh.vertices, before) < 1e-12);
}
