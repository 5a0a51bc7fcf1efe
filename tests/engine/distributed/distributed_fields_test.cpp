// Fields that diffuse on ranks, beside those of one machine.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <mutex>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include "engine/distributed/cut/distributed_cut.h"
#include "engine/distributed/cut/seams_of_fields.h"
#include "engine/distributed/distributed_fields.h"
#include "engine/distributed/parts/field_rows.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "engine/distributed/ranks/thread_transport.h"
#include "engine/fields/diffuse.h"
#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "tests/engine/distributed/parts.h"
#include "tests/engine/distributed/shared_files.h"
#include "tests/support/flows.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

constexpr double lacking_datum = std::numeric_limits<double>::quiet_NaN();

struct FieldExample {
    PolygonMesh mesh;
    Eigen::MatrixXd fields;
    FlowOptions options;
    FieldOptions of_fields = {};
    std::vector<Index> fixed = {};
};

bool are_same_bits(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
    return a.rows() == b.rows() && a.cols() == b.cols() &&
           std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

FlowOptions field_steps(double time_step, Index subdomains)
{
    FlowOptions options{.time_step = time_step, .steps = 2};
    options.accuracy.approach = Approach::Converged;
    options.accuracy.tolerance = 1e-10;
    options.cut.subdomains = subdomains;
    options.resources.threads = 1;
    return options;
}

/// Seven columns of different sizes, the last of them constant.
Eigen::MatrixXd columns_on(const PolygonMesh& mesh)
{
    Eigen::MatrixXd fields(mesh.n_vertices(), 7);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const Point p = mesh.vertices.row(v);
        fields.row(v) << std::sin(9.0 * p.x()), 1e6 + std::cos(7.0 * p.y()), 1e-9 * p.x() * p.y(), (v * 37) % 256,
            p.x() > 0.4 ? 1e3 : -1e3, p.z(), 0.1;
    }
    return fields;
}

/// Holes, a strip, and single vertices in columns 0, 2, 4 and 5; 4 is as 0.
void take_data_away(const PolygonMesh& mesh, Eigen::MatrixXd& fields)
{
    std::mt19937 random(7);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const Point p = mesh.vertices.row(v);
        if ((p.head<2>() - Eigen::RowVector2d(0.5, 0.5)).norm() < 0.2)
            fields(v, 0) = fields(v, 4) = lacking_datum;
        if (std::abs(p.x() - 0.3) < 0.05 || std::abs(p.y() - 0.6) < 0.05)
            fields(v, 2) = lacking_datum;
        if (random() % 4 == 0)
            fields(v, 5) = lacking_datum;
    }
}

Eigen::MatrixXd diffused_on_ranks(const FieldExample& example, const std::vector<Index>& labels, int n,
                                  int expected_short_of_tolerance = 0)
{
    Eigen::MatrixXd all = example.fields;
    std::mutex mutex;
    std::vector<std::uint8_t> is_there(at(example.mesh.n_vertices()), 0);
    run_on_threads(n, [&](Transport& transport) {
        const MeshPart part = test::part_of(example.mesh, labels, transport.rank(), n, example.fixed);
        Eigen::MatrixXd fields = example.fields(part.vertex_numbers, Eigen::all);
        FlowOptions options = example.options;
        options.cut = {};
        const FieldReport report = diffuse_on_ranks(transport, part, fields, options, example.of_fields);
        CHECK(report.flow.convergence.steps_short_of_tolerance == expected_short_of_tolerance);
        const std::scoped_lock lock(mutex);
        for (std::size_t i = 0; i < part.vertex_numbers.size(); ++i) {
            const auto v = static_cast<Index>(part.vertex_numbers[i]);
            const Eigen::MatrixXd row = fields.row(static_cast<Index>(i));
            if (std::exchange(is_there[v], std::uint8_t{1}) != 0)
                CHECK(are_same_bits(row, all.row(v)));
            all.row(v) = row;
        }
    });
    return all;
}

