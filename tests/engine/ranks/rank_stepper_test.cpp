#include <cstring>
#include <limits>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diffuse.h"
#include "engine/mean_curvature_flow.h"
#include "engine/state/flow_state.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "tests/engine/ranks/rank_flows.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/flows.h"
#include "tests/support/junction_meshes.h"
#include "tests/support/option_cases.h"
#include "tests/support/writings.h"

using namespace seamflow;
using test::by_sweeps;
using test::check_bits;
using test::check_same;
using test::converged;
using test::Flowed;
using test::flowed_on;
using test::flowed_with;
using test::on_ranks;

TEST_CASE("ranks find the bits of one process: any polygons, every Laplacian")
{
    for (const PolygonMesh& mesh : test::height_fields(600)) {
        for (const Laplacian laplacian : test::all_laplacians)
            check_bits("sweeps", mesh, by_sweeps(laplacian, 2e-3), 9, {3});
        for (const Laplacian laplacian : test::symmetric_laplacians)
            check_bits("converged", mesh, converged(laplacian, 3e-2), 9, {3});
    }
}

TEST_CASE("ranks find the bits of one process: any number of them, surfaces of any kind")
{
    const std::vector<int> some{1, 2, 3, 5, 8};
    for (const FlowOptions& options : {by_sweeps(Laplacian::Fujiwara, 3e-2), converged(Laplacian::Fujiwara, 3e-2),
                                       converged(Laplacian::Fujiwara, 1e-4)}) {
        check_bits("torus", test::triangle_torus(30, 24), options, 11, some);
        check_bits("band", test::moebius_band(60, 8), options, 7, some);
        check_bits("three",
                   test::side_by_side({test::triangle_torus(16, 12), make_hexagons(400), test::cylinder(12, 20)}),
                   options, 10, some);
        // Fewer sub-meshes than ranks: some have nothing. Sub-meshes without anything in common.
        check_bits("two", make_triangles(600), options, 2, some);
        check_bits("apart", test::side_by_side({make_triangles(300), make_hexagons(300)}), options, 2, {2, 3});
    }
}

TEST_CASE("ranks find the bits of one process: every kind of flow and every option, whether they share it or not")
{
    int n_shared = 0;
    int n_alone = 0;
    const auto check = [&](const std::string& name, const PolygonMesh& mesh, AllOptions options) {
        CAPTURE(name);
        options.resources.threads = 1;
        // What is left open is chosen so that ranks can share it.
        if (options.accuracy.approach == Approach::Automatic && !options.accuracy.tolerance)
            return;
        if (options.accuracy.approach == Approach::Automatic)
            options.accuracy.approach = Approach::Converged;
        if (options.accuracy.approach == Approach::Converged && options.cut.labels.empty())
            options.cut.subdomains = 8;
        const Flowed expected = flowed_with(mesh, options, {});
        on_ranks(3, [&](RankGroup& ranks) {
            const Flowed found = flowed_on(ranks, mesh, options);
            const bool is_shared = !found.report.ranks.empty();
            ++(is_shared ? n_shared : n_alone);
            check_same(found, expected, is_shared ? 3 : 0);
        });
    };
    const PolygonMesh mesh = make_mixed_polygons(700);
    for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh)))
        check(kind.name, mesh, kind.options);
    const PolygonMesh ball = test::rimmed_ball();
    const double edge = mean_edge_length(ball);
    for (const test::OptionCase& option : test::option_cases()) {
        AllOptions options = test::options_without_cases(edge);
        option.set(options, ball, edge);
        check(option.name(), ball, options);
    }
    CHECK(n_shared > 60);
    CHECK(n_alone > 20);
    for (FlowOptions options : {by_sweeps(Laplacian::Fujiwara, 2e-3), converged(Laplacian::Fujiwara, 2e-3)}) {
        options.resources.threads = 3;
        options.motion.rescale = Rescale::Volume;
        check_bits("threads, rescaled", make_noisy_sphere(800), options, 8, {2, 5});
    }
    FlowOptions options = converged(Laplacian::Fujiwara, 1e-2);
    options.flow = FlowEquation::Linear;
    options.resources.memory_limit = 150'000;
    check_bits("linear, factors made again", mesh, options, 20, {3});
}

TEST_CASE("ranks find the bits of one process: meshes that are not as they should be")
{
    for (const FlowOptions& options : {by_sweeps(Laplacian::Fujiwara, 1e-2), converged(Laplacian::Fujiwara, 1e-2)}) {
        PolygonMesh mesh = make_mixed_polygons(600);
        mesh.vertices.rowwise() += Point(1e6, -3e5, 1e7);
        check_bits("far", mesh, options, 8, {3});
        mesh = make_mixed_polygons(500);
        for (Index f = 0; f < 300; f += 7)
            mesh.add_face(std::vector<Index>(mesh.face(f).begin(), mesh.face(f).end()));
        check_bits("repeated faces", mesh, options, 8, {3});
        mesh = make_triangles(600);
        const auto corners = mesh.face(300);
        for (const Index v : corners)
            mesh.vertices.row(v) = mesh.vertices.row(corners.front()).eval();
        check_bits("a face without area", mesh, options, 8, {3});
        check_bits("sheets that meet", test::foam(12, 5, 3), options, 8, {3});
        // One so small that the step leaves a point of it.
        PolygonMesh speck = make_noisy_sphere(200);
        speck.vertices *= 1e-6;
        check_bits("vanishing", test::side_by_side({make_triangles(600), speck}), options, 8, {3});
    }
}

