#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "engine/diffuse.h"
#include "engine/fields/field_columns.h"
#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/junction_meshes.h"
#include "tests/support/messages.h"
#include "tests/support/reference_data.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::relative;

namespace {

constexpr double no_data = std::numeric_limits<double>::quiet_NaN();

/// K by cotangents and M by thirds of areas of triangles: written down anew.
struct CotangentMatrices {
    Eigen::MatrixXd stiffness;
    Eigen::VectorXd mass;
};

/// @param diffusivity_of a face; empty: 1.
CotangentMatrices by_cotangents(const PolygonMesh& mesh, const std::function<double(Index f)>& diffusivity_of = {})
{
    CotangentMatrices of{Eigen::MatrixXd::Zero(mesh.n_vertices(), mesh.n_vertices()),
                         Eigen::VectorXd::Zero(mesh.n_vertices())};
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto face = mesh.face(f);
        const double g = diffusivity_of ? diffusivity_of(f) : 1.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = face[(k + 1) % 3];
            const Index b = face[(k + 2) % 3];
            const Eigen::RowVector3d u = mesh.vertices.row(a) - mesh.vertices.row(face[k]);
            const Eigen::RowVector3d v = mesh.vertices.row(b) - mesh.vertices.row(face[k]);
            const double doubled = u.cross(v).norm();
            const double w = g * 0.5 * u.dot(v) / doubled;
            of.stiffness(a, a) += w;
            of.stiffness(b, b) += w;
            of.stiffness(a, b) -= w;
            of.stiffness(b, a) -= w;
            of.mass[face[k]] += doubled / 6.0;
        }
    }
    return of;
}

Eigen::MatrixXd one_step(const CotangentMatrices& of, const Eigen::MatrixXd& fields, double time_step)
{
    const Eigen::MatrixXd matrix = Eigen::MatrixXd(of.mass.asDiagonal()) + time_step * of.stiffness;
    const Eigen::MatrixXd right = of.stiffness * (fields.rowwise() - fields.row(0));
    return fields - time_step * matrix.partialPivLu().solve(right);
}

PolygonMesh bumpy_triangles(Index vertices)
{
    HeightFieldShape shape;
    shape.noise = 0.2;
    return make_triangles(vertices, shape);
}

/// Five columns of different sizes.
Eigen::MatrixXd waves_on(const PolygonMesh& mesh)
{
    Eigen::MatrixXd fields(mesh.n_vertices(), 5);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const double x = mesh.vertices(v, 0);
        const double y = mesh.vertices(v, 1);
        fields.row(v) << std::sin(9.0 * x), 1e6 + std::cos(7.0 * y), 1e-9 * x * y, (v * 37) % 256, x > 0.4 ? 1e3 : -1e3;
    }
    return fields;
}

/// Of each column, in units of its spread.
double largest_difference_of_columns(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
    const Eigen::RowVectorXd spread = b.colwise().maxCoeff() - b.colwise().minCoeff();
    return ((a - b).cwiseAbs().array().rowwise() / spread.array()).maxCoeff();
}

FlowOptions steps_of(const PolygonMesh& mesh, double squared_edges, int steps, Approach approach, Index subdomains)
{
    const double edge = mean_edge_length(mesh);
    FlowOptions options{.time_step = squared_edges * edge * edge, .steps = steps};
    options.accuracy.approach = approach;
    options.accuracy.tolerance = 1e-11;
    if (approach == Approach::Undecomposed)
        options.accuracy.tolerance.reset();
    options.cut.subdomains = subdomains;
    return options;
}

}  // namespace

