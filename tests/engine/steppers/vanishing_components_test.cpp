#include <algorithm>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"
#include "tests/support/relative.h"

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
    add("conformalized", [](FlowOptions& o) { o.flow = FlowEquation::Conformalized; });
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
                // In the middle of the component; where coordinates do not resolve it, it stays.
                if (size > 1e-10)
                    CHECK((after.rowwise() - centre).rowwise().norm().maxCoeff() < 0.2 * radius);
                else if (way.options.flow != FlowEquation::Linear)
                    CHECK(test::largest_difference(after, before) <= 1e-12 * size);
                else
                    CHECK(test::largest_difference(after, before) <= 2.0 * radius);
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

TEST_CASE("what the scaling of a small component leaves out is far below its size")
{
    // About the threshold the step with scaling is that without.
    const PolygonMesh mesh = ball(1.0, {0.0, 0.0, 0.0}, 300);
    FlowOptions options;
    options.accuracy.approach = Approach::Undecomposed;
    const double extent = (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
    const auto after = [&](double factor) {
        options.time_step = factor * 1e5 * extent * extent;
        return flowed(mesh, options);
    };
    const Points below = after(0.99);
    const Points above = after(1.01);
    CHECK(test::largest_difference(below, above) < 1e-7);
    // So it is with vertices that are pulled back, each in its own way: the middle goes to theirs.
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        options.motion.attachment_weights.push_back(mesh.vertices(v, 0) > 0.2 ? 1e-5 / (extent * extent) : 0.0);
    const Points pulled = after(0.999);
    CHECK((pulled.colwise().mean() - below.colwise().mean()).norm() > 0.05);
    CHECK(test::largest_difference(pulled, after(1.001)) < 1e-3);
    // Far below the threshold the middle alone is left: it is pulled as strongly as its vertices are on average.
    std::vector<Index> at_the_right;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (mesh.vertices(v, 0) > 0.2)
            at_the_right.push_back(v);
    for (const Index v : at_the_right)
        options.motion.attachment_weights[usize(v)] = 1e-14 / (extent * extent);
    const double pull = static_cast<double>(at_the_right.size()) / static_cast<double>(mesh.n_vertices());
    const double target = mesh.vertices(at_the_right, Eigen::all).col(0).mean();
    CHECK(after(1e9).col(0).mean() == test::relative(pull * target / (1.0 + pull), 0.05));
    options.motion.attachment_weights.clear();
    // What is left of the shape is as 1 / dt.
    const Point centre = below.colwise().mean();
    const Points shape = below.rowwise() - centre;
    const Points shape_above = above.rowwise() - Point(above.colwise().mean());
    CHECK(shape_above.norm() / shape.norm() == test::relative(0.99 / 1.01, 1e-5));
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
