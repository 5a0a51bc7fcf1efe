#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/cells.h"
#include "partition/vector_area.h"
#include "samples/meshes/label_surfaces.h"
#include "samples/meshes/meshes.h"
#include "samples/meshes/random_numbers.h"
#include "tests/support/junction_meshes.h"
#include "tests/support/random_meshes.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

std::vector<double> volumes_of_cells(const PolygonMesh& mesh)
{
    return volumes_of(find_cells(mesh, mesh.vertices), mesh, mesh.vertices);
}

/// Faces in another order, from other corners on and turned at random; vertices in another order.
PolygonMesh shuffled_mesh(const PolygonMesh& mesh, std::uint32_t seed)
{
    return test::with_faces_flipped(test::shuffled(mesh, seed).mesh, seed);
}

PolygonMesh without_faces(const PolygonMesh& mesh, std::span<const Index> left_out)
{
    PolygonMesh rest;
    rest.vertices = mesh.vertices;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (std::ranges::find(left_out, f) == left_out.end())
            rest.add_face(mesh.face(f));
    return rest;
}

/// The volume of each label by the normals of its faces.
std::map<Index, double> volumes_of_labels(const LabelSurface& surface)
{
    std::map<Index, double> of_label;
    const PolygonMesh& mesh = surface.mesh;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        Point mean = Point::Zero();
        for (const Index v : mesh.face(f))
            mean += mesh.vertices.row(v) / static_cast<double>(mesh.face(f).size());
        const double cone = vector_area(mesh.face(f), mesh.vertices).dot(mean) / 3.0;
        of_label[surface.back[usize(f)]] += cone;
        of_label[surface.front[usize(f)]] -= cone;
    }
    of_label.erase(0);
    return of_label;
}

void check_near(const std::vector<double>& found, const std::vector<double>& expected)
{
    REQUIRE(found.size() == expected.size());
    for (std::size_t c = 0; c < found.size(); ++c)
        CHECK(found[c] == test::relative(expected[c], 1e-9));
}

/// Two boxes of 3 by 4 by 5 and by 2 cubes with a common wall.
LabelSurface two_boxes()
{
    return faces_between(9, [](const Point& p) {
        const bool is_inside = p[0] > 1.0 && p[0] < 4.0 && p[1] > 1.0 && p[1] < 5.0 && p[2] > 1.0 && p[2] < 8.0;
        return is_inside ? (p[2] < 6.0 ? Index{1} : Index{2}) : Index{0};
    });
}

}  // namespace

TEST_CASE("two boxes with a common wall are two cells, whichever way faces and vertices are numbered and turned")
{
    const PolygonMesh mesh = two_boxes().mesh;
    check_near(volumes_of_cells(mesh), {60.0, 24.0});
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        check_near(volumes_of_cells(shuffled_mesh(mesh, seed)), {60.0, 24.0});
        check_near(volumes_of_cells(shuffled_mesh(test::cut_into_triangles(mesh), seed)), {60.0, 24.0});
    }
    PolygonMesh far = mesh;
    far.vertices.rowwise() += Point(1e6, -1e6, 1e6);
    check_near(volumes_of_cells(far), {60.0, 24.0});
    // However flat they are.
    PolygonMesh flat = mesh;
    flat.vertices.col(2) *= 0x1p-10;
    check_near(volumes_of_cells(flat), {60.0 * 0x1p-10, 24.0 * 0x1p-10});
}