TEST_CASE("fields diffuse as by a dense matrix of cotangents, however steps are solved")
{
    const PolygonMesh mesh = bumpy_triangles(700);
    const Eigen::MatrixXd before = waves_on(mesh);
    const CotangentMatrices of = by_cotangents(mesh);
    for (const auto& [approach, subdomains] :
         {std::pair{Approach::Converged, 7}, {Approach::Undecomposed, 1}, {Approach::ConjugateGradients, 1}}) {
        const auto solver = static_cast<int>(approach);
        CAPTURE(solver);
        for (const double squared_edges : {0.5, 40.0}) {
            const FlowOptions options = steps_of(mesh, squared_edges, 3, approach, subdomains);
            Eigen::MatrixXd expected = before;
            for (int step = 0; step < 3; ++step)
                expected = one_step(of, expected, options.time_step);
            Eigen::MatrixXd fields = before;
            const FieldReport report = diffuse(mesh, fields, options, {.weights = Weights::OfLaplacian});
            CHECK(largest_difference_of_columns(fields, expected) < 1e-8);
            CHECK(report.without_data == 0);
            const Eigen::RowVectorXd kept = of.mass.transpose() * before;
            CHECK(((of.mass.transpose() * fields - kept).array() / kept.array()).abs().maxCoeff() < 1e-8);
        }
    }
}

TEST_CASE("columns of fields do not depend on each other, on threads, or on their unit")
{
    const PolygonMesh mesh = bumpy_triangles(3000);
    const Eigen::MatrixXd before = waves_on(mesh);
    FlowOptions options = steps_of(mesh, 10.0, 2, Approach::Converged, 6);
    Eigen::MatrixXd all = before;
    diffuse(mesh, all, options);
    options.resources.threads = 1;
    Eigen::MatrixXd by_one = before;
    diffuse(mesh, by_one, options);
    CHECK(by_one == all);
    Eigen::MatrixXd doubled = 1024.0 * before;
    diffuse(mesh, doubled, options);
    CHECK(doubled == 1024.0 * all);
    Eigen::MatrixXd third = before.col(3);
    diffuse(mesh, third, options);
    CHECK(largest_difference_of_columns(third, all.col(3)) < 1e-9);
    PolygonMesh tiny = mesh;
    tiny.vertices *= 0x1p-40;
    options.time_step *= 0x1p-80;
    for (const double unit : {0x1p1000, 0x1p-900}) {
        Eigen::MatrixXd scaled = unit * before.col(0);
        diffuse(tiny, scaled, options);
        CHECK(largest_difference_of_columns((1.0 / unit) * scaled, all.col(0)) < 1e-9);
    }
    // The spread of these is no number.
    Eigen::MatrixXd largest = (1.7e308 / before.col(0).cwiseAbs().maxCoeff()) * before.col(0);
    diffuse(mesh, largest, options);
    CHECK(largest.allFinite());
}

TEST_CASE("constant fields stay, bit for bit, and so do held vertices and a fixed boundary")
{
    const PolygonMesh mesh = bumpy_triangles(1200);
    for (const Approach approach : {Approach::Converged, Approach::ConjugateGradients}) {
        FlowOptions options = steps_of(mesh, 30.0, 2, approach, approach == Approach::Converged ? 5 : 1);
        Eigen::MatrixXd fields = waves_on(mesh);
        fields.col(1).setConstant(0.1);
        options.motion.fixed_vertices = {17, 400, 401};
        const Eigen::MatrixXd before = fields;
        diffuse(mesh, fields, options);
        CHECK(fields.col(1) == before.col(1));
        for (const Index v : options.motion.fixed_vertices)
            CHECK(fields.row(v) == before.row(v));
        CHECK(fields.row(402) != before.row(402));

        const Topology topology = make_topology(mesh);
        fields = before;
        diffuse(mesh, fields, options, {.weights = Weights::OfLaplacian, .boundary = Boundary::Fixed});
        CotangentMatrices of = by_cotangents(mesh);
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if (topology.kind[v] == VertexKind::Boundary || v == 17 || v == 400 || v == 401) {
                CHECK(fields.row(v) == before.row(v));
                of.stiffness.row(v).setZero();
            }
        Eigen::MatrixXd expected = before;
        for (int step = 0; step < 2; ++step)
            expected = one_step(of, expected, options.time_step);
        CHECK(largest_difference_of_columns(fields.rightCols(3), expected.rightCols(3)) < 1e-7);
    }
}

