#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string_view>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "engine/denoise.h"
#include "engine/measure/mesh_size.h"
#include "engine/measure/remarks.h"
#include "engine/options/option_names.h"
#include "engine/setup/automatic_choices.h"
#include "partition/connected_components.h"
#include "partition/cut/cut_into.h"
#include "partition/errors.h"
#include "partition/metrics/cells.h"
#include "samples/meshes/label_surfaces.h"
#include "samples/meshes/random_numbers.h"
#include "tests/support/flows.h"
#include "tests/support/junction_meshes.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

PolygonMesh plates_at(const std::vector<double>& degrees, Index m, Index n)
{
    std::vector<double> angles;
    for (const double angle : degrees)
        angles.push_back(angle * degree);
    return test::plates(angles, m, n);
}

/// Positions that no symmetry helps.
PolygonMesh roughened(PolygonMesh mesh, double size)
{
    RandomNumbers random(7);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        for (int c = 0; c < 3; ++c)
            mesh.vertices(v, c) += size * random.symmetric();
    return mesh;
}

FlowOptions junction_options(Laplacian laplacian, double time_step, Approach approach)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.time_step = time_step;
    options.accuracy.approach = approach;
    return options;
}

/// The step of equal weights of half-edges and of cotangents, assembled densely, face by face, with edges of one face
/// held.
/// @param weights adds half of K and the shares of M of the triangle's edge from its corner k, given K, M, and the sum
///        of what M is the mean of.
template <class Assemble>
Points dense_step(const PolygonMesh& mesh, double time_step, Assemble&& assemble)
{
    const Index n = mesh.n_vertices();
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(n);
    Eigen::VectorXd divisor = Eigen::VectorXd::Zero(n);
    std::map<std::set<Index>, int> n_faces;
    const auto add_edge = [&](Index a, Index b, double weight) {
        stiffness(a, a) += weight;
        stiffness(b, b) += weight;
        stiffness(a, b) -= weight;
        stiffness(b, a) -= weight;
    };
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto corners = mesh.face(f);
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = corners[k];
            const Index b = corners[(k + 1) % 3];
            const Index opposite = corners[(k + 2) % 3];
            ++n_faces[{a, b}];
            assemble(mesh.vertices.row(a), mesh.vertices.row(b), mesh.vertices.row(opposite),
                     [&](double weight, double of_ends, double of_opposite, double of_divisor) {
                         add_edge(a, b, weight);
                         mass[a] += of_ends;
                         mass[b] += of_ends;
                         mass[opposite] += of_opposite;
                         divisor[a] += of_divisor;
                         divisor[b] += of_divisor;
                     });
        }
    }
    Eigen::MatrixXd matrix = time_step * stiffness;
    for (Index v = 0; v < n; ++v)
        matrix(v, v) += mass[v] *= divisor[v] > 0.0 ? 1.0 / divisor[v] : 1.0;
    Eigen::MatrixXd right = mass.asDiagonal() * Eigen::MatrixXd(mesh.vertices);
    for (const auto& [edge, count] : n_faces)
        for (const Index v : edge)
            if (count == 1) {
                matrix.row(v).setZero();
                matrix(v, v) = 1.0;
                right.row(v) = mesh.vertices.row(v);
            }
    return matrix.fullPivLu().solve(right);
}

Points dense_step(const PolygonMesh& mesh, Laplacian laplacian, double time_step)
{
    if (laplacian == Laplacian::Fujiwara)
        return dense_step(mesh, time_step, [](const Point& a, const Point& b, const Point&, auto&& add) {
            add(0.5 / (b - a).norm(), 0.5 * (b - a).norm(), 0.0, 0.5);
        });
    return dense_step(mesh, time_step, [](const Point& a, const Point& b, const Point& opposite, auto&& add) {
        const double doubled = (a - opposite).cross(b - opposite).norm();
        add(0.5 * (a - opposite).dot(b - opposite) / doubled, 0.0, doubled / 6.0, 0.0);
    });
}

double largest_edge_difference(const PolygonMesh& mesh, const Points& a, const Points& b)
{
    return test::largest_difference(a, b) / size_of(mesh).mean_edge;
}

}  // namespace

