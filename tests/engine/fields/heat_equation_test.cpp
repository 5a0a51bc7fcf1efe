#include <array>
#include <limits>
#include <memory>
#include <string>

#include <doctest/doctest.h>

#include "engine/fields/heat_equation.h"
#include "engine/mean_curvature_flow.h"
#include "engine/state/flow_state.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"

using namespace seamflow;

TEST_CASE("an equation refuses fields that are not for it, with what is wrong, and leaves them")
{
    const PolygonMesh mesh = make_quads(400);
    const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(mesh.n_vertices(), 2);
    FlowOptions options{.time_step = 1e-3};
    CHECK(test::message_of<OptionError>([&] { HeatEquation(mesh, options); }) ==
          "only linear flows are applied to fields: their matrix stays the same");
    Eigen::MatrixXd fields = ones;
    options.flow = FlowEquation::Linear;
    const FlowControl resuming{.stop = {}, .on_progress = {}, .resume = std::make_shared<const FlowState>()};
    CHECK(test::message_of<OptionError>([&] { HeatEquation(mesh, options, Weights::OfLaplacian, resuming); }) ==
          "fields have no state to resume from: leave it out");
    HeatEquation heat(mesh, options);
    Eigen::MatrixXd short_ones = ones.topRows(3);
    const std::string wrong_rows = "the fields have 3 rows, but the mesh has " + std::to_string(mesh.n_vertices()) +
                                   " vertices: give one for each";
    CHECK(test::message_of<InputError>([&] { heat.take_steps(short_ones, 1); }) == wrong_rows);
    CHECK(test::message_of<InputError>([&] { heat.keep_field_edges(short_ones, 1.0); }) == wrong_rows);
    CHECK(short_ones == ones.topRows(3));
    fields(3, 1) = std::numeric_limits<double>::infinity();
    CHECK(test::contains(test::message_of<InputError>([&] { heat.take_steps(fields, 1); }),
                         "fields need a finite number at each"));
    CHECK(fields.col(0) == ones.col(0));
    CHECK(test::message_of<OptionError>([&] { heat.keep_field_edges(ones, 0.0); }) ==
          "the difference of fields to keep is 0, but must be positive");
    // A refusal is no failure.
    fields = ones;
    heat.take_steps(fields);
    CHECK((fields - ones).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("coordinates that diffuse are those of the linear flow, to the bit in the first step")
{
    PolygonMesh mesh = make_mixed_polygons(600);
    const double edge = mean_edge_length(mesh);
    for (const Approach approach : {Approach::Converged, Approach::Undecomposed, Approach::ConjugateGradients}) {
        CAPTURE(static_cast<int>(approach));
        FlowOptions options{.laplacian = Laplacian::VirtualRefinement, .time_step = edge * edge, .steps = 3};
        options.flow = FlowEquation::Linear;
        options.accuracy.approach = approach;
        if (approach != Approach::Undecomposed)
            options.accuracy.tolerance = 1e-12;
        if (approach == Approach::Converged)
            options.cut.subdomains = 5;
        HeatEquation heat(mesh, options);
        CHECK(test::same_bits(heat.surface().vertices, mesh.vertices));
        Eigen::MatrixXd fields = mesh.vertices;
        PolygonMesh moved = mesh;
        Flow flow(moved, options);
        flow.step();
        heat.take_steps(fields);
        CHECK(test::same_bits(Points(fields), moved.vertices));
        flow.step(2);
        heat.take_steps(fields, 2);
        CHECK((fields - moved.vertices).cwiseAbs().maxCoeff() < 1e-9 * edge);
        CHECK(heat.report().steps.empty());
        CHECK(heat.report().convergence.approach == approach);
    }
}
