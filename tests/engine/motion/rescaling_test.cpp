#include <algorithm>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/motion/rescaling.h"
#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"
#include "tests/support/relative.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

struct Measure {
    double area = 0.0;
    double volume = 0.0;
    Point centroid = Point::Zero();
};

Measure measure(const PolygonMesh& mesh, const Points& positions)
{
    Measure m;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const Point normal = vector_area(mesh.face(f), positions);
        Point mean = Point::Zero();
        for (const Index v : mesh.face(f))
            mean += positions.row(v);
        mean /= static_cast<double>(mesh.face(f).size());
        m.area += normal.norm();
        m.volume += normal.dot(mean) / 3.0;
        m.centroid += normal.norm() * mean;
    }
    m.centroid /= m.area;
    return m;
}

FlowOptions rescaled_options(Rescale rescale)
{
    FlowOptions options;
    options.time_step = 0.02;
    options.steps = 3;
    options.cut.subdomains = 4;
    options.motion.rescale = rescale;
    return options;
}

PolygonMesh oblong()
{
    PolygonMesh mesh = make_noisy_sphere(1000, {.amplitude = 0.3});
    mesh.vertices.col(2) *= 2.0;
    return mesh;
}

/// The standard deviation of the distances to the mean position, relative to their mean.
double spread_of_radii(const Points& points)
{
    const Eigen::ArrayXd radii = (points.rowwise() - points.colwise().mean()).rowwise().norm();
    return std::sqrt((radii - radii.mean()).square().mean()) / radii.mean();
}

FlowOptions rescaled_conformalized(double time_step, int steps)
{
    FlowOptions options;
    options.laplacian = Laplacian::VirtualRefinement;
    options.flow = FlowEquation::Conformalized;
    options.motion.rescale = Rescale::Area;
    options.time_step = time_step;
    options.steps = steps;
    return options;
}

}  // namespace

TEST_CASE("area or volume, and the centroid, are those of the input after every step; the shape is that of the flow")
{
    for (const PolygonMesh& input : {make_noisy_sphere(900), quad_torus(30, 20)}) {
        PolygonMesh mesh = input;
        mesh.vertices.rowwise() += Point(10.0, -3.0, 7.0);
        const Measure before = measure(mesh, mesh.vertices);
        const Points unscaled = flowed(mesh, rescaled_options(Rescale::None));
        const Measure shrunk = measure(mesh, unscaled);
        REQUIRE(shrunk.area < 0.95 * before.area);
        for (const Rescale rescale : {Rescale::Area, Rescale::Volume}) {
            PolygonMesh moved = mesh;
            int n_steps = 0;
            mean_curvature_flow(moved, rescaled_options(rescale), [&](const StepState& state) {
                ++n_steps;
                const Measure after = measure(mesh, state.positions);
                if (rescale == Rescale::Area)
                    CHECK(after.area == relative(before.area, 1e-12));
                else
                    CHECK(after.volume == relative(before.volume, 1e-9));
                CHECK((after.centroid - before.centroid).norm() < 1e-12);
            });
            CHECK(n_steps == 3);
            const Point from = moved.vertices.row(0) - before.centroid;
            const double scale = from.norm() / (unscaled.row(0) - shrunk.centroid).norm();
            CHECK(scale > 1.0);
            const Points expected = (scale * (unscaled.rowwise() - shrunk.centroid)).rowwise() + before.centroid;
            CHECK(largest_difference(moved.vertices, expected) < 1e-12);
        }
    }
}

TEST_CASE("an open surface keeps its area where its boundary is free, and has no volume to keep")
{
    const PolygonMesh mesh = make_quads(900);
    FlowOptions options = rescaled_options(Rescale::Area);
    PolygonMesh moved = mesh;
    CHECK_THROWS_WITH_AS(mean_curvature_flow(moved, options), doctest::Contains("low-pass"), InputError);
    options.motion.boundary = Boundary::Free;
    mean_curvature_flow(moved, options);
    CHECK(measure(mesh, moved.vertices).area == relative(measure(mesh, mesh.vertices).area, 1e-12));
    options.motion.rescale = Rescale::Volume;
    CHECK_THROWS_WITH_AS(mean_curvature_flow(moved, options), doctest::Contains("low-pass"), InputError);
    // A boundary that moves would not help.
    options.motion.boundary = Boundary::Fixed;
    CHECK_THROWS_WITH_AS(mean_curvature_flow(moved, options), doctest::Contains("only a closed surface"), InputError);
}

