#include <cstring>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "samples/meshes/meshes.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/flows.h"

using namespace seamflow;
using test::flowed;
using test::height_fields;

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

TEST_CASE("with Schwarz a flat mesh stays flat whatever the cut, and closed ones stay finite")
{
    for (const Laplacian laplacian : test::all_laplacians)
        for (const Index subdomains : {2, 5, 16}) {
            CAPTURE(name_of(laplacian));
            CAPTURE(subdomains);
            for (PolygonMesh mesh : height_fields()) {
                CHECK(flowed(mesh, schwarz_options(laplacian, subdomains)).allFinite());
                mesh.vertices.col(2).setZero();
                CHECK(flowed(mesh, schwarz_options(laplacian, subdomains, 2)).col(2).cwiseAbs().maxCoeff() == 0.0);
            }
            CHECK(flowed(make_noisy_sphere(900), schwarz_options(laplacian, subdomains)).allFinite());
        }
}

TEST_CASE("with Alexa-Wardetzky and Schwarz a flat mesh of triangles does not move at all")
{
    PolygonMesh mesh = make_triangles(900);
    mesh.vertices.col(2).setZero();
    for (const Index subdomains : {2, 5, 16})
        CHECK(test::largest_difference(flowed(mesh, schwarz_options(Laplacian::AlexaWardetzky, subdomains)),
                                       mesh.vertices) <= 1e-12);
}

TEST_CASE("Schwarz in one sub-mesh is the undecomposed flow to the bit")
{
    for (const PolygonMesh& mesh : height_fields()) {
        FlowOptions undecomposed = schwarz_options(Laplacian::Fujiwara, 1);
        undecomposed.interface.conditions = Conditions::AdaptedRobin;
        CHECK(flowed(mesh, schwarz_options(Laplacian::Fujiwara, 1, 3)) == flowed(mesh, undecomposed));
    }
}

TEST_CASE("Schwarz gives the same bits for every number of threads from 1 to 8")
{
    const PolygonMesh mesh = make_mixed_polygons(3000);
    for (const Laplacian laplacian : test::all_laplacians)
        for (const Correction correction : {Correction::Automatic, Correction::Centroid}) {
            FlowOptions options = schwarz_options(laplacian, 24, 2);
            options.interface.correction = correction;
            options.resources.threads = 1;
            const Points expected = flowed(mesh, options);
            for (options.resources.threads = 2; options.resources.threads <= 8; ++options.resources.threads) {
                CAPTURE(options.resources.threads);
                const Points found = flowed(mesh, options);
                CHECK(std::memcmp(found.data(), expected.data(),
                                  static_cast<std::size_t>(found.size()) * sizeof(double)) == 0);
            }
        }
}

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