TEST_CASE("vertices without data take no part, and stay without, or get the harmonic extension")
{
    const PolygonMesh mesh = bumpy_triangles(900);
    const Eigen::MatrixXd complete = waves_on(mesh);
    Eigen::MatrixXd before = complete;
    std::vector<Index> lacking;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if ((mesh.vertices.row(v).head<2>() - Eigen::RowVector2d(0.5, 0.5)).norm() < 0.2)
            lacking.push_back(v);
    REQUIRE(lacking.size() > 50);
    for (const Index v : lacking)
        before(v, 0) = before(v, 4) = no_data;
    const FlowOptions options = steps_of(mesh, 10.0, 2, Approach::Automatic, 0);
    Eigen::MatrixXd fields = before;
    const FieldReport report = diffuse(mesh, fields, options, {.weights = Weights::OfLaplacian});
    CHECK(report.without_data == std::ssize(lacking));
    CHECK(report.filled == 0);

    // The surface with a hole.
    PolygonMesh with_hole;
    with_hole.vertices = mesh.vertices;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (std::ranges::none_of(mesh.face(f), [&](Index v) { return std::isnan(before(v, 0)); }))
            with_hole.add_face(mesh.face(f));
    CotangentMatrices of = by_cotangents(with_hole);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        of.mass[v] = of.mass[v] > 0.0 ? of.mass[v] : 1.0;
    Eigen::MatrixXd expected = complete;
    for (int step = 0; step < 2; ++step)
        expected = one_step(of, expected, options.time_step);
    Eigen::MatrixXd whole = complete;
    diffuse(mesh, whole, options, {.weights = Weights::OfLaplacian});
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        CHECK(std::isnan(fields(v, 0)) == std::isnan(before(v, 0)));
        CHECK(std::isnan(fields(v, 4)) == std::isnan(before(v, 4)));
        if (!std::isnan(before(v, 0)))
            CHECK(std::abs(fields(v, 0) - expected(v, 0)) < 1e-8);
    }
    CHECK(largest_difference_of_columns(fields.middleCols(1, 3), whole.middleCols(1, 3)) < 1e-8);

    Eigen::MatrixXd filled = before;
    const FieldReport of_filling = diffuse(mesh, filled, options, {.fill = true, .weights = Weights::OfLaplacian});
    CHECK(of_filling.filled == std::ssize(lacking));
    CHECK(filled.allFinite());
    // Vertices count once, however many columns lack data there.
    filled = before;
    filled(0, 2) = filled(lacking[0], 2) = no_data;
    const FieldReport of_three = diffuse(mesh, filled, options, {.fill = true, .weights = Weights::OfLaplacian});
    CHECK(of_three.without_data == std::ssize(lacking) + 1);
    CHECK(of_three.filled == std::ssize(lacking) + 1);
    filled = before;
    diffuse(mesh, filled, options, {.fill = true, .weights = Weights::OfLaplacian});
    const CotangentMatrices of_mesh = by_cotangents(mesh);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (std::isnan(before(v, 0)))
            CHECK(std::abs(of_mesh.stiffness.row(v).dot(filled.col(0))) < 1e-5);
        else
            CHECK(filled(v, 0) == fields(v, 0));
}