std::vector<Index> labels_for(const FieldExample& example)
{
    PolygonMesh mesh = example.mesh;
    FlowOptions options = example.options;
    options.steps = 1;
    options.time_step = 1e-6;
    options.accuracy.approach = Approach::Converged;
    return mean_curvature_flow(mesh, options).cut.labels;
}

/// Whether all faces around a vertex have that label.
bool is_inside(const PolygonMesh& mesh, const std::vector<Index>& labels, Index label, Index v)
{
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (labels[f] != label && std::ranges::find(mesh.face(f), v) != mesh.face(f).end())
            return false;
    return true;
}

/// In units of the spread of each column; those of NaN have to be the same.
double distance_of_fields(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
    double largest = 0.0;
    for (Eigen::Index c = 0; c < b.cols(); ++c) {
        double least = std::numeric_limits<double>::infinity();
        double most = -least;
        double difference = 0.0;
        for (Eigen::Index v = 0; v < b.rows(); ++v) {
            CHECK(std::isnan(a(v, c)) == std::isnan(b(v, c)));
            if (std::isnan(b(v, c)))
                continue;
            least = std::min(least, b(v, c));
            most = std::max(most, b(v, c));
            difference = std::max(difference, std::abs(a(v, c) - b(v, c)));
        }
        if (difference > 0.0)
            largest = std::max(largest, difference / (most - least));
    }
    return largest;
}

/// On ranks, which have the same bits, and on one machine.
/// @returns the latter.
Eigen::MatrixXd check_fields(const FieldExample& example, bool by_bits, double tolerance = 1e-8)
{
    const std::vector<Index> labels = labels_for(example);
    Eigen::MatrixXd expected = example.fields;
    FlowOptions options = example.options;
    options.cut.subdomains = 0;
    options.cut.labels = labels;
    options.motion.fixed_vertices = example.fixed;
    diffuse(example.mesh, expected, options, example.of_fields);
    const Eigen::MatrixXd by_one = diffused_on_ranks(example, labels, 1);
    CHECK(distance_of_fields(by_one, expected) < tolerance);
    if (by_bits)
        CHECK(are_same_bits(by_one, expected));
    for (const int n : {2, 3, 5}) {
        CAPTURE(n);
        CHECK(are_same_bits(diffused_on_ranks(example, labels, n), by_one));
    }
    return by_one;
}

std::string complaint_of_ranks(const FieldExample& example, int n = 2)
{
    const std::vector<Index> labels = labels_for(example);
    std::string said;
    std::mutex mutex;
    run_on_threads(n, [&](Transport& transport) {
        const MeshPart part = test::part_of(example.mesh, labels, transport.rank(), n);
        Eigen::MatrixXd fields = example.fields(part.vertex_numbers, Eigen::all);
        const Eigen::MatrixXd before = fields;
        FlowOptions options = example.options;
        options.cut = {};
        try {
            diffuse_on_ranks(transport, part, fields, options, example.of_fields);
        } catch (const std::exception& error) {
            const std::scoped_lock lock(mutex);
            said = error.what();
            CHECK(are_same_bits(fields, before));
        }
    });
    return said;
}

}  // namespace

TEST_CASE("fields on ranks have the bits of one machine, for any number of ranks")
{
    for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement})
        for (const PolygonMesh& mesh : test::height_fields(900)) {
            const FieldExample example{mesh, columns_on(mesh), field_steps(1e-2, 9), {.laplacian = laplacian}};
            const Eigen::MatrixXd after = check_fields(example, true);
            CHECK(after.col(6) == example.fields.col(6));
            CHECK(after.col(0) != example.fields.col(0));
        }
    FieldExample example{make_mixed_polygons(900), {}, field_steps(1e-2, 9)};
    example.mesh.vertices.rowwise() += Point(1e5, -3e4, 1e6);
    example.fields = columns_on(example.mesh);
    check_fields(example, true);
    example.options.filter = Filter::LowPass;
    check_fields(example, true);
    example.options.filter = Filter::Diffusion;
    example.options.resources.threads = 3;
    check_fields(example, true);
    example.options.time_step = 0.0;
    example.of_fields.fwhm = 0.2;
    check_fields(example, true);
}