TEST_CASE("a step at junctions is that of a dense matrix of all faces there, however it is solved")
{
    const PolygonMesh mesh = roughened(test::cut_into_triangles(plates_at({0, 90, 180}, 4, 6)), 0.2);
    for (const Laplacian laplacian : test::symmetric_geometric_laplacians)
        for (const double time_step : {0.25, 5.0, 50.0}) {
            const Points expected = dense_step(mesh, laplacian, time_step);
            for (const Approach approach :
                 {Approach::Undecomposed, Approach::Converged, Approach::ConjugateGradients}) {
                CAPTURE(name_of(laplacian));
                CAPTURE(time_step);
                CAPTURE(option_name(approach));
                FlowOptions options = junction_options(laplacian, time_step, approach);
                if (approach != Approach::Undecomposed)
                    options.accuracy.tolerance = 1e-13;
                if (approach == Approach::Converged)
                    options.cut.subdomains = 3;
                CHECK(test::largest_difference(test::flowed(mesh, options), expected) < 1e-10);
            }
        }
}

TEST_CASE("three plates at 120° stay where they are")
{
    const PolygonMesh mesh = plates_at({15, 135, 255}, 6, 8);
    for (const Laplacian laplacian : test::symmetric_laplacians)
        for (const Approach approach : {Approach::Undecomposed, Approach::Converged}) {
            CAPTURE(name_of(laplacian));
            FlowOptions options = junction_options(laplacian, 3.0, approach);
            options.steps = 3;
            options.cut.subdomains = approach == Approach::Converged ? 4 : 1;
            CHECK(test::largest_difference(test::flowed(mesh, options), mesh.vertices) < 1e-12);
        }
}

TEST_CASE("plates at other angles move to the point of the shortest connection, and lose area in each step")
{
    constexpr Index m = 6;
    constexpr Index n = 8;
    PolygonMesh mesh = test::cut_into_triangles(plates_at({0, 80, 200}, m, n));
    const auto vertex = [](Index plate, Index i, Index j) { return i == 0 ? j : (n + 1) * (plate * m + i) + j; };
    const std::array ends{Point(mesh.vertices.row(vertex(0, m, 0))), Point(mesh.vertices.row(vertex(1, m, 0))),
                          Point(mesh.vertices.row(vertex(2, m, 0)))};
    // Weiszfeld's iteration for the point of the least sum of distances.
    Point nearest = Point::Zero();
    for (int i = 0; i < 1000; ++i) {
        Point sum = Point::Zero();
        double weights = 0.0;
        for (const Point& end : ends) {
            sum += end / (end - nearest).norm();
            weights += 1.0 / (end - nearest).norm();
        }
        nearest = sum / weights;
    }
    REQUIRE(nearest.norm() > 0.5);
    // The line is held at both ends, and begins there where it is to come.
    double shortest = 0.0;
    for (Index s = 0; s < 3; ++s) {
        shortest += n * (ends[usize(s)] - nearest).norm();
        for (const Index j : {0, n})
            for (Index i = 0; i < m; ++i)
                mesh.vertices.row(vertex(s, i, j)) =
                    nearest + static_cast<double>(i) / m * (ends[usize(s)] - nearest) + Point(0, 0, j);
    }
    FlowOptions options = junction_options(Laplacian::VirtualRefinement, 100.0, Approach::Converged);
    options.cut.subdomains = 4;
    options.accuracy.tolerance = 1e-12;
    options.steps = 30;
    double area = total_area(mesh);
    PolygonMesh now = mesh;
    mean_curvature_flow(mesh, options, [&](const StepState& state) {
        now.vertices = state.positions;
        CHECK(total_area(now) < area * (1.0 + 1e-12));
        area = total_area(now);
    });
    for (Index j = 0; j <= n; ++j)
        CHECK((mesh.vertices.row(j).head<2>() - nearest.head<2>()).norm() < 1e-6);
    CHECK(area == test::relative(shortest, 1e-9));
}

TEST_CASE("two balls with a common wall shrink alike")
{
    PolygonMesh mesh = test::touching_balls(24);
    FlowOptions options = junction_options(Laplacian::VirtualRefinement, 2.0, Approach::Undecomposed);
    options.steps = 4;
    const Points before = mesh.vertices;
    double area = total_area(mesh);
    PolygonMesh now = mesh;
    const FlowReport report = mean_curvature_flow(mesh, options, [&](const StepState& state) {
        now.vertices = state.positions;
        CHECK(total_area(now) < area);
        area = total_area(now);
    });
    CHECK(report.mesh.junction_vertices > 20);
    CHECK(report.mesh.non_manifold_vertices == 0);
    CHECK(std::ranges::count(report.remarks, remark_on_junctions(report.mesh.junction_vertices, options.laplacian)) ==
          1);
    const auto mirrored = [](Point point) {
        point[2] = 24.0 - point[2];
        return point;
    };
    std::map<std::array<double, 3>, Index> at_first;
    const auto key = [](const Point& point) { return std::array{point[0], point[1], point[2]}; };
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        at_first[key(before.row(v))] = v;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const Index image = at_first.at(key(mirrored(before.row(v))));
        CHECK((mesh.vertices.row(image) - mirrored(mesh.vertices.row(v))).norm() < 1e-10);
    }
}