TEST_CASE("fields on sheets that meet, with holes in the data, are those of the reference, undecomposed and converged")
{
    const auto files = test::reference_files("fields");
    REQUIRE_FALSE(files.empty());
    for (const auto& file : files) {
        test::ReferenceFields reference = test::read_diffusion(file);
        reference.options.accuracy.tolerance = 1e-13;
        for (const Index subdomains : {1, 5})
            for (std::size_t step = 0; step < reference.fields_after_step.size(); ++step) {
                CAPTURE(subdomains);
                CAPTURE(step);
                reference.options.cut.subdomains = subdomains;
                reference.options.steps = static_cast<int>(step) + 1;
                Eigen::MatrixXd fields = reference.fields;
                diffuse(reference.mesh, fields, reference.options, {.weights = Weights::OfLaplacian});
                const Eigen::MatrixXd& expected = reference.fields_after_step[step];
                for (Eigen::Index c = 0; c < fields.cols(); ++c)
                    for (Eigen::Index v = 0; v < fields.rows(); ++v)
                        if (std::isnan(expected(v, c)))
                            CHECK(std::isnan(fields(v, c)));
                        else
                            CHECK(std::abs(fields(v, c) - expected(v, c)) < 1e-9 * (1.0 + std::abs(expected(v, c))));
            }
    }
}

TEST_CASE("data are extended in the range of the others, whatever is held, and far from 0")
{
    const PolygonMesh mesh = bumpy_triangles(900);
    Eigen::MatrixXd fields(mesh.n_vertices(), 1);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        fields(v, 0) = 1e6 + mesh.vertices(v, 0);
    for (const Index v : {0, 1, 2, 400, 401, 430})
        fields(v, 0) = no_data;
    FlowOptions options = steps_of(mesh, 1.0, 1, Approach::Automatic, 0);
    options.motion.fixed_vertices = {400};
    for (const Boundary boundary : {Boundary::Fixed, Boundary::Free}) {
        Eigen::MatrixXd filled = fields;
        const FieldReport report = diffuse(mesh, filled, options, {.fill = true, .boundary = boundary});
        CHECK(report.filled == 6);
        CHECK((filled.array() >= 1e6 - 1e-6).all());
        CHECK((filled.array() <= 1e6 + 1.0 + 1e-6).all());
        CHECK(filled(400, 0) == relative(1e6 + mesh.vertices(400, 0), 1e-7));
        for (const Index v : {0, 1, 2})
            CHECK(std::abs(filled(v, 0) - 1e6 - mesh.vertices(3, 0)) < 0.1);
    }
    // A single datum is that of all.
    fields.bottomRows(mesh.n_vertices() - 1).setConstant(no_data);
    fields(0, 0) = 101325.0;
    diffuse(mesh, fields, options, {.fill = true});
    CHECK((fields.array() == 101325.0).all());
}

TEST_CASE("faces without area take no part")
{
    PolygonMesh mesh = bumpy_triangles(600);
    Eigen::MatrixXd without = waves_on(mesh);
    const FlowOptions options = steps_of(mesh, 10.0, 2, Approach::Automatic, 0);
    diffuse(mesh, without, options);
    const Index n = mesh.n_vertices();
    mesh.vertices.conservativeResize(n + 1, 3);
    mesh.vertices.row(n) = 0.5 * (mesh.vertices.row(0) + mesh.vertices.row(1));
    mesh.add_face(std::array{Index{0}, n, Index{1}});
    Eigen::MatrixXd with = waves_on(mesh);
    diffuse(mesh, with, options);
    CHECK(largest_difference_of_columns(with.topRows(n), without) < 1e-9);
}

TEST_CASE("what is said of fields on sheets that meet, on a fixed boundary and along seams does not speak of motion")
{
    const FlowOptions options{.time_step = 0.1};
    FlowOptions held = options;
    held.motion.junctions = Junctions::Hold;
    const PolygonMesh square = test::triangle_grid(1, 1);
    const PolygonMesh plates = test::plates(std::array{0.0, 2.0, 4.0}, 4, 4);
    const auto check = [](const PolygonMesh& mesh, const FlowOptions& of_flow, const FieldOptions& of_fields) {
        Eigen::MatrixXd fields = Eigen::MatrixXd::Random(mesh.n_vertices(), 2);
        const FieldReport report = diffuse(mesh, fields, of_flow, of_fields);
        CHECK_FALSE(report.remarks.empty());
        for (const std::string& remark : test::sentences(report.remarks)) {
            CAPTURE(remark);
            CHECK(remark.find("mov") == std::string::npos);
        }
    };
    check(plates, options, {});
    check(plates, held, {});
    check(square, options, {.boundary = Boundary::Fixed});
    check(test::split(square, {0, 1}), options, {});
}