TEST_CASE("fields on ranks: a step that misses its tolerance counts once, with any columns")
{
    FieldExample example{make_triangles(900), {}, field_steps(1e-2, 8)};
    example.fields = columns_on(example.mesh);
    const std::vector<Index> labels = labels_for(example);
    example.options.accuracy.tolerance = 1e-40;
    diffused_on_ranks(example, labels, 2, example.options.steps);
}

TEST_CASE("fields on ranks: vertices and a boundary that are held keep their values, bit for bit")
{
    FieldExample example{make_triangles(900), {}, field_steps(1e-2, 8)};
    example.fields = columns_on(example.mesh);
    example.fixed = {17, 400, 401};
    example.of_fields.boundary = Boundary::Fixed;
    const Topology topology = make_topology(example.mesh);
    const Eigen::MatrixXd after = check_fields(example, true);
    for (Index v = 0; v < example.mesh.n_vertices(); ++v)
        if (topology.kind[v] == VertexKind::Boundary || v == 17 || v == 400 || v == 401)
            CHECK(after.row(v) == example.fields.row(v));
}

TEST_CASE("fields on ranks: vertices without data take no part, whatever that leaves of sub-meshes")
{
    for (const double time_step : {1e-3, 3e-2}) {
        FieldExample example{make_triangles(1500), {}, field_steps(time_step, 12)};
        example.fields = columns_on(example.mesh);
        take_data_away(example.mesh, example.fields);
        check_fields(example, false);
        // Those of columns 1 and 3 do not depend on the others.
        const Eigen::MatrixXd after = diffused_on_ranks(example, labels_for(example), 3);
        example.fields.col(0) = example.fields.col(5) = example.fields.col(1);
        const Eigen::MatrixXd others = diffused_on_ranks(example, labels_for(example), 3);
        CHECK(distance_of_fields(after.col(3), others.col(3)) < 1e-8);
    }
    // Two columns that differ at vertices that rank 0 does not have.
    FieldExample apart{make_triangles(600), {}, field_steps(1e-2, 6)};
    apart.fields = columns_on(apart.mesh).leftCols(2);
    const std::vector<Index> labels = labels_for(apart);
    for (Index v = 0; v < apart.mesh.n_vertices(); ++v)
        if (is_inside(apart.mesh, labels, 1, v))
            apart.fields(v, 1) = lacking_datum;
    REQUIRE(apart.fields.col(1).hasNaN());
    check_fields(apart, false);
    // No column has any; data at one rank alone.
    FieldExample example{make_triangles(600), {}, field_steps(1e-2, 6)};
    example.fields = columns_on(example.mesh);
    example.fields.col(1).setConstant(lacking_datum);
    example.fields.col(3).tail(example.mesh.n_vertices() - 20).setConstant(lacking_datum);
    check_fields(example, false);
    example.fields.setConstant(lacking_datum);
    check_fields(example, true);
}

TEST_CASE("fields on ranks: faces that repeat others are left out")
{
    FieldExample example{make_triangles(600), {}, field_steps(1e-2, 6)};
    const Index n = example.mesh.n_faces();
    for (Index f = 0; f < n; f += 3) {
        const auto face = example.mesh.face(f);
        const std::vector<Index> again(face.begin(), face.end());
        example.mesh.add_face(again);
    }
    example.fields = columns_on(example.mesh);
    std::vector<Index> labels = labels_for(example);
    // Whoever has them.
    for (std::size_t f = at(n); f < labels.size(); ++f)
        labels[f] = static_cast<Index>(f % 6);
    Eigen::MatrixXd expected = example.fields;
    diffuse(example.mesh, expected, example.options);
    const Eigen::MatrixXd by_one = diffused_on_ranks(example, labels, 1);
    CHECK(distance_of_fields(by_one, expected) < 1e-8);
    CHECK(are_same_bits(diffused_on_ranks(example, labels, 3), by_one));
}