TEST_CASE("a cell with a hole is open, cells with a hole between them are one, and fins do not matter")
{
    const LabelSurface boxes = two_boxes();
    const auto face_between = [&](Index front, Index back) {
        for (Index f = 0;; ++f)
            if (boxes.front[usize(f)] == front && boxes.back[usize(f)] == back)
                return f;
    };
    check_near(volumes_of_cells(without_faces(boxes.mesh, std::array{face_between(0, 2)})), {60.0});
    check_near(volumes_of_cells(without_faces(boxes.mesh, std::array{face_between(0, 1)})), {24.0});
    check_near(volumes_of_cells(without_faces(boxes.mesh, std::array{face_between(1, 2)})), {84.0});
    check_near(volumes_of_cells(without_faces(boxes.mesh, std::array{face_between(0, 1), face_between(0, 2)})), {});
    check_near(volumes_of_cells(test::plates(std::array{0.1, 1.5, 3.0}, 4, 5)), {});
    // A fin outside, and one inside.
    PolygonMesh fins = boxes.mesh;
    Index f = 0;
    while (fins.vertices(fins.face(f)[0], 0) != 1.0 || fins.vertices(fins.face(f)[0], 2) != 3.0)
        ++f;
    const Index v = fins.n_vertices();
    fins.vertices.conservativeResize(v + 2, 3);
    fins.vertices.row(v) = fins.vertices.row(fins.face(f)[0]) + Point(-1.0, 0.0, 0.0);
    fins.vertices.row(v + 1) = fins.vertices.row(fins.face(f)[0]) + Point(1.0, 0.1, 0.2);
    const std::array ends{fins.face(f)[0], fins.face(f)[1]};
    fins.add_face(std::array{ends[0], ends[1], v});
    fins.add_face(std::array{v + 1, ends[0], ends[1]});
    for (std::uint32_t seed = 1; seed <= 5; ++seed)
        check_near(volumes_of_cells(shuffled_mesh(fins, seed)), {60.0, 24.0});
}

TEST_CASE("the cells of a foam are those of its labels, also where four faces share an edge, and when it is deformed")
{
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        LabelSurface quads =
            faces_between(16, [labels = foam_of(9, seed)](const Point& p) { return labels(p / 16.0); });
        for (Index v = 0; v < quads.mesh.n_vertices(); ++v) {
            const Point p = quads.mesh.vertices.row(v);
            quads.mesh.vertices.row(v) += 0.4 * Point(std::sin(p[1]), std::sin(0.8 * p[2]), std::cos(p[0]));
        }
        for (const LabelSurface& surface : {quads, cut_into_triangles(quads)}) {
            const PolygonMesh& mesh = surface.mesh;
            const EnclosedCells cells = find_cells(mesh, mesh.vertices);
            const std::vector<double> volumes = volumes_of(cells, mesh, mesh.vertices);
            CHECK(std::ranges::is_sorted(volumes, std::greater<>()));
            // Labels may have several pieces: corners of voxels do not connect.
            CHECK(cells.count() < 15);
            std::map<Index, double> of_label;
            for (Index c = 0; c < cells.count(); ++c) {
                const auto label = [&](Index side) {
                    return (side % 2 == 0 ? surface.front : surface.back)[usize(side / 2)];
                };
                of_label[label(cells.sides[c][0])] += volumes[usize(c)];
                CHECK(
                    std::ranges::all_of(cells.sides[c], [&](Index s) { return label(s) == label(cells.sides[c][0]); }));
            }
            const std::map<Index, double> expected = volumes_of_labels(surface);
            REQUIRE(of_label.size() == expected.size());
            for (const auto& [label, volume] : expected)
                CHECK(of_label[label] == test::relative(volume, 1e-9));
            check_near(volumes_of_cells(shuffled_mesh(mesh, seed)), volumes);
        }
    }
}

TEST_CASE("cells keep their places in the list when vertices move, and may turn inside out")
{
    const PolygonMesh mesh = two_boxes().mesh;
    const EnclosedCells cells = find_cells(mesh, mesh.vertices);
    Points mirrored = mesh.vertices;
    mirrored.col(0) *= -1.0;
    check_near(volumes_of(cells, mesh, mirrored), {-60.0, -24.0});
    Points wall_moved = mesh.vertices;
    for (Index v = 0; v < wall_moved.rows(); ++v)
        if (wall_moved(v, 2) >= 4.0 && wall_moved(v, 2) < 8.0)
            wall_moved(v, 2) -= 3.5;
    check_near(volumes_of(cells, mesh, wall_moved), {12.0 * 1.5, 12.0 * 5.5});
}