TEST_CASE("two touching balls lose the volumes that dense steps take from them")
{
    PolygonMesh mesh = test::cut_into_triangles(test::touching_balls(10));
    const EnclosedCells cells = find_cells(mesh, mesh.vertices);
    const std::vector<double> before = volumes_of(cells, mesh, mesh.vertices);
    REQUIRE(before.size() == 2);
    PolygonMesh expected = mesh;
    for (int step = 0; step < 2; ++step)
        expected.vertices = dense_step(expected, Laplacian::VirtualRefinement, 0.5);
    FlowOptions options = junction_options(Laplacian::VirtualRefinement, 0.5, Approach::Undecomposed);
    options.steps = 2;
    mean_curvature_flow(mesh, options);
    const std::vector<double> after = volumes_of(cells, mesh, mesh.vertices);
    // Of both together, by the outer faces alone, which are oriented alike.
    const LabelSurface labelled =
        cut_into_triangles(faces_between(10, [](const Point& point) { return two_balls()(point / 10.0); }));
    REQUIRE(labelled.mesh.face_vertices == mesh.face_vertices);
    double volume = 0.0;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (const auto face = mesh.face(f); labelled.front[usize(f)] == 0)
            volume += Point(expected.vertices.row(face[0]))
                          .dot(Point(expected.vertices.row(face[1])).cross(Point(expected.vertices.row(face[2])))) /
                      6.0;
    CHECK(after[0] + after[1] == test::relative(volume, 1e-9));
    const std::vector<double> of_dense = volumes_of(cells, mesh, expected.vertices);
    for (std::size_t c = 0; c < 2; ++c) {
        CHECK(after[c] < before[c]);
        CHECK(after[c] == test::relative(of_dense[c], 1e-9));
    }
}

TEST_CASE("sub-meshes that meet along junctions, or across them, take the undecomposed step")
{
    const PolygonMesh quads = test::foam(12, 5, 3);
    for (const PolygonMesh& mesh : {quads, test::cut_into_triangles(quads)})
        for (const Laplacian laplacian : test::symmetric_laplacians) {
            CAPTURE(name_of(laplacian));
            FlowOptions options = junction_options(laplacian, 2.0, Approach::Undecomposed);
            options.steps = 2;
            const Points expected = test::flowed(mesh, options);
            options.accuracy = {.tolerance = 1e-8, .approach = Approach::Converged};
            std::vector<CutOptions> cuts{{.subdomains = 2}, {.subdomains = 7}, {}, {}};
            const Components sheets = face_components(mesh, make_topology(mesh));
            REQUIRE(sheets.count() > 10);
            cuts[2].labels = sheets.component_of;
            for (Index f = 0; f < mesh.n_faces(); ++f)
                cuts[3].labels.push_back(mesh.vertices(mesh.face(f).front(), 0) < 6.0 ? 0 : 1);
            for (const CutOptions& cut : cuts) {
                options.cut = cut;
                CHECK(largest_edge_difference(mesh, test::flowed(mesh, options), expected) < 1e-6);
            }
        }
}

TEST_CASE("parts reach across junctions that move, and end at those that are held")
{
    const PolygonMesh mesh = plates_at({0, 90, 180}, 8, 12);
    Topology topology = make_topology(mesh);
    CHECK(cut_into(mesh, topology, 2).n_parts == 3);
    free_junctions(mesh, topology);
    CHECK(face_components(mesh, topology).count() == 1);
    CHECK(cut_into(mesh, topology, 2).n_parts == 2);
    std::vector<Index> halves;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        halves.push_back(mesh.vertices(mesh.face(f).front(), 2) < 6.0 ? 0 : 1);
    const Cut cut = cut_by_labels(mesh, topology, halves);
    CHECK(cut.n_parts == 2);
    CHECK(cut.repaired_faces == 0);
}

