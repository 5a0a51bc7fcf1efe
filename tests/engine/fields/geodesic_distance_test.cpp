#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/geodesic_distance.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/junction_meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::relative;

namespace {

/// The mean of the differences, as a part of the mean distance.
double mean_error(const Eigen::VectorXd& distance, const Eigen::VectorXd& exact)
{
    return (distance - exact).cwiseAbs().sum() / exact.sum();
}

Index nearest_to(const PolygonMesh& mesh, const Point& place)
{
    Eigen::Index nearest = 0;
    (mesh.vertices.rowwise() - place).rowwise().squaredNorm().minCoeff(&nearest);
    return static_cast<Index>(nearest);
}

/// The length of the shortest way along edges, found by looking at all edges again and again.
Eigen::VectorXd along_edges(const PolygonMesh& mesh, std::span<const Index> from)
{
    Eigen::VectorXd length = Eigen::VectorXd::Constant(mesh.n_vertices(), std::numeric_limits<double>::infinity());
    for (const Index v : from)
        length[v] = 0.0;
    Eigen::VectorXd before;
    do {
        before = length;
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            Index v = mesh.face(f).back();
            for (const Index w : mesh.face(f)) {
                const double edge = (mesh.vertices.row(w) - mesh.vertices.row(v)).norm();
                length[w] = std::min(length[w], length[v] + edge);
                length[v] = std::min(length[v], length[w] + edge);
                v = w;
            }
        }
    } while (before != length);
    return length;
}

Eigen::VectorXd from_place(const PolygonMesh& mesh, Index v)
{
    return (mesh.vertices.rowwise() - mesh.vertices.row(v)).rowwise().norm();
}

}  // namespace

TEST_CASE("geodesic distances of planes and spheres come near to the exact ones, on any polygons")
{
    const auto flat = [](PolygonMesh mesh) {
        mesh.vertices.col(2).setZero();
        return mesh;
    };
    const std::vector<PolygonMesh> meshes{flat(make_triangles(4000)), flat(make_quads(4000)), flat(make_hexagons(4000)),
                                          flat(make_mixed_polygons(4000))};
    for (const PolygonMesh& mesh : meshes)
        for (const Point& place : {Point(0.5, 0.5, 0.0), Point(0.1, 0.3, 0.0), Point(0.0, 0.0, 0.0),
                                   Point(0.5, 0.0, 0.0), Point(1.0, 0.3, 0.0)}) {
            CAPTURE(mesh.n_faces());
            CAPTURE(place);
            const Index from = nearest_to(mesh, place);
            const Eigen::VectorXd distance = geodesic_distance(mesh, std::array{from});
            CHECK(mean_error(distance, from_place(mesh, from)) < 0.007);
            CHECK(distance[from] == 0.0);
            CHECK(distance.minCoeff() == 0.0);
        }
    const PolygonMesh sphere = make_noisy_sphere(10000, {.amplitude = 0.0, .noise = 0.0});
    for (const Point& place : {Point(0.0, 0.0, 1.0), Point(0.6, 0.0, 0.8)}) {
        const Index from = nearest_to(sphere, place);
        const Eigen::VectorXd cosines =
            (sphere.vertices.rowwise().normalized() * sphere.vertices.row(from).normalized().transpose());
        const Eigen::VectorXd exact = cosines.array().min(1.0).max(-1.0).acos();
        const Eigen::VectorXd distance = geodesic_distance(sphere, std::array{from});
        CHECK(mean_error(distance, exact) < 0.002);
    }
}

