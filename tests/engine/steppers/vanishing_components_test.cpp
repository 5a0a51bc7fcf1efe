#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "tests/support/flows.h"

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
                // A point; a linear flow finds it up to rounding of its matrix.
                if (way.options.flow != FlowEquation::Linear)
                    CHECK((after.rowwise() - centre).rowwise().norm().maxCoeff() < 1e-3 * radius + 1e-15);
                else
                    CHECK(test::largest_difference(after, before) <= 2.0 * radius);
            }
            const auto n_remarks = std::ranges::count(
                report.remarks, "2 components are so small compared with the amount that a point is left of each: less "
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
        const std::vector<std::string> remarks = mean_curvature_flow(mesh, way.options).remarks;
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
            CHECK(report.remarks == remarks);
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

TEST_CASE("a component becomes a point where a step would leave next to nothing of it")
{
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
    CHECK((below.rowwise() - Point(below.row(0))).cwiseAbs().maxCoeff() > 1e-9);
    CHECK((below.rowwise() - Point(below.row(0))).cwiseAbs().maxCoeff() < 1e-5);
    CHECK((above.rowwise() - Point(mesh.vertices.colwise().mean())).cwiseAbs().maxCoeff() < 1e-15);
    // The centroid by mass is not quite the mean of the vertices.
    CHECK(test::largest_difference(below, above) < 0.01);
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
    CHECK(std::ranges::none_of(report.remarks, [](const auto& r) { return r.find("small compared with") != r.npos; }));
    CHECK(Point(mesh.vertices.row(mesh.n_vertices() - 1)) == held);
    CHECK((mesh.vertices.bottomRows(100).rowwise() - held).rowwise().norm().maxCoeff() < 1e-8);
}

TEST_CASE("a component with a vertex that hardly moves does not count as one that vanishes")
{
    const PolygonMesh mesh = together({ball(1.0, {0.0, 0.0, 0.0}, 300), ball(1e-6, {3.0, 0.0, 0.0}, 100)});
    FlowOptions options;
    options.time_step = 0.002;
    options.accuracy.approach = Approach::Undecomposed;
    const auto counts = [&](double strength) {
        options.motion.strength.assign(at(mesh.n_vertices()), 0.5);
        options.motion.strength.back() = strength;
        PolygonMesh moved = mesh;
        const std::vector<std::string> remarks = mean_curvature_flow(moved, options).remarks;
        return std::ranges::any_of(remarks, [](const auto& r) { return r.find("small compared with") != r.npos; });
    };
    CHECK(counts(0.5));
    CHECK(!counts(0.001));
}