TEST_CASE("what cannot be scaled is refused")
{
    const PolygonMesh sphere = make_noisy_sphere(400);
    PolygonMesh flipped = with_faces_flipped(sphere, 7);
    CHECK_THROWS_AS(mean_curvature_flow(flipped, rescaled_options(Rescale::Volume)), InputError);
    CHECK_NOTHROW(mean_curvature_flow(flipped, rescaled_options(Rescale::Area)));
    // A sphere pressed flat.
    PolygonMesh flat = sphere;
    flat.vertices.col(2).setZero();
    CHECK_THROWS_AS(Rescaling(flat, make_topology(flat), Rescale::Volume), InputError);
    // Beside another body it stays as the flow leaves it.
    const PolygonMesh both = side_by_side({sphere, flat});
    const Topology topology = make_topology(both);
    Rescaling rescaling(both, topology, Rescale::Volume);
    Points shrunk = 0.5 * both.vertices;
    rescaling.apply(shrunk);
    CHECK(largest_difference(shrunk.topRows(sphere.n_vertices()), both.vertices.topRows(sphere.n_vertices())) < 1e-12);
    CHECK(shrunk.bottomRows(flat.n_vertices()) == 0.5 * both.vertices.bottomRows(flat.n_vertices()));
    CHECK(sentence(rescaling.remark().value()).starts_with("1 of 2 components was not scaled back"));
}

TEST_CASE("each body is scaled as it would be alone, whatever its size and however far the others are")
{
    const PolygonMesh sphere = make_noisy_sphere(400);
    for (const double size : {0.01, 0.3, 100.0})
        for (const double distance : {4.0, 1e4})
            for (const Rescale rescale : {Rescale::Area, Rescale::Volume}) {
                PolygonMesh other = quad_torus(20, 12);
                other.vertices *= size;
                // Turned inside out, it is a cavity.
                std::reverse(other.face_vertices.begin(), other.face_vertices.end());
                other.vertices.rowwise() += Point(distance * size, 0.0, 1.0);
                const PolygonMesh both = together({sphere, other});
                const auto shrink = [](const Points& positions) { return Points(0.7 * positions); };
                Points alone = shrink(sphere.vertices);
                Rescaling(sphere, make_topology(sphere), rescale).apply(alone);
                Points other_alone = shrink(other.vertices);
                Rescaling(other, make_topology(other), rescale).apply(other_alone);
                Points together = shrink(both.vertices);
                Rescaling(both, make_topology(both), rescale).apply(together);
                CHECK(together.topRows(sphere.n_vertices()) == alone);
                CHECK(together.bottomRows(other.n_vertices()) == other_alone);
                CHECK(largest_difference(other_alone, other.vertices) < 1e-9 * size * distance);
            }
}

TEST_CASE("a body of which only a point is left does not keep the others from being scaled back")
{
    const PolygonMesh sphere = make_noisy_sphere(400);
    PolygonMesh crumb = sphere;
    crumb.vertices = (1e-7 * crumb.vertices).rowwise() + Point(5.0, 0.0, 0.0);
    const PolygonMesh both = together({sphere, crumb});
    FlowOptions options = rescaled_options(Rescale::Volume);
    options.laplacian = Laplacian::AlexaWardetzky;
    PolygonMesh moved = both;
    const FlowReport report = mean_curvature_flow(moved, options);
    const Points first = moved.vertices.topRows(sphere.n_vertices());
    CHECK(measure(sphere, first).volume == relative(measure(sphere, sphere.vertices).volume, 1e-9));
    CHECK(test::count_with(report.remarks, "1 of 2 components was not scaled back") == 1);
}