TEST_CASE("geodesic distances come near to the exact ones on a cube, and across lines where sheets meet")
{
    // From a corner every other face is reached best by one edge of the first three, unfolded there.
    PolygonMesh cube = faces_between(22, [](const Point& p) {
                           return ((p.array() > 1.0) && (p.array() < 21.0)).all() ? Index{1} : Index{0};
                       }).mesh;
    cube.vertices = (cube.vertices.array() - 1.0) / 20.0;
    const auto exact_on_cube = [](const Point& p) {
        if (p.minCoeff() == 0.0)
            return p.norm();
        Eigen::Index far = 0;
        p.maxCoeff(&far);
        const double a = p[(far + 1) % 3];
        const double b = p[(far + 2) % 3];
        return std::min(std::hypot(1.0 + a, b), std::hypot(1.0 + b, a));
    };
    for (const PolygonMesh& mesh : {cube, test::cut_into_triangles(cube)}) {
        Eigen::VectorXd exact(mesh.n_vertices());
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            exact[v] = exact_on_cube(mesh.vertices.row(v));
        CHECK(mean_error(geodesic_distance(mesh, std::array{nearest_to(mesh, Point::Zero())}), exact) < 0.02);
    }
    // Any two plates are a plane, unfolded.
    constexpr Index m = 20;
    const std::array angles{0.2, 1.5, 3.0};
    const PolygonMesh plates = test::plates(angles, m, 2 * m);
    const Index from = nearest_to(plates, Point(10.0 * std::cos(0.2), 10.0 * std::sin(0.2), m));
    Eigen::VectorXd exact(plates.n_vertices());
    for (Index v = 0; v < plates.n_vertices(); ++v) {
        const Point p = plates.vertices.row(v);
        const bool is_same_plate = v < (m + 1) * (2 * m + 1);
        exact[v] = std::hypot(10.0 + (is_same_plate ? -1.0 : 1.0) * p.head<2>().norm(), p[2] - m);
    }
    CHECK(mean_error(geodesic_distance(plates, std::array{from}), exact) < 0.02);
}

TEST_CASE("geodesic distances scale with the mesh, and do not depend on threads or on where it lies")
{
    const PolygonMesh mesh = make_noisy_sphere(2000);
    const std::array<Index, 2> from{5, 900};
    const Eigen::VectorXd distance = geodesic_distance(mesh, from);
    CHECK(geodesic_distance(mesh, from, {.threads = 1}) == distance);
    PolygonMesh scaled = mesh;
    scaled.vertices *= 0x1p-20;
    CHECK((geodesic_distance(scaled, from) * 0x1p20 - distance).cwiseAbs().maxCoeff() < 1e-7);
    // Of sizes whose squares overflow, or vanish: the same bits.
    for (const double unit : {0x1p600, 0x1p-600, 0x1p1000, 0x1p-990}) {
        CAPTURE(unit);
        scaled.vertices = mesh.vertices * unit;
        CHECK(geodesic_distance(scaled, from) / unit == distance);
    }
    for (const double unit : {1e-150, 1e150}) {
        scaled.vertices = mesh.vertices * unit;
        CHECK((geodesic_distance(scaled, from) / unit - distance).cwiseAbs().maxCoeff() < 1e-9);
    }
    scaled.vertices = mesh.vertices * 0x1p1023;
    CHECK_THROWS_WITH_AS(geodesic_distance(scaled, from),
                         "distances are larger than numbers can be: give the coordinates in a larger unit", InputError);
    PolygonMesh far = mesh;
    far.vertices.rowwise() += Eigen::RowVector3d(1e5, -2e5, 3e5);
    CHECK((geodesic_distance(far, from) - distance).cwiseAbs().maxCoeff() < 1e-5);
    // To the nearer of the two.
    for (const Index v : {Index{5}, Index{900}}) {
        const Eigen::VectorXd from_one = geodesic_distance(mesh, std::array{v});
        CHECK((from_one - distance).minCoeff() > -3.0 * mean_edge_length(mesh));
        CHECK(distance[v] == 0.0);
    }
}

TEST_CASE("geodesic distances continue across seams, and are infinite where the surface does not lead")
{
    PolygonMesh whole = make_triangles(900);
    whole.vertices.col(2).setZero();
    const PolygonMesh seams = test::split(whole, test::halves(whole));
    REQUIRE(seams.n_vertices() > whole.n_vertices());
    const std::array<Index, 1> from{40};
    const Eigen::VectorXd of_whole = geodesic_distance(whole, from);
    const Eigen::VectorXd across = geodesic_distance(seams, from);
    CHECK((across.head(whole.n_vertices()) - of_whole).cwiseAbs().maxCoeff() < 1e-9);
    CHECK(across.allFinite());

    const PolygonMesh two = test::side_by_side({test::triangle_grid(6, 6), test::triangle_grid(3, 3)});
    const Eigen::VectorXd distance = geodesic_distance(two, from);
    CHECK(distance.head(49).allFinite());
    CHECK(distance.tail(16).array().isInf().all());
    CHECK(distance[48] == relative(std::sqrt(2.0), 1e-12));
}

TEST_CASE("geodesic distances refuse vertices that are not there")
{
    const PolygonMesh mesh = test::triangle_grid(3, 3);
    CHECK_THROWS_WITH_AS(geodesic_distance(mesh, {}), "there is no vertex to measure distances from: name one at least",
                         InputError);
    CHECK_THROWS_WITH_AS(geodesic_distance(mesh, std::array<Index, 1>{16}),
                         "distances are wanted from vertex 16, but the mesh has 16 vertices, numbered from 0",
                         InputError);
}