TEST_CASE("closed surfaces without junctions are cells, repeated faces and surfaces of one side are none")
{
    const PolygonMesh ball = make_noisy_sphere(500, {.amplitude = 0.0, .noise = 0.0});
    const std::vector<double> volumes = volumes_of_cells(ball);
    REQUIRE(volumes.size() == 1);
    CHECK(volumes[0] == test::relative(4.0 / 3.0 * std::numbers::pi, 0.05));
    PolygonMesh doubled = two_boxes().mesh;
    const Index n = doubled.n_faces();
    for (Index f = 0; f < n; f += 3) {
        std::vector<Index> corners(doubled.face(f).begin(), doubled.face(f).end());
        std::rotate(corners.begin(), corners.begin() + f % 4, corners.end());
        if (f % 2 == 0)
            std::reverse(corners.begin(), corners.end());
        doubled.add_face(corners);
    }
    for (Index v = 0; v < doubled.n_vertices(); ++v) {
        const Point p = doubled.vertices.row(v);
        doubled.vertices.row(v) += 0.3 * Point(std::sin(p[1]), std::sin(0.8 * p[2]), std::cos(p[0]));
    }
    check_near(volumes_of_cells(doubled), volumes_of_cells(without_faces(doubled, [&] {
                   std::vector<Index> repeated;
                   for (Index f = n; f < doubled.n_faces(); ++f)
                       repeated.push_back(f);
                   return repeated;
               }())));
    // The Klein bottle of squares, folded onto a plane.
    PolygonMesh klein;
    klein.vertices = Points::Random(25, 3);
    const auto vertex = [](Index i, Index j) { return i < 5 ? 5 * i + j % 5 : (10 - j) % 5; };
    for (Index i = 0; i < 5; ++i)
        for (Index j = 0; j < 5; ++j)
            klein.add_face(std::array{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    check_near(volumes_of_cells(klein), {});
    check_near(volumes_of_cells(PolygonMesh{}), {});
}

namespace {

/// A mesh of its own vertices beside others.
void add_mesh(PolygonMesh& mesh, const PolygonMesh& other, const Point& shift)
{
    const Index n = mesh.n_vertices();
    mesh.vertices.conservativeResize(n + other.n_vertices(), 3);
    mesh.vertices.bottomRows(other.n_vertices()) = other.vertices.rowwise() + shift;
    for (Index f = 0; f < other.n_faces(); ++f) {
        std::vector<Index> corners;
        for (const Index v : other.face(f))
            corners.push_back(n + v);
        mesh.add_face(corners);
    }
}

/// The surface of a box of cubes.
PolygonMesh box_of(const Point& size)
{
    PolygonMesh box = faces_between(8, [&](const Point& p) {
                          const Point within = p - Point::Ones();
                          return (within.array() > 0.0).all() && (within.array() < size.array()).all() ? 1 : 0;
                      }).mesh;
    box.vertices.rowwise() -= Point::Ones();
    return box;
}

/// The two boxes with their common wall twice: cut into triangles along one diagonal of each square, and along the
/// other or, every third square, once more along the same or not cut at all.
PolygonMesh boxes_with_two_walls()
{
    const LabelSurface boxes = two_boxes();
    PolygonMesh mesh;
    mesh.vertices = boxes.mesh.vertices;
    for (Index f = 0; f < boxes.mesh.n_faces(); ++f) {
        const auto q = boxes.mesh.face(f);
        mesh.add_face(std::array{q[0], q[1], q[2]});
        mesh.add_face(std::array{q[0], q[2], q[3]});
        if (boxes.front[usize(f)] == 0 || boxes.back[usize(f)] == 0)
            continue;
        if (f % 6 == 0) {
            mesh.add_face(q);
        } else {
            const std::size_t first = f % 3 == 0 ? 0 : 1;
            mesh.add_face(std::array{q[first], q[first + 1], q[first + 2]});
            mesh.add_face(std::array{q[first], q[first + 2], q[(first + 3) % 4]});
        }
    }
    return mesh;
}

/// So many cells around a common edge.
PolygonMesh book(Index n)
{
    PolygonMesh mesh;
    mesh.vertices.resize(n + 2, 3);
    mesh.vertices.row(0) = Point(0.0, 0.0, 0.0);
    mesh.vertices.row(1) = Point(0.0, 0.0, 1.0);
    for (Index i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        mesh.vertices.row(i + 2) = Point(std::cos(angle), std::sin(angle), 0.3);
    }
    for (Index i = 0; i < n; ++i) {
        const Index page = i + 2;
        const Index next = (i + 1) % n + 2;
        mesh.add_face(std::array<Index, 3>{0, 1, page});
        mesh.add_face(std::array<Index, 3>{1, page, next});
        mesh.add_face(std::array<Index, 3>{next, page, 0});
    }
    return mesh;
}

}  // namespace

TEST_CASE("what lies within a cell without touching it is a cell of its own, and surfaces are counted")
{
    PolygonMesh mesh = two_boxes().mesh;
    CHECK(find_cells(mesh, mesh.vertices).n_surfaces == 1);
    add_mesh(mesh, box_of({1, 1, 1}), Point(2.2, 2.2, 2.7));
    // Beside all.
    add_mesh(mesh, box_of({2, 1, 1}), Point(20, 3, 3));
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        const PolygonMesh shuffled = shuffled_mesh(mesh, seed);
        check_near(volumes_of_cells(shuffled), {60.0, 24.0, 2.0, 1.0});
        CHECK(find_cells(shuffled, shuffled.vertices).n_surfaces == 3);
    }
}

TEST_CASE("sheets on each other that cut the same squares otherwise do not merge the cells on their two sides")
{
    const PolygonMesh mesh = boxes_with_two_walls();
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        PolygonMesh shuffled = shuffled_mesh(mesh, seed);
        for (const double turn : {0.0, 0.7}) {
            const Eigen::Matrix3d rotation(Eigen::AngleAxisd(turn, Eigen::Vector3d(1, 2, 3).normalized()));
            shuffled.vertices *= rotation;
            const EnclosedCells cells = find_cells(shuffled, shuffled.vertices);
            check_near(volumes_of(cells, shuffled, shuffled.vertices), {60.0, 24.0});
            CHECK(cells.n_overlaps == 0);
        }
    }
}