TEST_CASE("columns with data at different vertices: what is said of any is said once")
{
    FlowReport first;
    const auto named = [](const std::vector<std::string>& list) {
        return std::vector<Remark>(list.begin(), list.end());
    };
    first.choices = named({"a", "b"});
    FlowReport second;
    second.choices = named({"c", "a"});
    add_up(first, second);
    CHECK(second.choices == named({"a", "b", "c"}));
    // The steps of the group that misses its tolerance most often.
    first.convergence.steps_short_of_tolerance = 3;
    second.convergence.steps_stagnated = 2;
    add_up(first, second);
    CHECK(second.convergence.steps_short_of_tolerance == 3);
    CHECK(second.convergence.steps_stagnated == 2);
    using Sentences = std::vector<std::string>;
    const std::vector<FieldGroup> groups{{{0, 3}, {}}, {{1}, {}}, {{2, 4, 5, 6, 7}, {}}};
    const std::vector<std::vector<Remark>> of_groups{named({"r"}), named({"s", "r"}), named({"r", "t", "t"})};
    CHECK(test::sentences(remarks_on(groups, of_groups, {})) ==
          Sentences{"r", "For column 1 (numbered from 0): s", "For columns 2, 4, 5, 6 and 7 (numbered from 0): t"});
    const std::vector<FieldGroup> two{{{0, 2, 4, 5, 6, 7}, {}}, {{1, 3}, {}}};
    const Sentences names{"a", "b", "c", "d", "e", "f", "g", "h\n"};
    CHECK(test::sentences(remarks_on(two, std::vector{named({"r"}), named({"s"})}, names)) ==
          Sentences{"For 'a', 'c', 'e', 'f' and 2 others: r", "For 'b' and 'd': s"});
    CHECK(remarks_on({}, {}, names).empty());
}

TEST_CASE("columns that cannot flow are named where others flow")
{
    const PolygonMesh mesh = test::triangle_grid(4, 4);
    Eigen::MatrixXd fields = Eigen::MatrixXd::Random(mesh.n_vertices(), 4);
    // Single faces, along the boundary of their own.
    for (const Eigen::Index c : {1, 3}) {
        const auto face = mesh.face(c == 1 ? 0 : 9);
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if (std::ranges::find(face, v) == face.end())
                fields(v, c) = no_data;
    }
    const auto remarks = [&](const FieldOptions& of_fields, Eigen::MatrixXd of) {
        return test::sentences(diffuse(mesh, of, {.time_step = 0.1}, of_fields).remarks);
    };
    const std::string sentence =
        "No vertex can flow: each is fixed, on the boundary, or where the mesh is not manifold. A free boundary would "
        "flow.";
    CHECK(remarks({.boundary = Boundary::Fixed}, fields) ==
          std::vector{"For columns 1 and 3 (numbered from 0): " + sentence});
    CHECK(remarks({.boundary = Boundary::Fixed, .names = {"a", "b", "c", "d"}}, fields) ==
          std::vector{"For 'b' and 'd': " + sentence});
    // If none can, there is none to name.
    CHECK(remarks({.boundary = Boundary::Fixed, .names = {"d"}}, fields.rightCols(1)) == std::vector{sentence});
}

