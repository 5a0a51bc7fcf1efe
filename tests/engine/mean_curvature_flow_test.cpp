#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/measure/remarks.h"
#include "engine/measure/surface_measures.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/flows.h"

using namespace seamflow;

namespace {

FlowOptions two_step_options(Index subdomains)
{
    FlowOptions options;
    options.time_step = 0.001;
    options.steps = 2;
    options.cut.subdomains = subdomains;
    return options;
}

}  // namespace

TEST_CASE("the report tells what was done")
{
    PolygonMesh mesh = make_quads(2000);
    FlowOptions options = two_step_options(6);
    options.report.reference = true;
    int calls = 0;
    const FlowReport report = mean_curvature_flow(mesh, options, [&](const StepState& state) {
        CHECK(state.step == ++calls);
        CHECK(state.positions.rows() == mesh.n_vertices());
        REQUIRE(state.reference_positions != nullptr);
        const VertexDistance distance = vertex_distance(mesh, *state.reference_positions, state.positions);
        CHECK(distance.max == state.report.distance->max);
    });
    CHECK(calls == 2);
    CHECK(report.mesh.vertices == mesh.n_vertices());
    CHECK(report.mesh.faces == mesh.n_faces());
    CHECK(report.cut.n_sub_meshes() == 6);
    Index n_faces = 0;
    std::set<Index> colours;
    for (const SubMeshReport& sub_mesh : report.cut.sub_meshes) {
        CHECK(sub_mesh.p > 1.0);
        n_faces += sub_mesh.faces;
        colours.insert(sub_mesh.colour);
    }
    CHECK(n_faces == mesh.n_faces());
    CHECK(report.cut.labels.size() == usize(mesh.n_faces()));
    CHECK(static_cast<Index>(colours.size()) == report.cut.n_colours());
    CHECK(report.cut.interface_vertices > 50);
    CHECK(report.time_step == 0.001);
    REQUIRE(report.steps.size() == 2);
    const auto curvature_of = [&](const PolygonMesh& surface) {
        return largest_curvature(
            measure_curvature(surface, make_topology(surface), surface.vertices, options.laplacian));
    };
    CHECK(report.steps[0].max_mean_curvature_before == curvature_of(make_quads(2000)));
    CHECK(report.steps[1].max_mean_curvature_after == curvature_of(mesh));
    CHECK(report.steps[1].max_mean_curvature_before == report.steps[0].max_mean_curvature_after);
    REQUIRE(report.steps[1].distance);
    CHECK(report.steps[1].distance->mean > 0.0);
    CHECK(report.steps[1].distance->max < mean_edge_length(mesh));
    const PhaseSeconds& seconds = report.seconds;
    for (const double phase :
         {seconds.cut, seconds.analyse, seconds.assemble, seconds.factorise, seconds.solve, seconds.correct})
        CHECK(phase > 0.0);
    CHECK(seconds.total >= seconds.cut + seconds.analyse + seconds.step);
}

