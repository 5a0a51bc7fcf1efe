#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/state/flow_state.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"

using namespace seamflow;

namespace {

/// A region of consecutive numbers: about a tenth of the mesh, with vertices of several sub-meshes.
std::vector<Index> region_of(const PolygonMesh& mesh)
{
    std::vector<Index> region(usize(mesh.n_vertices() / 10));
    std::iota(region.begin(), region.end(), mesh.n_vertices() / 3);
    return region;
}

FlowOptions converged(FlowEquation flow, Laplacian laplacian, const PolygonMesh& mesh)
{
    const double edge = mean_edge_length(mesh);
    FlowOptions options{.laplacian = laplacian, .flow = flow, .time_step = 20.0 * edge * edge, .steps = 3};
    options.cut.subdomains = 9;
    options.accuracy = {.tolerance = 1e-11, .approach = Approach::Converged};
    return options;
}

/// Flat, so that nothing moves until it is changed.
PolygonMesh flat_mesh()
{
    PolygonMesh mesh = make_triangles(1500);
    mesh.vertices.col(2).setZero();
    return mesh;
}

/// The vertices lifted out of the plane.
Points lifted(const PolygonMesh& mesh, const std::vector<Index>& vertices)
{
    Points to(static_cast<Eigen::Index>(vertices.size()), 3);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        to.row(static_cast<Eigen::Index>(i)) =
            mesh.vertices.row(vertices[i]) + Point(0.0, 0.0, 0.02 * (1.0 + static_cast<double>(i % 3)));
    return to;
}

}  // namespace

TEST_CASE("vertices held before the first step are as if they had been fixed")
{
    for (const PolygonMesh& mesh : {make_mixed_polygons(1500), make_noisy_sphere(1500)})
        for (const FlowEquation flow : {FlowEquation::MeanCurvature, FlowEquation::Conformalized, FlowEquation::Linear})
            for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::VirtualRefinement}) {
                FlowOptions options = converged(flow, laplacian, mesh);
                PolygonMesh held = mesh;
                Flow changed(held, options);
                changed.hold(region_of(mesh));
                changed.step(3);
                options.motion.fixed_vertices = region_of(mesh);
                const Points expected = test::flowed(mesh, options);
                CHECK(test::largest_difference(held.vertices, expected) < 1e-8);
                for (const Index v : region_of(mesh))
                    CHECK(held.vertices.row(v) == mesh.vertices.row(v));
            }
}

TEST_CASE("vertices held between steps of one matrix are as if a flow began there, on any number of threads")
{
    // Δ_U does not depend on positions: a flow from the positions after a step has the same matrix.
    const PolygonMesh mesh = make_noisy_sphere(2500);
    FlowOptions options = converged(FlowEquation::Linear, Laplacian::Uniform, mesh);
    options.uniform_edge = mean_edge_length(mesh);
    Points with_other_threads;
    for (const int threads : {1, 3}) {
        options.resources.threads = threads;
        options.motion.fixed_vertices = {};
        PolygonMesh moved = mesh;
        Flow flow(moved, options);
        flow.step();
        flow.hold(region_of(mesh));
        PolygonMesh anew = moved;
        flow.step();
        flow.step();
        options.motion.fixed_vertices = region_of(mesh);
        Flow from_there(anew, options);
        from_there.step(2);
        CHECK(test::largest_difference(moved.vertices, anew.vertices) < 1e-8);
        flow.release(region_of(mesh));
        flow.step();
        options.motion.fixed_vertices = {};
        Flow free(anew, options);
        free.step();
        CHECK(test::largest_difference(moved.vertices, anew.vertices) < 1e-8);
        CHECK((threads == 1 || test::same_bits(moved.vertices, with_other_threads)));
        with_other_threads = moved.vertices;
    }
}

TEST_CASE("steps with vertices held on the interface are as exact as others, whatever vertices they are")
{
    const PolygonMesh mesh = make_noisy_sphere(400);
    const double edge = mean_edge_length(mesh);
    const double tolerance = 1e-10;
    double farthest = 0.0;
    for (Index stride = 5; stride < 25; ++stride) {
        FlowOptions options = converged(FlowEquation::MeanCurvature, Laplacian::Fujiwara, mesh);
        options.cut.subdomains = 5;
        options.accuracy.tolerance = tolerance;
        options.time_step = edge * edge;
        PolygonMesh moved = mesh;
        Flow flow(moved, options);
        flow.step();
        std::vector<Index> held;
        for (Index v = stride % 4; v < mesh.n_vertices(); v += stride)
            held.push_back(v);
        flow.hold(held);
        PolygonMesh expected = moved;
        flow.step();
        options.cut.subdomains = 0;
        options.accuracy = {.approach = Approach::Undecomposed};
        options.steps = 1;
        options.motion.fixed_vertices = held;
        mean_curvature_flow(expected, options);
        farthest = std::max(farthest, test::largest_difference(moved.vertices, expected.vertices));
        for (const Index v : held)
            CHECK(moved.vertices.row(v) == expected.vertices.row(v));
    }
    // The residual is small in units of what a step moves, and no vertex moves by more than an edge.
    CHECK(farthest < tolerance * edge);
}