TEST_CASE("where the approach is left open it is one that ranks can share, and a flow resumes with and without them")
{
    const PolygonMesh mesh = make_noisy_sphere(6000);
    FlowOptions options = by_sweeps(Laplacian::Fujiwara, 1e-4, 4);
    options.accuracy.approach = Approach::Automatic;
    Flowed alone;
    on_ranks(1, [&](RankGroup& ranks) { alone = flowed_on(ranks, mesh, options); });
    CHECK(alone.report.convergence.approach == Approach::Sweep);
    on_ranks(3, [&](RankGroup& ranks) {
        check_same(flowed_on(ranks, mesh, options), alone, 3);
        FlowControl control;
        control.resume = std::make_shared<const FlowState>(alone.states[1]);
        CHECK(test::same_bits(flowed_on(ranks, mesh, options, control).positions, alone.positions));
        CHECK(test::same_bits(flowed_with(mesh, options, control).positions, alone.positions));
        // A flow that has begun in another way keeps to it.
        const Flowed other = flowed_with(mesh, options, {});
        control.resume = std::make_shared<const FlowState>(other.states[1]);
        CHECK(test::same_bits(flowed_on(ranks, mesh, options, control).positions, other.positions));
        auto damaged = std::make_shared<FlowState>(alone.states[1]);
        damaged->flow.numbers.push_back(1.0);
        control.resume = damaged;
        CHECK_THROWS_AS(flowed_on(ranks, mesh, options, control), InputError);
    });
}

TEST_CASE("ranks on one machine share its threads, unless each is to have some number")
{
    const PolygonMesh mesh = make_hexagons(600);
    FlowOptions options = by_sweeps(Laplacian::Fujiwara, 2e-3);
    options.cut.subdomains = 9;
    for (const int n : {2, 3})
        for (const int of_each : {0, 2}) {
            CAPTURE(n);
            CAPTURE(of_each);
            on_ranks(n, 4 * n, [&](RankGroup& ranks) {
                CHECK(ranks.n_on_this_machine() == n);
                options.resources.threads = of_each;
                const FlowReport report = flowed_on(ranks, mesh, options).report;
                REQUIRE(report.ranks.size() == static_cast<std::size_t>(n));
                for (std::size_t rank = 1; rank < report.ranks.size(); ++rank)
                    CHECK(report.ranks[rank].threads == (of_each > 0 ? of_each : 4));
            });
        }
}

TEST_CASE("ranks share fields that diffuse")
{
    // No edge has to be flipped.
    const PolygonMesh mesh = make_quads(700);
    Eigen::MatrixXd fields = Eigen::MatrixXd::Random(mesh.n_vertices(), 5);
    fields(17, 2) = std::numeric_limits<double>::quiet_NaN();
    FlowOptions options = by_sweeps(Laplacian::Fujiwara, 1e-2);
    options.accuracy.tolerance = 1e-8;
    options.accuracy.approach = Approach::Converged;
    options.cut.subdomains = 7;
    for (const int kind : {0, 1, 2}) {
        FieldOptions of_fields;
        if (kind == 1)
            of_fields.fwhm = 0.1;
        if (kind == 2)
            of_fields.keep_edges = 0.1;
        of_fields.fill = kind != 2;
        FlowOptions own = options;
        if (of_fields.fwhm)
            own.time_step = 0.0;
        Eigen::MatrixXd expected = fields;
        diffuse(mesh, expected, own, of_fields);
        on_ranks(3, [&](RankGroup& ranks) {
            Eigen::MatrixXd found = fields;
            FlowControl control;
            control.ranks = &ranks;
            const FieldReport report = diffuse(mesh, found, own, of_fields, control);
            CHECK(std::memcmp(found.data(), expected.data(), sizeof(double) * static_cast<std::size_t>(found.size())) ==
                  0);
            CHECK(report.flow.ranks.empty() == of_fields.keep_edges.has_value());
        });
    }
}

TEST_CASE("flows that ranks share can be changed between steps only by moving vertices")
{
    PolygonMesh mesh = make_triangles(600);
    FlowOptions options = converged(Laplacian::Fujiwara, 1e-2);
    options.cut.subdomains = 6;
    const std::vector<Index> some{100, 250, 400};
    const Points to = mesh.vertices(some, Eigen::all) * 1.01;
    PolygonMesh expected = mesh;
    Flow alone(expected, options);
    alone.step();
    alone.move(some, to);
    alone.step();
    on_ranks(3, [&](RankGroup& ranks) {
        FlowControl control;
        control.ranks = &ranks;
        Flow flow(mesh, options, {}, control);
        flow.step();
        CHECK_THROWS_AS(flow.hold(some), OptionError);
        flow.move(some, to);
        flow.step();
        CHECK(test::same_bits(mesh.vertices, expected.vertices));
    });
}

TEST_CASE("what fails in a step is thrown on rank 0, and ranks then serve the next flow")
{
    const PolygonMesh mesh = make_triangles(600);
    FlowOptions options = converged(Laplacian::Fujiwara, 1e-2);
    options.cut.subdomains = 6;
    on_ranks(3, [&](RankGroup& ranks) {
        FlowControl control;
        control.ranks = &ranks;
        PolygonMesh moved = mesh;
        std::stop_source source;
        control.stop = source.get_token();
        CHECK_THROWS_AS(mean_curvature_flow(
                            moved, options, [&](const StepState&) { source.request_stop(); }, control),
                        Cancelled);
        control.stop = {};
        CHECK_THROWS_AS(mean_curvature_flow(
                            moved, options, [](const StepState&) { throw OutputError("the disk is full"); }, control),
                        OutputError);
        FlowOptions scarce = options;
        scarce.resources.memory_limit = 10;
        CHECK_THROWS_AS(mean_curvature_flow(moved, scarce, {}, control), OptionError);
        check_same(flowed_on(ranks, mesh, options), flowed_with(mesh, options, {}), 3);
    });
}