TEST_CASE("a large mesh that is not cut is factorised by several threads, with the same bits")
{
    const PolygonMesh mesh = make_triangles(40'000);
    const auto result = [&](int threads) {
        FlowOptions options = two_step_options(1);
        options.resources.threads = threads;
        return test::flowed(mesh, options);
    };
    const Points expected = result(1);
    for (const int threads : {2, 3, 7})
        CHECK(result(threads) == expected);
}

TEST_CASE("sweeps alternate with more than two sub-meshes, unless told otherwise")
{
    const PolygonMesh mesh = make_triangles(2000);
    const auto result = [&](Index subdomains, Sweep sweep) {
        FlowOptions options = two_step_options(subdomains);
        options.interface.sweep = sweep;
        return test::flowed(mesh, options);
    };
    CHECK(result(8, Sweep::Automatic) == result(8, Sweep::Alternating));
    CHECK(result(8, Sweep::Automatic) != result(8, Sweep::Fixed));
    CHECK(result(2, Sweep::Automatic) == result(2, Sweep::Fixed));
    CHECK(result(2, Sweep::Automatic) != result(2, Sweep::Alternating));
}

TEST_CASE("the plain options are the paper's: a fixed sweep")
{
    CHECK(FlowOptions::plain().interface.sweep == Sweep::Fixed);
    CHECK(FlowOptions::plain().interface.correction == Correction::Automatic);
    CHECK_FALSE(FlowOptions::plain().interface.p);
}

TEST_CASE("zero steps leave the mesh as it is")
{
    const PolygonMesh mesh = make_triangles(400);
    FlowOptions options = two_step_options(4);
    options.steps = 0;
    CHECK(test::flowed(mesh, options) == mesh.vertices);
}

TEST_CASE("meshes with nothing to move come out as they went in")
{
    PolygonMesh nothing;
    CHECK(mean_curvature_flow(nothing, two_step_options(4)).cut.n_sub_meshes() == 0);

    PolygonMesh points;
    points.vertices = Points::Random(5, 3);
    CHECK(test::flowed(points, two_step_options(4)) == points.vertices);

    PolygonMesh triangle;
    triangle.vertices = Points::Random(3, 3);
    triangle.add_face(std::vector<Index>{0, 1, 2});
    for (const Index subdomains : {0, 1, 2, 100})
        CHECK(test::flowed(triangle, two_step_options(subdomains)) == triangle.vertices);
}

TEST_CASE("non-manifold meshes flow, with their non-manifold vertices fixed, and the report says so")
{
    for (PolygonMesh mesh : {test::hourglass(), test::three_wings(), test::bow_tie()}) {
        const Points before = mesh.vertices;
        const Topology topology = make_topology(mesh);
        FlowReport report = mean_curvature_flow(mesh, two_step_options(2));
        CHECK(mesh.vertices.allFinite());
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if (topology.kind[v] == VertexKind::NonManifold)
                CHECK(mesh.vertices.row(v) == before.row(v));
        const Remark remark = remark_on_non_manifold_vertices(report.mesh.non_manifold_vertices);
        CHECK(std::ranges::count(report.remarks, remark) == (report.mesh.non_manifold_vertices > 0 ? 1 : 0));
    }
}

TEST_CASE("labels, weights and strengths that do not fit the mesh are refused")
{
    PolygonMesh mesh = make_triangles(400);
    FlowOptions options = two_step_options(0);
    options.cut.labels = {0, 1, 2};
    CHECK_THROWS_AS(mean_curvature_flow(mesh, options), InputError);
    options.cut.labels.assign(mesh.n_faces(), 0);
    options.cut.labels[7] = -3;
    CHECK_THROWS_WITH_AS(mean_curvature_flow(mesh, options), doctest::Contains("face 7"), InputError);
    options = two_step_options(0);
    options.motion.attachment_weights = {1.0, 2.0};
    CHECK_THROWS_WITH_AS(mean_curvature_flow(mesh, options), doctest::Contains("there are 2 attachment"), InputError);
    options = two_step_options(0);
    options.motion.strength = {1.0, 0.5, 0.0};
    CHECK_THROWS_WITH_AS(mean_curvature_flow(mesh, options), doctest::Contains("there are 3 "), InputError);
}

TEST_CASE("geometry that a Laplacian would divide by zero on is refused by strict with the element's number")
{
    PolygonMesh mesh = make_triangles(400);
    const Index v = mesh.n_vertices() / 2;
    const Index f = make_topology(mesh).face_of[make_topology(mesh).corners_at(v)[0]];
    mesh.vertices.row(mesh.face(f)[0]) = mesh.vertices.row(mesh.face(f)[1]);
    for (const Laplacian laplacian : test::geometric_laplacians) {
        FlowOptions options = two_step_options(4);
        options.laplacian = laplacian;
        options.motion.strict = true;
        CHECK_THROWS_WITH_AS(mean_curvature_flow(mesh, options), doctest::Contains("numbered from 0"), InputError);
    }
}

TEST_CASE("a computation that fails names the sub-mesh and leaves the last complete step")
{
    // Coordinates whose squares overflow: finite input, equations that are not.
    PolygonMesh mesh = make_triangles(400);
    mesh.vertices *= 1e200;
    const Points before = mesh.vertices;
    FlowOptions options = two_step_options(4);
    options.laplacian = Laplacian::AlexaWardetzky;
    options.interface.p = 1.0;
    CHECK_THROWS_AS(mean_curvature_flow(mesh, options), std::runtime_error);
    CHECK(mesh.vertices == before);
}

TEST_CASE("the decomposed flow stays nearer to the undecomposed one than with the paper's conditions")
{
    for (const Laplacian laplacian : test::all_laplacians) {
        CAPTURE(name_of(laplacian));
        FlowOptions options;
        options.laplacian = laplacian;
        options.time_step = 0.003;
        options.steps = 4;
        options.cut.subdomains = 8;
        options.report.reference = true;
        const auto distance = [&](Transmission transmission) {
            options.interface.transmission = transmission;
            PolygonMesh mesh = make_quads(2000);
            return mean_curvature_flow(mesh, options).steps.back().distance->rms;
        };
        CHECK(distance(Transmission::Predicted) < 0.8 * distance(Transmission::Derivative));
    }
}

TEST_CASE("with adapted conditions the interface is corrected, unless that is not wanted")
{
    const PolygonMesh mesh = make_quads(900);
    for (const Conditions conditions : {Conditions::AdaptedRobin, Conditions::AdaptedVentcell}) {
        FlowOptions options = two_step_options(4);
        options.interface.conditions = conditions;
        if (conditions == Conditions::AdaptedVentcell)
            options.interface.q = 0.2;
        const Points by_default = test::flowed(mesh, options);
        options.interface.correction = Correction::Centroid;
        CHECK(test::flowed(mesh, options) == by_default);
        options.interface.correction = Correction::None;
        CHECK(test::largest_difference(test::flowed(mesh, options), by_default) > 1e-6);
    }
}

TEST_CASE("the Ventcell parameter may be 0, which leaves Robin's conditions")
{
    const PolygonMesh mesh = make_quads(900);
    FlowOptions options = two_step_options(4);
    options.interface.transmission = Transmission::Derivative;
    const Points robin = test::flowed(mesh, options);
    options.interface.conditions = Conditions::AdaptedVentcell;
    options.interface.q = 0.0;
    CHECK(test::flowed(mesh, options) == robin);
}

TEST_CASE("a converged step of a mesh at rest asks for no more than rounding leaves")
{
    PolygonMesh mesh = make_mixed_polygons(900);
    mesh.vertices.col(2).setZero();
    for (const Laplacian laplacian : {Laplacian::AlexaWardetzky, Laplacian::PtackovaVelho}) {
        FlowOptions options = two_step_options(5);
        options.laplacian = laplacian;
        options.accuracy.tolerance = 1e-8;
        options.time_step = 0.02;
        const FlowReport report = mean_curvature_flow(mesh, options);
        CHECK(report.convergence.steps_short_of_tolerance == 0);
        CHECK(report.convergence.steps_stagnated == 0);
    }
}

TEST_CASE("what is recorded or not measured changes no result, and what is not is 0 or missing in the report")
{
    const PolygonMesh mesh = make_mixed_polygons(600);
    for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh))) {
        CAPTURE(kind.name);
        AllOptions options = kind.options;
        const Points expected = test::flowed(mesh, options);
        options.report.measures = false;
        options.report.record_schedule = true;
        PolygonMesh moved = mesh;
        const FlowReport report = smooth_surface(moved, options);
        CHECK(test::same_bits(moved.vertices, expected));
        CHECK(!report.displacement.has_value());
        for (const StepReport& step : report.steps) {
            CHECK(step.displacement.normal.max == 0.0);
            CHECK(step.max_mean_curvature_before == 0.0);
            CHECK(step.max_mean_curvature_after == 0.0);
        }
    }
}