TEST_CASE("with all of the interface held, interiors move as exactly")
{
    const PolygonMesh mesh = make_noisy_sphere(2000);
    FlowOptions options = converged(FlowEquation::MeanCurvature, Laplacian::Fujiwara, mesh);
    options.accuracy.tolerance = 1e-10;
    options.steps = 1;
    PolygonMesh moved = mesh;
    Flow flow(moved, options);
    const std::vector<Index>& labels = flow.report().cut.labels;
    std::vector<Index> label_of(usize(mesh.n_vertices()), -1);
    std::vector<Index> held;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (const Index v : mesh.face(f)) {
            if (label_of[v] >= 0 && label_of[v] != labels[f])
                held.push_back(v);
            label_of[v] = labels[f];
        }
    REQUIRE(held.size() > 100);
    flow.hold(held);
    flow.step();
    PolygonMesh expected = mesh;
    options.cut.subdomains = 0;
    options.accuracy = {.approach = Approach::Undecomposed};
    options.motion.fixed_vertices = held;
    mean_curvature_flow(expected, options);
    CHECK(test::largest_difference(moved.vertices, expected.vertices) < 1e-10 * mean_edge_length(mesh));
}

TEST_CASE("a region that is moved has the matrix of its new place, and fixed vertices can be moved, too")
{
    const PolygonMesh mesh = flat_mesh();
    const Topology topology = make_topology(mesh);
    std::vector<Index> region = region_of(mesh);
    for (Index v = 0; v < mesh.n_vertices() && std::ssize(region) < mesh.n_vertices() / 9; ++v)
        if (!topology.moves(v))
            region.push_back(v);
    const Points to = lifted(mesh, region);
    PolygonMesh lifted_mesh = mesh;
    for (std::size_t i = 0; i < region.size(); ++i)
        lifted_mesh.vertices.row(region[i]) = to.row(static_cast<Eigen::Index>(i));
    for (const FlowEquation flow : {FlowEquation::MeanCurvature, FlowEquation::Conformalized, FlowEquation::Linear})
        for (const bool attaches : {false, true}) {
            FlowOptions options = converged(flow, Laplacian::AlexaWardetzky, mesh);
            if (attaches)
                options.motion.attachment = 0.1 / options.time_step;
            PolygonMesh moved = mesh;
            Flow changed(moved, options);
            changed.step();
            CHECK(test::largest_difference(moved.vertices, mesh.vertices) < 1e-9);
            changed.move(region, to);
            CHECK(test::largest_difference(moved.vertices, lifted_mesh.vertices) < 1e-9);
            changed.step(2);
            PolygonMesh anew = lifted_mesh;
            Flow from_there(anew, options);
            from_there.step(2);
            CHECK(test::largest_difference(anew.vertices, lifted_mesh.vertices) > 1e-3);
            // What an attachment of mean curvature flows pulls to stays as it was.
            if (!attaches || flow != FlowEquation::MeanCurvature)
                CHECK(test::largest_difference(moved.vertices, anew.vertices) < 1e-8);
        }
}

TEST_CASE("weights of an attachment that change between steps are as if they had been so")
{
    const PolygonMesh mesh = make_noisy_sphere(1500);
    for (const FlowEquation flow : {FlowEquation::MeanCurvature, FlowEquation::Linear}) {
        FlowOptions options = converged(flow, Laplacian::Fujiwara, mesh);
        const std::vector<Index> region = region_of(mesh);
        options.motion.attachment_weights.assign(usize(mesh.n_vertices()), 0.5 / options.time_step);
        PolygonMesh moved = mesh;
        Flow changed(moved, options);
        changed.attach(region, std::vector<double>(region.size(), 40.0 / options.time_step));
        changed.step(2);
        for (const Index v : region)
            options.motion.attachment_weights[v] = 40.0 / options.time_step;
        options.steps = 2;
        CHECK(test::largest_difference(moved.vertices, test::flowed(mesh, options)) < 1e-8);
    }
}

