#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "samples/meshes/meshes.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/flows.h"

using namespace seamflow;
using test::flowed;

namespace {

FlowOptions schwarz_options(Laplacian laplacian, Index subdomains, int overlap = 1)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.interface.conditions = Conditions::Schwarz;
    options.time_step = 0.002;
    options.steps = 3;
    options.cut.subdomains = subdomains;
    options.interface.overlap = overlap;
    return options;
}

/// V_mean after the last step, in mean edge lengths.
double distance_to_undecomposed(PolygonMesh mesh, FlowOptions options)
{
    options.report.reference = true;
    const FlowReport report = mean_curvature_flow(mesh, options);
    return report.steps.back().distance->mean / report.steps.back().distance->mean_edge;
}

}  // namespace

TEST_CASE("the wider the overlap the nearer Schwarz is to the undecomposed flow")
{
    for (const PolygonMesh& mesh : {make_quads(2000), make_hexagons(2000), make_mixed_polygons(2000)})
        for (const Index subdomains : {2, 5, 16}) {
            CAPTURE(subdomains);
            const double one = distance_to_undecomposed(mesh, schwarz_options(Laplacian::Fujiwara, subdomains, 1));
            const double two = distance_to_undecomposed(mesh, schwarz_options(Laplacian::Fujiwara, subdomains, 2));
            const double three = distance_to_undecomposed(mesh, schwarz_options(Laplacian::Fujiwara, subdomains, 3));
            CHECK(two < 0.8 * one);
            CHECK(three < 0.8 * two);
        }
}

TEST_CASE("with an overlap as wide as the mesh Schwarz is the undecomposed flow")
{
    const PolygonMesh mesh = make_quads(900);
    const Points undecomposed = flowed(mesh, schwarz_options(Laplacian::Fujiwara, 1));
    CHECK(test::largest_difference(flowed(mesh, schwarz_options(Laplacian::Fujiwara, 4, 1000)), undecomposed) <= 1e-9);
}

TEST_CASE("on a wavy tube cut along a peak Schwarz holds the interface back, adapted Robin does not")
{
    const test::CutMesh cut =
        test::cut_by_place("tube", make_cylinder(10'200), [](const Point& centre) { return centre.z() > 0.0 ? 1 : 0; });
    FlowOptions schwarz = FlowOptions::plain();
    schwarz.time_step = 0.05;
    schwarz.steps = 5;
    schwarz.cut.labels = cut.labels;
    schwarz.interface.colouring = Colouring::Label;
    FlowOptions robin = schwarz;
    schwarz.interface.conditions = Conditions::Schwarz;
    CHECK(distance_to_undecomposed(cut.mesh, schwarz) > 5.0 * distance_to_undecomposed(cut.mesh, robin));
}
