#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"

using namespace seamflow;
using test::ball;
using test::flowed;
using test::together;

namespace {

struct Way {
    std::string name;
    FlowOptions options;
};

std::vector<Way> all_ways(double time_step)
{
    std::vector<Way> ways;
    const auto add = [&](const std::string& name, const std::function<void(FlowOptions&)>& change) {
        FlowOptions options;
        options.time_step = time_step;
        options.steps = 3;
        options.accuracy.approach = Approach::Sweep;
        options.cut.subdomains = 5;
        change(options);
        ways.push_back({name, options});
    };
    for (const Laplacian laplacian : test::geometric_laplacians) {
        const std::string of(name_of(laplacian));
        add(of + ", sweeps", [&](FlowOptions& o) { o.laplacian = laplacian; });
        add(of + ", converged", [&](FlowOptions& o) { o.laplacian = laplacian, o.accuracy.tolerance = 1e-9; });
        add(of + ", undecomposed", [&](FlowOptions& o) {
            o.laplacian = laplacian, o.cut.subdomains = 0, o.accuracy.approach = Approach::Undecomposed;
        });
        add(of + ", with reference", [&](FlowOptions& o) { o.laplacian = laplacian, o.report.reference = true; });
    }
    for (const Laplacian laplacian : test::symmetric_geometric_laplacians)
        add(std::string(name_of(laplacian)) + ", cg", [&](FlowOptions& o) {
            o.laplacian = laplacian, o.cut.subdomains = 0, o.accuracy.approach = Approach::ConjugateGradients;
        });
    for (const Laplacian laplacian : test::symmetric_geometric_laplacians)
        add(std::string(name_of(laplacian)) + ", conformalized",
            [&](FlowOptions& o) { o.laplacian = laplacian, o.flow = FlowEquation::Conformalized; });
    for (const Laplacian laplacian : test::symmetric_geometric_laplacians) {
        const auto linear = [&](FlowOptions& o) { o.laplacian = laplacian, o.flow = FlowEquation::Linear; };
        add(std::string(name_of(laplacian)) + ", linear",
            [&](FlowOptions& o) { linear(o), o.accuracy.tolerance = 1e-9; });
        add(std::string(name_of(laplacian)) + ", linear, undecomposed",
            [&](FlowOptions& o) { linear(o), o.cut.subdomains = 0, o.accuracy.approach = Approach::Undecomposed; });
    }
    add("low-pass", [](FlowOptions& o) { o.filter = Filter::LowPass, o.order = 3; });
    add("order 2", [](FlowOptions& o) { o.order = 2; });
    add("attached", [&](FlowOptions& o) { o.motion.attachment = 1.0 / time_step; });
    add("robin", [](FlowOptions& o) { o.interface.conditions = Conditions::Robin; });
    add("Schwarz", [](FlowOptions& o) { o.interface.conditions = Conditions::Schwarz; });
    return ways;
}

/// A ball with a dent and unequal edges, whose centroid is not the mean of its vertices.
PolygonMesh dented_ball(double size, const Point& centre, Index n)
{
    PolygonMesh mesh = ball(1.0, {0.0, 0.0, 0.0}, n);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        mesh.vertices.row(v) *= 1.0 + 0.4 * mesh.vertices(v, 0) + 0.2 * std::sin(3.0 * mesh.vertices(v, 1));
    mesh.vertices *= size;
    mesh.vertices.rowwise() += centre;
    return mesh;
}

double diagonal_of(const PolygonMesh& mesh)
{
    return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
}

bool is_point(const Points& points)
{
    return (points.rowwise() - Point(points.row(0))).cwiseAbs().maxCoeff() == 0.0;
}

}  // namespace