TEST_CASE("what is said of filling says so, and once")
{
    const PolygonMesh plates = test::plates(std::array{0.0, 2.0, 4.0}, 4, 4);
    Eigen::MatrixXd fields = Eigen::MatrixXd::Constant(plates.n_vertices(), 1, no_data);
    fields(0, 0) = 1.0;
    const auto report_of = [&](FlowOptions options) {
        Eigen::MatrixXd filled = fields;
        return diffuse(plates, filled, options, {.fill = true});
    };
    const std::string first = sentence(report_of({.time_step = 0.1}).remarks.at(0));
    CHECK(first.starts_with("Filling: "));
    CHECK(first.find("on edges of three faces or more flow with all of these faces.") != std::string::npos);
    // A vertex away from where sheets meet lacks data: both flows say the same of these.
    fields.setOnes();
    fields(plates.n_vertices() - 1, 0) = no_data;
    const FieldReport most = report_of({.time_step = 0.1});
    CHECK(most.filled == 1);
    CHECK(test::count_with(most.remarks, "three faces or more") == 1);
}

TEST_CASE("a column without any data, and a component without any, stay so")
{
    const PolygonMesh mesh = test::side_by_side({test::triangle_grid(5, 5), test::triangle_grid(4, 4)});
    Eigen::MatrixXd fields = Eigen::MatrixXd::Random(mesh.n_vertices(), 2);
    fields.col(1).setConstant(no_data);
    for (Index v = 36; v < mesh.n_vertices(); ++v)
        fields(v, 0) = no_data;
    fields(7, 0) = no_data;
    const FieldReport report = diffuse(mesh, fields, {.time_step = 0.5}, {.fill = true});
    CHECK(fields.col(1).array().isNaN().all());
    CHECK(fields.col(0).tail(mesh.n_vertices() - 36).array().isNaN().all());
    CHECK(fields.col(0).head(36).allFinite());
    CHECK(report.filled == 1);
    CHECK(test::count_with(
              report.remarks,
              "For column 0 (numbered from 0): Filling: 25 vertices stay without data, because faces connect them "
              "with no vertex that has any.") == 1);
    CHECK(test::count_with(report.remarks, "For column 1 (numbered from 0): Filling: 61 vertices stay without data") ==
          1);
    // Of two columns that lack data at different vertices.
    fields.setOnes();
    fields(7, 0) = fields(8, 1) = fields(9, 1) = no_data;
    const FieldReport of_both = diffuse(mesh, fields, {.time_step = 0.5}, {.fill = true});
    CHECK(of_both.without_data == 3);
    CHECK(of_both.filled == 3);
}

TEST_CASE("edges of fields stay by the diffusivity of Perona and Malik")
{
    const PolygonMesh mesh = bumpy_triangles(500);
    Eigen::MatrixXd before(mesh.n_vertices(), 4);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        before.row(v) << (mesh.vertices(v, 0) > 0.5 ? 200.0 : 10.0) + (v * 7) % 5, (v * 3) % 4, 0.0, (v * 5) % 3;
    const FlowOptions options = steps_of(mesh, 3.0, 2, Approach::Converged, 4);
    Eigen::MatrixXd expected = before;
    for (int step = 0; step < 2; ++step) {
        const auto diffusivity = [&](Index f) {
            double largest = 0.0;
            for (const Index v : mesh.face(f))
                for (const Index w : mesh.face(f))
                    largest = std::max(largest, (expected.row(v) - expected.row(w)).squaredNorm());
            return 1.0 / (1.0 + largest / (15.0 * 15.0));
        };
        expected = one_step(by_cotangents(mesh, diffusivity), expected, options.time_step);
    }
    Eigen::MatrixXd fields = before;
    diffuse(mesh, fields, options, {.keep_edges = 15.0, .weights = Weights::OfLaplacian});
    CHECK((fields - expected).cwiseAbs().maxCoeff() < 1e-6);
    // The edge stays, and what is beside it becomes smooth.
    Eigen::MatrixXd plain = before;
    diffuse(mesh, plain, options);
    const auto across = [&](const Eigen::MatrixXd& of) {
        double least = 1e9;
        for (Index f = 0; f < mesh.n_faces(); ++f)
            for (const Index v : mesh.face(f))
                for (const Index w : mesh.face(f))
                    if (mesh.vertices(v, 0) > 0.5 && mesh.vertices(w, 0) <= 0.5)
                        least = std::min(least, of(v, 0) - of(w, 0));
        return least;
    };
    CHECK(across(fields) > 150.0);
    CHECK(across(plain) < 100.0);
    CHECK(test::message_of([&] {
              diffuse(mesh, fields, steps_of(mesh, 3.0, 2, Approach::ConjugateGradients, 1), {.keep_edges = 15.0});
          }) == "edges of fields are kept only in converged and undecomposed steps: leave the approach automatic");
}

