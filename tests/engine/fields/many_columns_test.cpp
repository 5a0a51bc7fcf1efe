#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diffuse.h"
#include "engine/fields/heat_equation.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/messages.h"

using namespace seamflow;

namespace {

constexpr double none_here = std::numeric_limits<double>::quiet_NaN();

PolygonMesh bumpy(const char* kind = "triangles")
{
    return make_mesh(kind, 2500);
}

/// Waves of different lengths, at sizes from 1e-6 to 1e6. One column is constant.
Eigen::MatrixXd many_waves(const PolygonMesh& mesh, Eigen::Index n)
{
    Eigen::MatrixXd fields(mesh.n_vertices(), n);
    for (Eigen::Index c = 0; c < n; ++c)
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            fields(v, c) = std::pow(10.0, c % 13 - 6) *
                           std::sin((1.0 + 0.3 * static_cast<double>(c)) *
                                    (mesh.vertices(v, 0) + 0.1 * static_cast<double>(c) * mesh.vertices(v, 1)));
    fields.col(n / 2).setConstant(0.1);
    return fields;
}

FlowOptions with(const PolygonMesh& mesh, int steps, Approach approach)
{
    const double edge = mean_edge_length(mesh);
    FlowOptions options{.time_step = 12.0 * edge * edge, .steps = steps};
    options.accuracy.approach = approach;
    if (approach == Approach::Converged) {
        options.accuracy.tolerance = 1e-12;
        options.cut.subdomains = 4;
    }
    return options;
}

/// Of all columns, in units of their spread.
double difference_of_columns(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
    double largest = 0.0;
    for (Eigen::Index c = 0; c < a.cols(); ++c)
        for (Eigen::Index v = 0; v < a.rows(); ++v) {
            if (std::isnan(a(v, c)) != std::isnan(b(v, c)))
                return std::numeric_limits<double>::infinity();
            if (!std::isnan(a(v, c)))
                largest = std::max(largest, std::abs(a(v, c) - b(v, c)) / std::pow(10.0, c % 13 - 6));
        }
    return largest;
}

bool chooses_one_factor(const FieldReport& report)
{
    return test::count_with(report.flow.choices, "for so many columns.") > 0;
}

}  // namespace

TEST_CASE("many columns of fields diffuse at once as they do one by one")
{
    for (const char* kind : {"triangles", "quads", "noisy-sphere"}) {
        CAPTURE(kind);
        const PolygonMesh mesh = bumpy(kind);
        Eigen::MatrixXd before = many_waves(mesh, 75);
        for (Index v = 100; v < 160; ++v)
            before(v, 3) = before(v, 40) = none_here;
        for (const bool keeps_edges : {false, true}) {
            FieldOptions of_fields{.fill = true, .weights = Weights::OfLaplacian};
            if (keeps_edges)
                of_fields.keep_edges = 3.0;
            FlowOptions options = with(mesh, 2, Approach::Converged);
            options.motion.fixed_vertices = {17, 400, 401};
            Eigen::MatrixXd expected = before;
            CHECK_FALSE(chooses_one_factor(diffuse(mesh, expected, options, of_fields)));
            options = with(mesh, 2, Approach::Automatic);
            options.motion.fixed_vertices = {17, 400, 401};
            Eigen::MatrixXd fields = before;
            CHECK(chooses_one_factor(diffuse(mesh, fields, options, of_fields)));
            CHECK(difference_of_columns(fields, expected) < 1e-8);
            CHECK(fields.col(37) == before.col(37));
            for (const Index v : options.motion.fixed_vertices)
                CHECK(fields.row(v) == before.row(v));
            CHECK(fields(402, 0) != before(402, 0));
            options.resources.threads = 1;
            Eigen::MatrixXd by_one_thread = before;
            diffuse(mesh, by_one_thread, options, of_fields);
            CHECK(by_one_thread == fields);
        }
    }
}