TEST_CASE("components a million times smaller stay where they are, whatever the way of taking steps")
{
    const Index n = 300;
    const PolygonMesh large = ball(1.0, {0.0, 0.0, 0.0}, n);
    for (const double size : {1e-5, 1e-6, 1e-9, 1e-12}) {
        const std::vector<Point> centres{{3.0, 0.0, 0.0}, {-2.0, 5.0, 1.0}};
        const PolygonMesh both = together({large, ball(size, centres.front(), 100), ball(size, centres.back(), 100)});
        const Index n_large = large.n_vertices();
        const Index n_small = (both.n_vertices() - n_large) / 2;
        const Points begun = both.vertices;
        for (const Way& way : all_ways(0.002)) {
            CAPTURE(size);
            CAPTURE(way.name);
            PolygonMesh mesh = both;
            const FlowReport report = mean_curvature_flow(mesh, way.options);
            REQUIRE(mesh.vertices.allFinite());
            for (int i = 0; i < 2; ++i) {
                const Points before = begun.middleRows(n_large + i * n_small, n_small);
                const Points after = mesh.vertices.middleRows(n_large + i * n_small, n_small);
                const Point centre = before.colwise().mean();
                const double radius = (before.rowwise() - centre).rowwise().norm().maxCoeff();
                // A point in the middle of the component, as far as coordinates resolve it.
                if (way.options.flow != FlowEquation::Linear) {
                    CHECK(is_point(after));
                    CHECK((after.row(0) - centre).norm() < 0.2 * radius);
                } else if (size > 1e-10) {
                    CHECK((after.rowwise() - centre).rowwise().norm().maxCoeff() < 0.2 * radius);
                } else {
                    CHECK(test::largest_difference(after, before) <= 2.0 * radius);
                }
            }
            const auto n_remarks = std::ranges::count(
                test::sentences(report.remarks),
                "2 components are so small compared with the amount that a point is left of each: less "
                "smoothing keeps them, and the rest of the surface continued.");
            CHECK(n_remarks == 1);
            // The large one goes on as if it were alone.
            CHECK(test::largest_difference(mesh.vertices.topRows(n_large), begun.topRows(n_large)) > 1e-3);
        }
    }
}

TEST_CASE("what is small does not depend on the unit of length")
{
    const PolygonMesh both = together({ball(1.0, {0.0, 0.0, 0.0}, 300), ball(1e-4, {3.0, 0.0, 0.0}, 100)});
    for (const Way& way : all_ways(0.002)) {
        // The paper's parameter has a unit.
        if (way.name == "robin")
            continue;
        CAPTURE(way.name);
        PolygonMesh mesh = both;
        const std::vector<std::string> remarks = test::sentences(mean_curvature_flow(mesh, way.options).remarks);
        for (const double unit : {0x1p-12, 0x1p30}) {
            CAPTURE(unit);
            PolygonMesh other = both;
            other.vertices *= unit;
            FlowOptions options = way.options;
            options.time_step *= unit * unit;
            options.motion.attachment /= unit * unit;
            const FlowReport report = mean_curvature_flow(other, options);
            other.vertices /= unit;
            CHECK(test::largest_difference(other.vertices, mesh.vertices) < 1e-9);
            CHECK(test::sentences(report.remarks) == remarks);
        }
    }
}