TEST_CASE("a step that misses its tolerance counts once, whatever takes it: columns, their groups, or measured noise")
{
    const PolygonMesh mesh = bumpy_triangles(400);
    const Eigen::MatrixXd waves = waves_on(mesh);
    for (const Approach approach : {Approach::ConjugateGradients, Approach::Converged}) {
        CAPTURE(static_cast<int>(approach));
        FlowOptions options{.steps = 4};
        options.accuracy.approach = approach;
        options.accuracy.tolerance = 1e-40;
        if (approach == Approach::Converged)
            options.cut.subdomains = 4;
        const auto check = [&](Eigen::MatrixXd fields, const FieldOptions& of_fields) {
            const ConvergenceReport report = diffuse(mesh, fields, options, of_fields).flow.convergence;
            CHECK(report.steps_short_of_tolerance == 4);
            CHECK(report.steps_stagnated <= 4);
        };
        check(waves.leftCols(1), {.fwhm = 0.2});
        check(waves, {.fwhm = 0.2});
        Eigen::MatrixXd of_two_groups = waves;
        of_two_groups(7, 1) = no_data;
        check(of_two_groups, {.fwhm = 0.2});
        if (approach == Approach::Converged)
            check(waves, {.fwhm = 0.2, .keep_edges = 15.0});
    }
}

TEST_CASE("a width, a radius and a time step may be relative to the mesh")
{
    const PolygonMesh mesh = bumpy_triangles(600);
    const double diagonal = box_of_faces(mesh).diagonal();
    const double edge = mean_edge_length(mesh);
    const auto diffused = [&](const FlowOptions& options, const FieldOptions& of_fields = {}) {
        Eigen::MatrixXd fields = waves_on(mesh);
        diffuse(mesh, fields, options, of_fields);
        return fields;
    };
    CHECK(diffused({.steps = 3}, {.fwhm = LengthOnMesh{0.1, true}}) ==
          diffused({.steps = 3}, {.fwhm = 0.1 * diagonal}));
    CHECK(diffused({.radius = LengthOnMesh{0.1, true}}) == diffused({.radius = 0.1 * diagonal}));
    CHECK(diffused({.time_step_edges = 4.0}) == diffused({.time_step = 4.0 * edge * edge}));
    CHECK(diffused({.time_step_edges = 4.0}) != diffused({.time_step_edges = 5.0}));
    PolygonMesh point = mesh;
    point.vertices.setZero();
    Eigen::MatrixXd fields = waves_on(mesh);
    CHECK_THROWS_WITH_AS(diffuse(point, fields, {}, {.fwhm = LengthOnMesh{0.1, true}}),
                         doctest::Contains("the mesh has no size to measure a part of"), InputError);
}