TEST_CASE("where edges are kept junctions stay, and a remark says why; where noise is removed they move")
{
    const PolygonMesh first = roughened(plates_at({0, 90, 180}, 8, 8), 0.1);
    DenoiseOptions options;
    options.motion.boundary = Boundary::Fixed;
    for (const bool keeps_edges : {true, false}) {
        if (keeps_edges)
            options.method = SmoothBetweenEdges{30.0, {.time_step = 1.0}};
        else
            options.method = RemoveNoise{};
        PolygonMesh mesh = first;
        const DenoiseReport report = denoise(mesh, options);
        CHECK((!keeps_edges || mesh.vertices.middleRows(1, 7) == first.vertices.middleRows(1, 7)));
        CHECK(report.mesh.junction_vertices == (keeps_edges ? 0 : 7));
        CHECK(report.mesh.non_manifold_vertices == (keeps_edges ? 9 : 0));
        CHECK(std::ranges::count(report.remarks, remark_on_non_manifold_vertices(9, "Without edges that are kept")) ==
              keeps_edges);
    }
}

TEST_CASE("where steps cannot move junctions, or must not, they stay, and a remark says why")
{
    const PolygonMesh first = roughened(plates_at({0, 90, 180}, 8, 8), 0.1);
    FlowOptions plain = junction_options(Laplacian::VirtualRefinement, 1.0, Approach::Automatic);
    const auto line_moves = [&](const FlowOptions& options, std::string_view need) {
        PolygonMesh mesh = first;
        const FlowReport report = mean_curvature_flow(mesh, options);
        // The inner vertices of the axis; its ends are on the boundary.
        const bool moves = mesh.vertices.middleRows(1, 7) != first.vertices.middleRows(1, 7);
        CHECK(need_of_junctions(options) == need);
        CHECK(report.mesh.junction_vertices == (moves ? 7 : 0));
        // Held, the ends count, too.
        CHECK(report.mesh.non_manifold_vertices == (moves ? 0 : 9));
        CHECK(std::ranges::count(report.remarks, remark_on_non_manifold_vertices(9, need)) == (moves ? 0 : 1));
        return moves;
    };
    CHECK(line_moves(plain, ""));
    FlowOptions options = plain;
    options.motion.junctions = Junctions::Hold;
    CHECK_FALSE(line_moves(options, ""));
    options = plain;
    options.laplacian = Laplacian::PtackovaVelho;
    CHECK_FALSE(line_moves(options, "With a symmetric Laplacian"));
    options = plain;
    options.accuracy.approach = Approach::Sweep;
    CHECK_FALSE(line_moves(options, "In converged steps"));
    options.cut.subdomains = 1;
    CHECK(line_moves(options, ""));
    options = plain;
    options.cut.subdomains = 4;
    CHECK(line_moves(options, ""));
    options.interface.p = 1.0;
    CHECK_FALSE(line_moves(options, "In converged steps"));
    options = plain;
    options.scheme = Scheme::ExplicitEuler;
    options.time_step = 0.1;
    CHECK(line_moves(options, ""));
}

TEST_CASE("cones that touch in a point alone are held there")
{
    PolygonMesh mesh = test::hourglass();
    const Point tip = mesh.vertices.row(0);
    const FlowReport report =
        mean_curvature_flow(mesh, junction_options(Laplacian::Fujiwara, 0.01, Approach::Automatic));
    CHECK(mesh.vertices.row(0) == tip);
    CHECK(report.mesh.non_manifold_vertices == 1);
    CHECK(report.mesh.junction_vertices == 0);
}

TEST_CASE("the area of meeting sheets can be kept, their volume not")
{
    PolygonMesh mesh = test::touching_balls(12);
    const double area = total_area(mesh);
    FlowOptions options = junction_options(Laplacian::VirtualRefinement, 1.0, Approach::Automatic);
    options.motion.rescale = Rescale::Volume;
    CHECK_THROWS_WITH_AS(mean_curvature_flow(mesh, options), doctest::Contains("three faces or more"), InputError);
    options.motion.rescale = Rescale::Area;
    mean_curvature_flow(mesh, options);
    CHECK(total_area(mesh) == test::relative(area, 1e-12));
}

TEST_CASE("sheets that meet count as one component for limits")
{
    PolygonMesh mesh = roughened(test::touching_balls(12), 0.1);
    const PolygonMesh first = mesh;
    FlowOptions options = junction_options(Laplacian::VirtualRefinement, 2.0, Approach::Undecomposed);
    const Points whole = test::flowed(mesh, options);
    options.motion.limits.move = 0.05;
    mean_curvature_flow(mesh, options);
    // Every vertex keeps the same fraction of its displacement.
    const Points kept = mesh.vertices - first.vertices;
    const Points all = whole - first.vertices;
    const double factor = kept.norm() / all.norm();
    CHECK(factor < 0.9);
    CHECK(test::largest_difference(kept, factor * all) < 1e-12);
}