TEST_CASE("small components leave the others' result alone")
{
    const PolygonMesh large = ball(1.0, {0.0, 0.0, 0.0}, 300);
    FlowOptions options;
    options.time_step = 0.002;
    options.steps = 3;
    options.accuracy.approach = Approach::Undecomposed;
    const Points alone = flowed(large, options);
    const Points beside = flowed(together({large, ball(1e-6, {3.0, 0.0, 0.0}, 100)}), options);
    const Points shift = beside.topRows(alone.rows()) - alone;
    CHECK((shift.rowwise() - Point(shift.row(0))).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("a small component goes to the centroid that a step finds, and stays there")
{
    const double time_step = 0.002;
    const Point centre(3.0, 0.7, -2.0);
    for (const Laplacian laplacian : test::geometric_laplacians)
        for (const Index n : {100, 1000}) {
            FlowOptions options;
            options.laplacian = laplacian;
            options.time_step = time_step;
            options.accuracy.approach = Approach::Undecomposed;
            // A little above the threshold, at the origin: masses have their digits there.
            const double unit = std::sqrt(time_step / 1e5) / diagonal_of(dented_ball(1.0, {0.0, 0.0, 0.0}, n));
            const Points large = flowed(dented_ball(1.01 * unit, {0.0, 0.0, 0.0}, n), options);
            const Point expected = large.colwise().mean() / (1.01 * unit);
            CHECK_FALSE(is_point(large));
            CHECK(expected.norm() > 0.1);
            for (const double size : {0.99, 0.1, 1e-4})
                for (const int steps : {1, 3}) {
                    CAPTURE(name_of(laplacian));
                    CAPTURE(n);
                    CAPTURE(size);
                    CAPTURE(steps);
                    options.steps = steps;
                    const PolygonMesh both =
                        together({ball(1.0, {0.0, 0.0, 0.0}, 300), dented_ball(size * unit, centre, n)});
                    const Points small = flowed(both, options).bottomRows(n);
                    CHECK(is_point(small));
                    CHECK((small.row(0) - centre - size * unit * expected).norm() < 1e-6 * size * unit + 1e-15);
                }
            options.steps = 1;
        }
}

TEST_CASE("a small component with an attachment or strengths goes where the sums of the equation put it")
{
    const PolygonMesh mesh = dented_ball(1.0, {0.0, 0.0, 0.0}, 300);
    FlowOptions options;
    options.accuracy.approach = Approach::Undecomposed;
    const double extent = diagonal_of(mesh);
    const auto after = [&](double factor) {
        options.time_step = factor * 1e5 * extent * extent;
        return flowed(mesh, options);
    };
    const Points below = after(0.99);
    CHECK(test::largest_difference(below, after(1.01)) < 1e-5);
    CHECK_FALSE(is_point(below));
    CHECK(is_point(after(1.01)));
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        options.motion.strength.push_back(mesh.vertices(v, 1) > 0.1 ? 0.1 : 1.0);
    const Points weaker = after(0.99);
    CHECK((weaker.colwise().mean() - below.colwise().mean()).norm() > 0.05);
    CHECK(test::largest_difference(weaker, after(1.01)) < 1e-4);
    CHECK(is_point(after(1.01)));
    // Vertices that are pulled back, each in its own way: the point goes to theirs. The pull counts beside M: the
    // component is small where dt / 10⁵ > extent² (1 + dt w).
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        options.motion.attachment_weights.push_back(mesh.vertices(v, 0) > 0.2 ? 0.5e-5 / (extent * extent) : 0.0);
    const Points pulled = after(1.99);
    CHECK((pulled.colwise().mean() - weaker.colwise().mean()).norm() > 0.05);
    CHECK_FALSE(is_point(pulled));
    CHECK(is_point(after(2.01)));
    CHECK(test::largest_difference(pulled, after(2.01)) < 1e-3);
    // A pull that is stronger than the step keeps the shape.
    options.motion.attachment_weights.clear();
    options.motion.attachment = 1e6 / (extent * extent);
    CHECK(test::largest_difference(after(1e4), mesh.vertices) < 0.1);
    options.motion.strength.clear();
    // Far below the threshold the point is pulled as strongly as its vertices are on average.
    options.motion.attachment = 0.0;
    std::vector<Index> at_the_right;
    options.motion.attachment_weights.assign(usize(mesh.n_vertices()), 0.0);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (mesh.vertices(v, 0) > 0.2) {
            at_the_right.push_back(v);
            options.motion.attachment_weights[usize(v)] = 1e-14 / (extent * extent);
        }
    const Points far_below = after(1e9);
    CHECK(is_point(far_below));
    CHECK(far_below(0, 0) > below.col(0).mean() + 0.1);
    CHECK(far_below(0, 0) < mesh.vertices(at_the_right, Eigen::all).col(0).mean());
}

TEST_CASE("points of small components have the same bits on any number of threads and after a resumption")
{
    const PolygonMesh mesh = together({ball(1.0, {0.0, 0.0, 0.0}, 600), dented_ball(1e-5, {3.0, 0.0, 0.0}, 200),
                                       dented_ball(1e-12, {0.0, 4.0, 0.0}, 100)});
    for (Way way : all_ways(0.002)) {
        CAPTURE(way.name);
        way.options.report.measures = true;
        std::vector<std::shared_ptr<const FlowState>> states;
        PolygonMesh whole = mesh;
        const FlowReport report =
            mean_curvature_flow(whole, way.options, [&](const StepState& now) { states.push_back(now.capture()); });
        for (const StepReport& step : report.steps)
            CHECK(std::isfinite(step.displacement.tangential.rms));
        for (const auto& state : states) {
            PolygonMesh resumed = mesh;
            way.options.resources.threads = 3;
            mean_curvature_flow(resumed, way.options, {}, {.stop = {}, .on_progress = {}, .resume = state});
            CHECK(test::same_bits(resumed.vertices, whole.vertices));
        }
    }
}

TEST_CASE("a component that is a point from the beginning stays as it is, and is not remarked on")
{
    PolygonMesh mesh = together({ball(1.0, {0.0, 0.0, 0.0}, 300), ball(0.0, {3.0, 0.0, 0.0}, 100)});
    const Points before = mesh.vertices.bottomRows(100);
    FlowOptions options;
    options.time_step = 0.002;
    options.accuracy.approach = Approach::Undecomposed;
    for (const double strength : {0.0, 0.5}) {
        options.motion.strength.assign(usize(mesh.n_vertices()), 0.5);
        options.motion.strength.back() = strength;
        const FlowReport report = mean_curvature_flow(mesh, options);
        CHECK(test::same_bits(mesh.vertices.bottomRows(100), before));
        CHECK(mesh.vertices.allFinite());
        CHECK(test::count_with(report.remarks, "small compared with") == 0);
    }
}

TEST_CASE("a small component is not scaled back, and a remark says so")
{
    PolygonMesh mesh = together({ball(1.0, {0.0, 0.0, 0.0}, 300), ball(1e-6, {3.0, 0.0, 0.0}, 100)});
    FlowOptions options;
    options.time_step = 0.002;
    options.motion.rescale = Rescale::Area;
    options.accuracy.approach = Approach::Undecomposed;
    const FlowReport report = mean_curvature_flow(mesh, options);
    CHECK(is_point(mesh.vertices.bottomRows(100)));
    CHECK(test::count_with(report.remarks, "1 of 2 components was not scaled back") == 1);
}

TEST_CASE("a component that is held does not count as one that vanishes")
{
    PolygonMesh mesh = together({ball(1.0, {0.0, 0.0, 0.0}, 300), ball(1e-6, {3.0, 0.0, 0.0}, 100)});
    const Point held = mesh.vertices.row(mesh.n_vertices() - 1);
    FlowOptions options;
    options.time_step = 0.002;
    options.accuracy.approach = Approach::Undecomposed;
    options.motion.fixed_vertices = {mesh.n_vertices() - 1};
    const FlowReport report = mean_curvature_flow(mesh, options);
    CHECK(test::count_with(report.remarks, "small compared with") == 0);
    CHECK(Point(mesh.vertices.row(mesh.n_vertices() - 1)) == held);
    CHECK((mesh.vertices.bottomRows(100).rowwise() - held).rowwise().norm().maxCoeff() < 1e-8);
}

TEST_CASE("a component with a vertex that hardly moves does not count as one that vanishes")
{
    const PolygonMesh mesh = together({ball(1.0, {0.0, 0.0, 0.0}, 300), ball(1e-6, {3.0, 0.0, 0.0}, 100)});
    FlowOptions options;
    options.time_step = 0.002;
    options.accuracy.approach = Approach::Undecomposed;
    const auto n_remarks = [&](double strength) {
        options.motion.strength.assign(usize(mesh.n_vertices()), 0.5);
        options.motion.strength.back() = strength;
        PolygonMesh flowing = mesh;
        const FlowReport report = mean_curvature_flow(flowing, options);
        return std::ranges::count_if(report.remarks,
                                     [](const auto& r) { return sentence(r).starts_with("1 component is so small"); });
    };
    CHECK(n_remarks(0.5) == 1);
    CHECK(n_remarks(0.001) == 0);
}

TEST_CASE("a small component is pulled as far as any vertex of a region that is attached")
{
    // (1 / s + dt w) x = x⁰ / s + dt w x⁰ of its centre, which is elsewhere than its target.
    const PolygonMesh mesh = together({ball(1.0, {0.0, 0.0, 0.0}, 300), ball(1e-6, {3.0, 0.0, 0.0}, 100)});
    FlowOptions options;
    options.time_step = 0.002;
    options.accuracy = {.tolerance = 1e-10, .approach = Approach::Converged};
    options.cut.subdomains = 4;
    options.motion.attachment = 600.0;
    options.motion.strength.assign(usize(mesh.n_vertices()), 0.25);
    std::vector<Index> small(100);
    std::iota(small.begin(), small.end(), mesh.n_vertices() - 100);
    PolygonMesh moved = mesh;
    Flow flow(moved, options);
    const Point away(0.0, 0.5, 0.0);
    flow.move(small, mesh.vertices.bottomRows(100).rowwise() + away);
    flow.step();
    const double pull = 0.25 * options.time_step * options.motion.attachment;
    const Point expected = mesh.vertices.bottomRows(100).colwise().mean() + away / (1.0 + pull);
    CHECK((moved.vertices.bottomRows(100).colwise().mean() - expected).norm() < 1e-6);
}