TEST_CASE("what a step moves is measured without the rescaling")
{
    const PolygonMesh sphere = make_noisy_sphere(400);
    FlowOptions options = rescaled_options(Rescale::None);
    options.time_step = 0.03;
    options.steps = 6;
    options.cut.subdomains = 1;
    REQUIRE(box_of_faces(sphere, flowed(sphere, options)).diagonal() < 0.6 * box_of_faces(sphere).diagonal());
    options.accuracy.largest_update = 0.08;
    CHECK_NOTHROW(flowed(sphere, options));
    for (const Rescale rescale : {Rescale::Area, Rescale::Volume}) {
        options.motion.rescale = rescale;
        CHECK_NOTHROW(flowed(sphere, options));
    }
}

TEST_CASE("a surface of which rounding alone is left is not scaled back")
{
    for (const Rescale rescale : {Rescale::Area, Rescale::Volume}) {
        PolygonMesh mesh = make_noisy_sphere(200);
        const Points before = mesh.vertices;
        FlowOptions options = rescaled_options(rescale);
        options.laplacian = Laplacian::AlexaWardetzky;
        options.cut.subdomains = 1;
        options.time_step = 1e6;
        CHECK_THROWS_AS(mean_curvature_flow(mesh, options), ComputationError);
        CHECK(mesh.vertices.allFinite());
        options.steps = 1;
        mesh.vertices = before;
        mean_curvature_flow(mesh, options);
        CHECK(box_of_faces(mesh).diagonal() > 0.5 * box_of_faces(mesh, before).diagonal());
    }
}

TEST_CASE("vertices without faces stay, and without rescaling no bit changes")
{
    PolygonMesh mesh = make_noisy_sphere(400);
    const Index stray = mesh.n_vertices();
    mesh.vertices.conservativeResize(stray + 1, 3);
    mesh.vertices.row(stray) = Point(5.0, 6.0, 7.0);
    const Points moved = flowed(mesh, rescaled_options(Rescale::Volume));
    CHECK(moved.row(stray) == mesh.vertices.row(stray));
    // However far: it says nothing about how many digits of the surface are left.
    mesh.vertices.row(stray) = Point(1e13, 0.0, 0.0);
    CHECK_NOTHROW(flowed(mesh, rescaled_options(Rescale::Volume)));
    const Topology topology = make_topology(mesh);
    Points same = mesh.vertices;
    Rescaling(mesh, topology, Rescale::None).apply(same);
    CHECK(same == mesh.vertices);
}

TEST_CASE("rescaled, the conformalized flow comes to a sphere, whatever the cut")
{
    const PolygonMesh mesh = oblong();
    FlowOptions options = rescaled_conformalized(0.5, 40);
    options.accuracy.approach = Approach::Undecomposed;
    const Points whole = flowed(mesh, options);
    CHECK(spread_of_radii(mesh.vertices) > 0.2);
    CHECK(spread_of_radii(whole) < 0.01);
    options.accuracy = {.tolerance = 1e-10, .approach = Approach::Converged};
    options.cut.subdomains = 8;
    options.report.reference = true;
    PolygonMesh moved = mesh;
    const FlowReport report = mean_curvature_flow(moved, options);
    CHECK(largest_difference(moved.vertices, whole) < 1e-8);
    for (const StepReport& step : report.steps)
        CHECK(step.distance.value().max < 1e-8);
}

TEST_CASE("sweeps of the rescaled conformalized flow stay near the undecomposed one, and keep the area")
{
    const PolygonMesh mesh = oblong();
    for (const Conditions conditions :
         {Conditions::AdaptedRobin, Conditions::AdaptedVentcell, Conditions::Schwarz, Conditions::Robin}) {
        FlowOptions options = rescaled_conformalized(0.01, 10);
        options.accuracy.approach = Approach::Sweep;
        options.interface.conditions = conditions;
        if (conditions == Conditions::AdaptedVentcell)
            options.interface.q = 0.1;
        options.cut.subdomains = 3;
        options.report.reference = true;
        PolygonMesh moved = mesh;
        const FlowReport report = mean_curvature_flow(moved, options);
        CHECK(report.cut.sub_meshes.size() == 3);
        CHECK(report.steps.back().distance.value().mean < 0.05);
        CHECK(report.steps.back().distance.value().max < 0.4);
        CHECK(measure(mesh, moved.vertices).area == relative(measure(mesh, mesh.vertices).area, 1e-10));
    }
}