TEST_CASE("changes are those of the given mesh, wherever it lies and whatever is joined")
{
    PolygonMesh mesh = test::height_fields(900)[0];
    mesh.vertices.rowwise() += Point(1e6, -2e6, 5e5);
    // A copy of a vertex, along a seam.
    const Index copied = mesh.n_vertices() / 2 + 15;
    const Index copy = mesh.n_vertices();
    mesh.vertices.conservativeResize(copy + 1, 3);
    mesh.vertices.row(copy) = mesh.vertices.row(copied);
    const auto corner = std::ranges::find(mesh.face_vertices, copied);
    *corner = copy;
    FlowOptions options = converged(FlowEquation::Linear, Laplacian::Fujiwara, mesh);
    PolygonMesh moved = mesh;
    Flow flow(moved, options);
    flow.step();
    flow.hold(std::vector<Index>{copy});
    const Points there = moved.vertices;
    flow.step();
    CHECK(moved.vertices.row(copied) == there.row(copied));
    CHECK(moved.vertices.row(copy) == there.row(copy));
    CHECK(there.row(copy) != mesh.vertices.row(copy));
    const Point to = moved.vertices.row(copied) + Point(0.0, 0.0, 0.25);
    flow.move(std::vector<Index>{copied}, to);
    CHECK((moved.vertices.row(copied) - to).norm() < 1e-9);
    CHECK((moved.vertices.row(copy) - to).norm() < 1e-9);
    flow.step();
    CHECK((moved.vertices.row(copy) - to).norm() < 1e-9);
}

TEST_CASE("conjugate gradients and sweeps of the mean curvature flow go on from where vertices are put")
{
    const PolygonMesh mesh = flat_mesh();
    const std::vector<Index> region = region_of(mesh);
    const Points to = lifted(mesh, region);
    for (const Approach approach : {Approach::ConjugateGradients, Approach::Sweep, Approach::Undecomposed}) {
        FlowOptions options = converged(FlowEquation::MeanCurvature, Laplacian::Fujiwara, mesh);
        options.accuracy = {.approach = approach};
        if (approach != Approach::Sweep)
            options.cut = {};
        PolygonMesh moved = mesh;
        Flow flow(moved, options);
        flow.move(region, to);
        const Points before = moved.vertices;
        flow.step();
        PolygonMesh anew = mesh;
        anew.vertices = before;
        options.steps = 1;
        // Of sweeps, curvature before the first step orders the colours.
        CHECK(test::largest_difference(moved.vertices, test::flowed(anew, options)) <
              (approach == Approach::Sweep ? 0.02 : 1e-3));
        CHECK(test::largest_difference(moved.vertices, before) > 1e-3);
        const std::string message = test::message_of([&] { flow.hold(region); });
        CHECK(message.find("converged") != std::string::npos);
    }
}

TEST_CASE("components that shrink to points are held, released and attached like others")
{
    PolygonMesh mesh = make_noisy_sphere(400);
    const Index n = mesh.n_vertices();
    const PolygonMesh small = make_noisy_sphere(100);
    for (Index f = 0; f < small.n_faces(); ++f) {
        std::vector<Index> corners(small.face(f).begin(), small.face(f).end());
        for (Index& v : corners)
            v += n;
        mesh.add_face(corners);
    }
    mesh.vertices.conservativeResize(n + small.n_vertices(), 3);
    const Points table = 1e-4 * small.vertices;
    mesh.vertices.bottomRows(small.n_vertices()) = table.rowwise() + Point(3.0, 0.0, 0.0);
    FlowOptions options = converged(FlowEquation::MeanCurvature, Laplacian::Fujiwara, mesh);
    options.time_step = 0.5;
    options.cut.subdomains = 4;
    options.motion.attachment_weights.assign(usize(mesh.n_vertices()), 0.0);
    options.motion.attachment_weights[0] = 1e-3;
    std::vector<Index> all_small(usize(small.n_vertices()));
    std::iota(all_small.begin(), all_small.end(), n);
    const std::vector<Index> one{n + 5};

    PolygonMesh moved = mesh;
    Flow flow(moved, options);
    flow.step();
    flow.hold(one);
    const Point held = moved.vertices.row(n + 5);
    flow.step();
    CHECK(moved.vertices.row(n + 5) == held);
    flow.release(one);
    flow.step(2);
    CHECK(moved.vertices.allFinite());

    // Stronger on one side, to which they pull.
    std::vector<double> strong(all_small.size(), 4.0);
    std::fill(strong.begin(), strong.begin() + 20, 40.0);
    PolygonMesh attached = mesh;
    Flow changed(attached, options);
    changed.attach(all_small, strong);
    changed.step();
    std::ranges::copy(strong, options.motion.attachment_weights.begin() + n);
    options.steps = 1;
    CHECK(test::largest_difference(attached.vertices, test::flowed(mesh, options)) < 1e-9);
}

