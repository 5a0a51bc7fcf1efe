#include <numeric>
#include <string>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/measure/flow_remarks.h"
#include "engine/measure/remarks.h"
#include "samples/meshes/meshes.h"
#include "tests/support/messages.h"

using namespace seamflow;
using test::count_with;

TEST_CASE("a surface that collapses is remarked on, one that is smoothed is not")
{
    FlowOptions options;
    options.cut.subdomains = 1;
    options.time_step = 1e-3;
    PolygonMesh smoothed = make_noisy_sphere(500);
    CHECK(count_with(mean_curvature_flow(smoothed, options).remarks, "has shrunk") == 0);
    options.motion.boundary = Boundary::Free;
    options.laplacian = Laplacian::AlexaWardetzky;
    options.time_step = 1e6;
    PolygonMesh collapsed = make_quads(400);
    CHECK(count_with(mean_curvature_flow(collapsed, options).remarks, "has shrunk to") == 1);
}

TEST_CASE("a mesh none of whose vertices can move is remarked on, one of which some can is not")
{
    FlowOptions options;
    options.cut.subdomains = 1;
    options.time_step = 1e-3;
    PolygonMesh open = make_quads(400);
    CHECK(count_with(mean_curvature_flow(open, options).remarks, "No vertex can flow") == 0);
    options.motion.fixed_vertices.resize(usize(open.n_vertices()));
    std::iota(options.motion.fixed_vertices.begin(), options.motion.fixed_vertices.end(), 0);
    CHECK(count_with(mean_curvature_flow(open, options).remarks, "No vertex can flow") == 1);
}

TEST_CASE("the estimate of the last step is remarked on")
{
    for (const bool grows : {true, false}) {
        FlowReport report;
        report.steps.resize(2);
        report.steps[grows ? 1 : 0].estimated_v_max = 2.0;
        report.steps[grows ? 0 : 1].estimated_v_max = 0.5;
        remark_on_drift(report);
        CHECK(count_with(report.remarks, "by estimate") == (grows ? 1 : 0));
    }
}

TEST_CASE("an estimate is remarked on from one mean edge length on")
{
    FlowReport report;
    remark_on_drift(report);
    report.steps.resize(1);
    report.steps[0].estimated_v_max = 0.9;
    remark_on_drift(report);
    CHECK(report.remarks.empty());
    report.steps[0].estimated_v_max = 2.5;
    remark_on_drift(report);
    REQUIRE(report.remarks.size() == 1);
    CHECK(count_with(report.remarks, "up to 2.5 mean edge lengths") == 1);
}

TEST_CASE("a tolerance that was missed is remarked on, with what does not help")
{
    FlowReport report;
    remark_on_missed_tolerance(1000, report);
    CHECK(report.remarks.empty());
    report.convergence.steps_short_of_tolerance = 1;
    remark_on_missed_tolerance(1000, report);
    CHECK(sentence(report.remarks.back()) == "The tolerance was not reached in 1 step with 1000 iterations at most.");
    report.convergence.steps_short_of_tolerance = 3;
    remark_on_missed_tolerance(5, report);
    CHECK(sentence(report.remarks.back()) == "The tolerance was not reached in 3 steps with 5 iterations at most.");
    report.convergence.steps_stagnated = 2;
    remark_on_missed_tolerance(1000, report);
    CHECK(sentence(report.remarks.back()) ==
          "The tolerance was not reached in 3 steps with 1000 iterations at most; in 2 of them "
          "more would not have helped.");
}

TEST_CASE("one vertex, one face: remarks agree with their number")
{
    const std::string why = " held fixed because the mesh is not manifold there.";
    CHECK(sentence(remark_on_non_manifold_vertices(1, "")) == "1 vertex is" + why);
    CHECK(sentence(remark_on_non_manifold_vertices(2, "")) == "2 vertices are" + why);
    CHECK(sentence(remark_on_non_manifold_vertices(2, "With this")) ==
          "2 vertices are" + why + " With this, those on edges of three faces or more would flow.");
    const std::string junction = " on edges of three faces or more ";
    CHECK(sentence(remark_on_junctions(1, Laplacian::AlexaWardetzky)) ==
          "1 vertex" + junction + "flows with all of these faces.");
    CHECK(sentence(remark_on_junctions(2, Laplacian::AlexaWardetzky)) ==
          "2 vertices" + junction + "flow with all of these faces.");
    CHECK(test::contains(sentence(remark_on_repeated_faces(1)), "1 face has the same vertices"));
    CHECK(test::contains(sentence(remark_on_repeated_faces(2)), "2 faces have the same vertices"));
}