TEST_CASE("vertices along seams get one value")
{
    const PolygonMesh whole = bumpy_triangles(600);
    const PolygonMesh mesh = test::split(whole, test::halves(whole));
    REQUIRE(mesh.n_vertices() > whole.n_vertices());
    Eigen::MatrixXd of_whole = waves_on(whole);
    const std::vector<Index> originals = test::originals(mesh, whole);
    Eigen::MatrixXd fields = of_whole(originals, Eigen::all);
    const FlowOptions options = steps_of(whole, 10.0, 2, Approach::Automatic, 0);
    diffuse(whole, of_whole, options);
    Eigen::MatrixXd apart = fields;
    diffuse(mesh, fields, options);
    CHECK(largest_difference_of_columns(fields.topRows(whole.n_vertices()), of_whole) < 1e-9);
    // Where they differ, their mean counts.
    const Index copy = whole.n_vertices();
    const Index of_copy = originals[copy];
    apart.row(copy).array() += 50.0;
    apart.row(of_copy).array() -= 50.0;
    diffuse(mesh, apart, options);
    CHECK((apart.col(3) - fields.col(3)).cwiseAbs().maxCoeff() < 1e-6);
    CHECK(apart.row(copy) == apart.row(of_copy));
    // Where just one of them has data, it counts, and so does it where data are filled.
    Eigen::MatrixXd one = waves_on(mesh).col(1);
    one(copy, 0) = no_data;
    FlowOptions still = options;
    still.steps = 0;
    const double known = one(of_copy, 0);
    const FieldReport report = diffuse(mesh, one, still, {.fill = true});
    CHECK(report.filled == 1);
    CHECK(one(copy, 0) == known);
    CHECK(one(of_copy, 0) == known);
}

TEST_CASE("fields refuse what they do not have, and stay as they were")
{
    const PolygonMesh mesh = test::triangle_grid(4, 4);
    Eigen::MatrixXd fields = Eigen::MatrixXd::Random(mesh.n_vertices(), 2);
    const Eigen::MatrixXd before = fields;
    const auto complaint = [&](const FlowOptions& options, const FieldOptions& of_fields = {}) {
        const std::string text = test::message_of([&] { diffuse(mesh, fields, options, of_fields); });
        CHECK(fields == before);
        return text;
    };
    FlowOptions sweeps{.time_step = 1.0};
    sweeps.accuracy.approach = Approach::Sweep;
    CHECK(complaint(sweeps) == "the steps of fields are solved exactly, and not by sweeps over sub-meshes: leave what "
                               "concerns sweeps out");
    CHECK(complaint({.time_step = 1.0}, {.fwhm = 1.0}) ==
          "fwhm and time_step or radius both say how much is smoothed: leave one of them out");
    CHECK(complaint({.time_step_edges = 1.0}, {.fwhm = 1.0}) ==
          "fwhm and time_step or radius both say how much is smoothed: leave one of them out");
    CHECK(complaint({}, {.fwhm = -1.0}) == "fwhm is -1, but must be positive and finite (a length)");
    CHECK(complaint({.laplacian = Laplacian::AlexaWardetzky, .time_step = 1.0}) ==
          "the Laplacian of a flow is alexa-wardetzky, but fields have one of their own, which is virtual-refinement: "
          "choose it in FieldOptions");
    CHECK(complaint({.time_step = 1.0}, {.laplacian = Laplacian::PtackovaVelho}) ==
          "fields diffuse by a symmetric matrix, which the Laplacian ptackova-velho does not have: use fujiwara, "
          "alexa-wardetzky, virtual-refinement or uniform");
    fields(3, 1) = std::numeric_limits<double>::infinity();
    CHECK(test::message_of([&] { diffuse(mesh, fields, {.time_step = 1.0}); }) ==
          "column 1 of the fields is infinite at vertex 3 (both numbered from 0): give a finite number, or NaN where "
          "there are no data");
    Eigen::MatrixXd short_one = Eigen::MatrixXd::Zero(3, 1);
    CHECK(test::message_of([&] { diffuse(mesh, short_one, {.time_step = 1.0}); }) ==
          "the fields have 3 rows, but the mesh has 25 vertices: give one for each");
}
