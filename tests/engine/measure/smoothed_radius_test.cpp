#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/measure/smoothed_radius.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/relative.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("radius and time step are inverse to each other")
{
    for (const int steps : {1, 2, 7, 1000}) {
        CHECK(smoothed_radius(time_step_for_radius(0.3, steps), steps) == relative(0.3, 1e-12));
        CHECK(time_step_for_radius(smoothed_radius(1e-7, steps), steps) == relative(1e-7, 1e-12));
    }
    CHECK(time_step_for_radius(3.0, 1) == relative(2.0 * 9.0 / (std::numbers::pi * std::numbers::pi), 1e-5));
}

namespace {

constexpr Index side = 60;

/// The part of the height of low bumps that a flow leaves: a whole number of them, so that the mesh can end where they
/// are 0.
double left_of_bumps(double radius, const FlowOptions& options)
{
    PolygonMesh mesh = quad_grid(side, side);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        mesh.vertices(v, 2) = 1e-3 * std::sin(std::numbers::pi * mesh.vertices(v, 0) / (2.0 * radius)) *
                              std::sin(std::numbers::pi * mesh.vertices(v, 1) / (2.0 * radius));
    return flowed(mesh, options).col(2).maxCoeff() / mesh.vertices.col(2).maxCoeff();
}

}  // namespace

TEST_CASE("bumps of the radius lose half their height over all steps, smaller ones more, larger ones less")
{
    const double radius = side / 6.0;
    for (const Laplacian laplacian : {Laplacian::AlexaWardetzky, Laplacian::Fujiwara})
        for (const int steps : {1, 4})
            for (const double part : {1.0, 0.5, 3.0}) {
                FlowOptions options;
                options.laplacian = laplacian;
                options.steps = steps;
                options.cut.subdomains = 1;
                options.time_step = time_step_for_radius(radius, steps);
                CAPTURE(part);
                const double step_factor = 1.0 + (std::pow(2.0, 1.0 / steps) - 1.0) / (part * part);
                // Short bumps have few edges.
                CHECK(left_of_bumps(part * radius, options) ==
                      relative(std::pow(step_factor, -steps), part < 1.0 ? 0.06 : 0.02));
            }
}

TEST_CASE("bumps of the radius lose half their height with every filter, order and operator, in one step or several")
{
    const double radius = side / 6.0;
    for (const Laplacian laplacian :
         {Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement, Laplacian::Fujiwara, Laplacian::Uniform})
        for (const StepFilter kind : {StepFilter{Filter::Diffusion, 1},
                                      {Filter::Diffusion, 2},
                                      {Filter::Diffusion, 3},
                                      {Filter::LowPass, 2},
                                      {Filter::LowPass, 5},
                                      {Filter::LowPass, 8}})
            for (const int steps : {1, 3}) {
                FlowOptions options;
                options.laplacian = laplacian;
                options.filter = kind.kind;
                options.order = kind.order;
                options.steps = steps;
                options.accuracy.tolerance = 1e-8;
                options.radius = radius;
                CAPTURE(name_of(laplacian));
                CAPTURE(kind.order);
                CAPTURE(steps);
                CHECK(left_of_bumps(radius, options) == relative(0.5, 0.02));
            }
}

TEST_CASE("a flow takes a radius in place of a time step")
{
    const PolygonMesh mesh = make_noisy_sphere(500);
    FlowOptions by_step;
    by_step.steps = 3;
    by_step.time_step = time_step_for_radius(0.2, 3);
    FlowOptions by_radius;
    by_radius.steps = 3;
    by_radius.radius = 0.2;
    PolygonMesh moved = mesh;
    const FlowReport report = mean_curvature_flow(moved, by_radius);
    CHECK(report.time_step == by_step.time_step);
    CHECK(same_bits(moved.vertices, flowed(mesh, by_step)));
    LengthScale scale(mesh);
    by_step.time_step = time_step_of({.radius = LengthOnMesh{0.02, true}}, 3, scale);
    by_radius.radius = {0.02, true};
    CHECK(same_bits(flowed(mesh, by_radius), flowed(mesh, by_step)));

    by_radius.time_step = 1.0;
    CHECK_THROWS_AS(flowed(mesh, by_radius), OptionError);
    by_radius.time_step = 0.0;
    by_radius.radius = -1.0;
    CHECK_THROWS_WITH_AS(flowed(mesh, by_radius), doctest::Contains("radius is -1"), OptionError);
    by_radius.radius = 1e300;
    CHECK_THROWS_AS(flowed(mesh, by_radius), OptionError);
    by_radius.radius = {0.1, true};
    PolygonMesh point = mesh;
    point.vertices.setZero();
    CHECK_THROWS_WITH_AS(flowed(point, by_radius), doctest::Contains("the mesh has no size"), InputError);
}

TEST_CASE("a model of another size, with a time step in its own units, gives the result in that size")
{
    const PolygonMesh mesh = make_noisy_sphere(2000);
    for (const Laplacian laplacian : all_laplacians)
        for (const double scale : {1024.0, 1e-3}) {
            PolygonMesh scaled = mesh;
            scaled.vertices *= scale;
            FlowOptions options;
            options.laplacian = laplacian;
            options.steps = 2;
            options.cut.subdomains = 5;
            options.time_step = time_step_for_radius(0.02, options.steps);
            const Points expected = scale * flowed(mesh, options);
            options.time_step = time_step_for_radius(0.02 * scale, options.steps);
            CHECK(largest_difference(flowed(scaled, options), expected) < 1e-9 * scale);
        }
}