TEST_CASE("a small component that is moved flows as if it had been there from the beginning")
{
    const PolygonMesh mesh =
        test::together({test::ball(1.0, {0.0, 0.0, 0.0}, 400), test::ball(1e-4, {3.0, 0.0, 0.0}, 100)});
    const Index n = mesh.n_vertices() - 100;
    std::vector<Index> small(100);
    std::iota(small.begin(), small.end(), n);
    FlowOptions options = converged(FlowEquation::Conformalized, Laplacian::Fujiwara, mesh);
    options.time_step = 0.5;
    options.cut.subdomains = 4;
    options.motion.attachment = 1.0;
    options.steps = 1;
    PolygonMesh there = mesh;
    there.vertices.bottomRows(100).rowwise() += Point(0.0, 1.0, 0.0);
    PolygonMesh moved = mesh;
    Flow flow(moved, options);
    flow.move(small, there.vertices.bottomRows(100));
    flow.step();
    CHECK(test::largest_difference(moved.vertices, test::flowed(there, options)) < 1e-8);
}

TEST_CASE("vertices without faces go where they are put, also far from the origin, and limits go along")
{
    for (const double far : {0.0, 1e6}) {
        PolygonMesh mesh = make_noisy_sphere(600);
        const Index isolated = mesh.n_vertices();
        mesh.vertices.conservativeResize(isolated + 1, 3);
        mesh.vertices.row(isolated) = Point(0.5, 0.5, 0.5);
        mesh.vertices.col(0).array() += far;
        FlowOptions options = converged(FlowEquation::Linear, Laplacian::Uniform, mesh);
        PolygonMesh moved = mesh;
        Flow flow(moved, options);
        const Point there(far + 7.0, 1.0, 2.0);
        flow.move(std::vector<Index>{isolated}, there);
        flow.step();
        CHECK(moved.vertices.row(isolated) == there);
        // Further than the mesh was wide.
        flow.move(std::vector<Index>{3}, Point(far + 50.0, 0.0, 0.0));
        flow.step();
        CHECK(moved.vertices(3, 0) < far + 40.0);
    }
}

TEST_CASE("changes that cannot be are refused, and nothing has changed")
{
    const PolygonMesh mesh = make_mixed_polygons(600);
    const Topology topology = make_topology(mesh);
    FlowOptions options = converged(FlowEquation::Linear, Laplacian::Fujiwara, mesh);
    const Points expected = test::flowed(mesh, options);
    PolygonMesh moved = mesh;
    std::string of_capture;
    bool is_changed = false;
    Flow flow(moved, options, [&](const StepState& state) {
        of_capture = test::message_of([&] { (void)state.capture(); });
        CHECK(of_capture.empty() != is_changed);
    });
    flow.step();
    CHECK_THROWS_AS(flow.hold(std::vector<Index>{mesh.n_vertices()}), InputError);
    CHECK_THROWS_AS(flow.hold(std::vector<Index>{-1}), InputError);
    CHECK_THROWS_AS(flow.move(std::vector<Index>{1, 2}, Points::Zero(1, 3)), OptionError);
    CHECK_THROWS_AS(flow.move(std::vector<Index>{1}, Points::Constant(1, 3, std::nan(""))), OptionError);
    CHECK_THROWS_AS(flow.attach(std::vector<Index>{1}, std::vector<double>{1.0}), OptionError);
    // Onto the vertex beside it.
    const Index corner = mesh.face(mesh.n_faces() / 2)[0];
    const Point onto = moved.vertices.row(mesh.face(mesh.n_faces() / 2)[1]);
    CHECK_THROWS_AS(flow.move(std::vector<Index>{corner}, onto), InputError);
    Index fixed = 0;
    while (topology.moves(fixed))
        ++fixed;
    const std::string message = test::message_of([&] { flow.release(std::vector<Index>{fixed}); });
    CHECK(message.starts_with("vertex " + std::to_string(fixed) + " was fixed when the flow began"));
    flow.step(2);
    CHECK(test::same_bits(moved.vertices, expected));
    flow.hold(region_of(mesh));
    is_changed = true;
    flow.step();

    options.motion.attachment = 1.0;
    Flow attached(moved, options,
                  [&](const StepState& state) { of_capture = test::message_of([&] { (void)state.capture(); }); });
    attached.step();
    CHECK(of_capture.empty());
    attached.attach(std::vector<Index>{1}, std::vector<double>{2.0});
    attached.step();
    CHECK(of_capture.starts_with("a flow that was changed between its steps"));
    CHECK_THROWS_AS(attached.attach(std::vector<Index>{1, 2}, std::vector<double>{1.0}), OptionError);
    CHECK_THROWS_AS(attached.attach(std::vector<Index>{1}, std::vector<double>{-1.0}), OptionError);
    options.report.reference = true;
    Flow with_reference(moved, options);
    CHECK_THROWS_AS(with_reference.hold(region_of(mesh)), OptionError);
    options.report.reference = false;
    options.motion.within = 0.1;
    Flow within(moved, options);
    CHECK_THROWS_AS(within.move(std::vector<Index>{1}, Points::Zero(1, 3)), OptionError);
}