TEST_CASE("geodesic distances lie between the straight ones and those along edges, from the nearest of many vertices")
{
    PolygonMesh mesh = make_triangles(1600);
    mesh.vertices.col(2).setZero();
    std::vector<Index> from;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (v % 97 == 3)
            from.push_back(v);
    const Eigen::VectorXd distance = geodesic_distance(mesh, from);
    Eigen::VectorXd exact = from_place(mesh, from.front());
    for (const Index v : from)
        exact = exact.cwiseMin(from_place(mesh, v));
    CHECK((distance - exact).minCoeff() > -1e-12);
    CHECK(mean_error(distance, exact) < 0.032);
    CHECK((distance - along_edges(mesh, from)).maxCoeff() < 1e-12);
    // From a single vertex, the rows of the mesh lead along edges as straight as can be.
    const std::array<Index, 1> one{from[3]};
    CHECK((geodesic_distance(mesh, one) - along_edges(mesh, one)).maxCoeff() < 1e-12);
    // Vertices of one face with several of them: the nearest counts.
    const PolygonMesh grid = test::quad_grid(5, 2);
    CHECK(geodesic_distance(grid, std::array<Index, 2>{0, 7})[6] == 1.0);
    CHECK(geodesic_distance(grid, std::array<Index, 2>{7, 0})[6] == 1.0);
}

TEST_CASE("geodesic distances bear meshes without faces, faces without area, and parts of any size")
{
    PolygonMesh empty;
    empty.vertices = Points::Random(4, 3);
    const Eigen::VectorXd of_empty = geodesic_distance(empty, std::array<Index, 1>{2});
    CHECK(of_empty[2] == 0.0);
    CHECK(std::isinf(of_empty[0]));

    // A vertex far away, a sliver on an edge, and a tiny component that is reached, too.
    PolygonMesh mesh = make_triangles(1500);
    mesh.vertices.col(2).setZero();
    const std::array<Index, 1> from{700};
    const Eigen::VectorXd alone = geodesic_distance(mesh, from);
    const Index n = mesh.n_vertices();
    mesh.vertices.conservativeResize(n + 5, 3);
    mesh.vertices.row(n) << 1e9, 0.0, 0.0;
    mesh.vertices.row(n + 1) = 0.5 * (mesh.vertices.row(0) + mesh.vertices.row(1));
    mesh.add_face(std::array{Index{0}, n + 1, Index{1}});
    for (Index i = 0; i < 3; ++i)
        mesh.vertices.row(n + 2 + i) << 3.0 + 1e-6 * i, 1e-6 * (i % 2), 0.0;
    mesh.add_face(std::array{n + 2, n + 3, n + 4});
    const Eigen::VectorXd distance = geodesic_distance(mesh, std::array{Index{700}, n + 3});
    CHECK((distance.head(n) - alone).cwiseAbs().maxCoeff() < 0.1);
    CHECK(std::isinf(distance[n]));
    CHECK(std::isfinite(distance[n + 1]));
    CHECK(distance[n + 4] == relative(std::sqrt(2.0) * 1e-6, 1e-6));
}

TEST_CASE("distances from one vertex after the other are those of one call each, also from the boundary")
{
    PolygonMesh open = make_triangles(1200);
    const Topology topology = make_topology(open);
    const Index on_boundary =
        static_cast<Index>(std::ranges::find(topology.kind, VertexKind::Boundary) - topology.kind.begin());
    for (const PolygonMesh& mesh : {open, make_noisy_sphere(1000)}) {
        Geodesics geodesics(mesh);
        for (const std::vector<Index>& from :
             {std::vector<Index>{600}, {on_boundary, 601}, {7, 7, 333}, {on_boundary}, {42}})
            CHECK(geodesics.distance(from) == geodesic_distance(mesh, from));
    }
}

TEST_CASE("where the lengths of edges differ too much for distances, the vertex is named")
{
    PolygonMesh mesh = make_noisy_sphere(600);
    mesh.vertices.row(123) *= 1e8;
    CHECK_THROWS_WITH_AS(geodesic_distance(mesh, std::array<Index, 1>{5}),
                         doctest::Contains("vertex 123 (numbered from 0) is"), InputError);
}