TEST_CASE("what fields on ranks cannot be is refused by all, and changes nothing")
{
    FieldExample example{make_triangles(400), {}, field_steps(1e-2, 4)};
    example.fields = columns_on(example.mesh);
    const auto refuses = [&](const std::string& what) {
        const std::string said = complaint_of_ranks(example);
        CAPTURE(said);
        CHECK(said.find(what) != std::string::npos);
    };
    example.of_fields = {.fill = true};
    refuses("do not fill");
    example.of_fields = {.keep_edges = 3.0};
    refuses("do not keep edges");
    example.of_fields = {.fwhm = 0.1};
    refuses("leave one of them out");
    example.of_fields = {};
    example.options.accuracy.approach = Approach::Sweep;
    refuses("not by sweeps");
    example.options.accuracy.approach = Approach::ConjugateGradients;
    refuses("in converged steps");
    example.options.accuracy.approach = Approach::Automatic;
    CHECK(complaint_of_ranks(example).empty());
    example.fields(77, 2) = std::numeric_limits<double>::infinity();
    refuses("column 2 of the fields is infinite at vertex 77 ");
}

TEST_CASE("fields of joined vertices are their means, and come back to all of them")
{
    // Two sheets side by side, the border between them doubled.
    const PolygonMesh one = make_triangles(300);
    PolygonMesh mesh = test::side_by_side({one, one});
    const double width = one.vertices.col(0).maxCoeff() - one.vertices.col(0).minCoeff();
    mesh.vertices.bottomRows(one.n_vertices()) = one.vertices;
    mesh.vertices.bottomRows(one.n_vertices()).col(0) =
        (2.0 * one.vertices.col(0).maxCoeff() - one.vertices.col(0).array()).matrix();
    for (Index f = one.n_faces(); f < mesh.n_faces(); ++f)
        std::reverse(mesh.face_vertices.begin() + mesh.face_offsets[f],
                     mesh.face_vertices.begin() + mesh.face_offsets[f + 1]);
    FieldExample example{mesh, columns_on(mesh), field_steps(1e-2 * width, 5)};
    example.fields.col(6).setConstant(1.0 / 3.0);
    Eigen::MatrixXd expected = example.fields;
    diffuse(mesh, expected, example.options);
    for (const int n : {1, 3}) {
        Eigen::MatrixXd all = example.fields;
        std::mutex mutex;
        run_on_threads(n, [&](Transport& transport) {
            MeshPart part;
            JoinedSeams seams;
            SliceBounds bounds;
            Eigen::MatrixXd own;
            Eigen::MatrixXd of_part;
            run_together(transport, [&](Communicator& comm) {
                RankSlice slice = hand_out(comm, mesh, 64);
                bounds = gather_bounds(comm, slice);
                seams = cut_together(comm, slice, example.options).seams;
                part = deal(comm, slice);
                const auto begin = static_cast<Index>(bounds.vertices[at(comm.rank())]);
                own = example.fields.middleRows(begin, slice.vertices.rows());
                join_fields(comm, seams, bounds.vertices, own);
                of_part = fetch_fields(comm, own, part.vertex_numbers, bounds.vertices);
            });
            CHECK(seams.n_copies > 5);
            FlowOptions options = example.options;
            options.cut = {};
            options.motion.weld.reset();
            diffuse_on_ranks(transport, part, of_part, options);
            run_together(transport, [&](Communicator& comm) {
                collect_fields(comm, part.vertex_numbers, of_part, own);
                bring_back_fields(comm, seams, bounds.vertices, own);
            });
            const std::scoped_lock lock(mutex);
            all.middleRows(static_cast<Index>(bounds.vertices[at(transport.rank())]), own.rows()) = own;
        });
        CHECK(distance_of_fields(all, expected) < 1e-8);
        CHECK(all.col(6) == example.fields.col(6));
    }
}