TEST_CASE("sheets on each other with other faces are counted where cells may be merged")
{
    // A wall of one face and of four around a point of its own.
    PolygonMesh mesh = box_of({2, 1, 1});
    const auto vertex_at = [&](double x, double y, double z) {
        Index v = 0;
        while (Point(mesh.vertices.row(v)) != Point(x, y, z))
            ++v;
        return v;
    };
    const std::array wall{vertex_at(1, 0, 0), vertex_at(1, 1, 0), vertex_at(1, 1, 1), vertex_at(1, 0, 1)};
    const Index centre = mesh.n_vertices();
    mesh.vertices.conservativeResize(centre + 1, 3);
    mesh.vertices.row(centre) = Point(1, 0.4, 0.3);
    mesh.add_face(wall);
    for (std::size_t k = 0; k < 4; ++k)
        mesh.add_face(std::array{wall[k], wall[(k + 1) % 4], centre});
    int n_merged = 0;
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        const PolygonMesh shuffled = shuffled_mesh(mesh, seed);
        const EnclosedCells cells = find_cells(shuffled, shuffled.vertices);
        if (cells.n_overlaps == 0)
            check_near(volumes_of(cells, shuffled, shuffled.vertices), {1.0, 1.0});
        n_merged += cells.n_overlaps > 0 ? 1 : 0;
    }
    CHECK(n_merged > 0);
}

TEST_CASE("a hundred thousand cells around one edge are found in seconds")
{
    constexpr Index n = 100000;
    const PolygonMesh mesh = book(n);
    const std::vector<double> volumes = volumes_of_cells(mesh);
    REQUIRE(volumes.size() == n);
    CHECK(volumes.front() == test::relative(std::sin(2.0 * std::numbers::pi / n) / 6.0, 1e-6));
    CHECK(volumes.back() == test::relative(volumes.front(), 1e-6));
}

TEST_CASE("cells and their volumes are the same bits on any loop")
{
    const PolygonMesh mesh = make_label_surface(foam(), 20000, 0.1).mesh;
    const EnclosedCells serial = find_cells(mesh, mesh.vertices);
    const EnclosedCells parallel = find_cells(mesh, mesh.vertices, run_in_parallel);
    REQUIRE(serial.count() >= 24);
    CHECK(serial.sides.values == parallel.sides.values);
    CHECK(serial.sides.offsets == parallel.sides.offsets);
    CHECK(volumes_of(serial, mesh, mesh.vertices) == volumes_of(parallel, mesh, mesh.vertices, run_in_parallel));
}