TEST_CASE("columns that are solved for at once have the bits that they have with fewer others")
{
    const PolygonMesh mesh = bumpy();
    const Eigen::MatrixXd before = many_waves(mesh, 70);
    const FlowOptions options = with(mesh, 3, Approach::Undecomposed);
    Eigen::MatrixXd all = before;
    diffuse(mesh, all, options);
    for (const Eigen::Index n : {4, 19, 20, 51}) {
        CAPTURE(n);
        Eigen::MatrixXd some = before.leftCols(n);
        diffuse(mesh, some, options);
        CHECK(some == all.leftCols(n));
    }
}

TEST_CASE("many columns diffuse across seams, and where vertices are fixed in between")
{
    // A tube, and the same with a seam along which it is cut open.
    PolygonMesh tube;
    PolygonMesh cut;
    constexpr Index sides = 24;
    constexpr Index rings = 20;
    tube.vertices.resize((rings + 1) * sides, 3);
    cut.vertices.resize((rings + 1) * (sides + 1), 3);
    for (Index ring = 0; ring <= rings; ++ring)
        for (Index side = 0; side <= sides; ++side) {
            const double angle = 2.0 * std::numbers::pi * (side % sides) / sides;
            cut.vertices.row(ring * (sides + 1) + side) << std::cos(angle), std::sin(angle), 0.3 * ring;
            tube.vertices.row(ring * sides + side % sides) = cut.vertices.row(ring * (sides + 1) + side);
        }
    for (Index ring = 0; ring < rings; ++ring)
        for (Index side = 0; side < sides; ++side) {
            const auto in_tube = [&](Index r, Index s) { return r * sides + s % sides; };
            const auto in_cut = [&](Index r, Index s) { return r * (sides + 1) + s; };
            tube.add_face(std::vector{in_tube(ring, side), in_tube(ring, side + 1), in_tube(ring + 1, side + 1)});
            tube.add_face(std::vector{in_tube(ring, side), in_tube(ring + 1, side + 1), in_tube(ring + 1, side)});
            cut.add_face(std::vector{in_cut(ring, side), in_cut(ring, side + 1), in_cut(ring + 1, side + 1)});
            cut.add_face(std::vector{in_cut(ring, side), in_cut(ring + 1, side + 1), in_cut(ring + 1, side)});
        }
    const auto in_tube = [&](Index v) { return v / (sides + 1) * sides + v % (sides + 1) % sides; };
    const auto options_for = [&](Approach approach) {
        FlowOptions options = with(tube, 2, approach);
        options.flow = FlowEquation::Linear;
        return options;
    };
    Eigen::MatrixXd of_tube;
    for (const Approach approach : {Approach::Converged, Approach::Undecomposed}) {
        of_tube = many_waves(tube, 40);
        Eigen::MatrixXd of_cut(cut.n_vertices(), 40);
        for (Index v = 0; v < cut.n_vertices(); ++v)
            of_cut.row(v) = of_tube.row(in_tube(v));
        // Values along the seam differ: their mean counts.
        for (Index ring = 0; ring <= rings; ++ring) {
            of_cut.row(ring * (sides + 1)).array() += 1e-3;
            of_cut.row(ring * (sides + 1) + sides).array() -= 1e-3;
        }
        HeatEquation(tube, options_for(approach)).take_steps(of_tube, 2);
        HeatEquation(cut, options_for(approach)).take_steps(of_cut, 2);
        Eigen::MatrixXd expected(cut.n_vertices(), 40);
        for (Index v = 0; v < cut.n_vertices(); ++v)
            expected.row(v) = of_tube.row(in_tube(v));
        CHECK(difference_of_columns(of_cut, expected) < 1e-7);
    }
    FlowOptions options = options_for(Approach::Undecomposed);
    options.motion.fixed_vertices = {200, 201};
    HeatEquation heat(tube, options);
    const Eigen::MatrixXd between = of_tube;
    heat.take_steps(of_tube, 1);
    CHECK(of_tube.row(200) == between.row(200));
    CHECK(of_tube.row(201) == between.row(201));
    // As if each column had an equation of its own.
    HeatEquation narrow(tube, options);
    for (Eigen::Index c = 0; c < 40; ++c) {
        Eigen::MatrixXd column = between.col(c);
        narrow.take_steps(column, 1);
        CHECK((column - of_tube.col(c)).cwiseAbs().maxCoeff() < 1e-9 * std::pow(10.0, c % 13 - 6));
    }
}
