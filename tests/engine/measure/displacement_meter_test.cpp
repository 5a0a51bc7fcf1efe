#include <cmath>

#include <doctest/doctest.h>

#include "engine/measure/displacement_meter.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

FlowReport run(const PolygonMesh& mesh, Laplacian laplacian, double time_step, int subdomains = 1)
{
    PolygonMesh flowing = mesh;
    FlowOptions options;
    options.laplacian = laplacian;
    options.time_step = time_step;
    options.steps = 3;
    options.cut.subdomains = subdomains;
    return mean_curvature_flow(flowing, options);
}

double drag(const PolygonMesh& mesh, Laplacian laplacian, double time_step, int subdomains = 1)
{
    return run(mesh, laplacian, time_step, subdomains).displacement->path.tangential.mean;
}

}  // namespace

TEST_CASE("there and back is a path, but no drift")
{
    const PolygonMesh plane = test::quad_grid(4, 4);
    const Topology topology = make_topology(plane);
    DisplacementMeter meter(plane, topology);
    Points away = plane.vertices;
    away.rowwise() += Point(0.5, 0.0, 2.0);
    CHECK(meter.add_step(plane.vertices, away).tangential.max == 0.5);
    CHECK(meter.add_step(away, plane.vertices).normal.mean == 2.0);
    const TotalDisplacement total = meter.total();
    CHECK(total.path.tangential.mean == 1.0);
    CHECK(total.path.normal.max == 4.0);
    CHECK(total.drift.max == 0.0);
}

TEST_CASE("without steps nothing moved")
{
    const PolygonMesh plane = test::quad_grid(4, 4);
    const Topology topology = make_topology(plane);
    const TotalDisplacement total = DisplacementMeter(plane, topology).total();
    CHECK(total.path.normal.max == 0.0);
    CHECK(total.drift.mean == 0.0);
}

TEST_CASE("the steps of a flow add up")
{
    const FlowReport report = run(make_noisy_sphere(1000), Laplacian::Fujiwara, 0.01, 4);
    double tangential = 0.0;
    double normal = 0.0;
    for (const StepReport& step : report.steps) {
        tangential += step.displacement.tangential.mean;
        normal += step.displacement.normal.mean;
    }
    CHECK(tangential > 0.0);
    CHECK(report.displacement->path.tangential.mean == test::relative(tangential, 1e-5));
    CHECK(report.displacement->path.normal.mean == test::relative(normal, 1e-5));
    CHECK(report.displacement->drift.mean <= report.displacement->path.tangential.mean);
}

TEST_CASE("Fujiwara's Laplacian drags the texture, the others hardly do")
{
    const struct {
        const char* name;
        PolygonMesh mesh;
        double time_step;
    } cases[] = {{"two levels of detail", make_two_level_cylinder(2000, {.amplitude = 0.05}), 0.005},
                 {"mixed polygons", make_mixed_polygons(2000), 0.0005}};
    for (const auto& c : cases)
        for (const int subdomains : {1, 2}) {
            CAPTURE(c.name);
            CAPTURE(subdomains);
            const double dragged = drag(c.mesh, Laplacian::Fujiwara, c.time_step, subdomains);
            CHECK(drag(c.mesh, Laplacian::AlexaWardetzky, c.time_step, subdomains) < 0.25 * dragged);
            CHECK(drag(c.mesh, Laplacian::PtackovaVelho, c.time_step, subdomains) < 0.25 * dragged);
        }
}
