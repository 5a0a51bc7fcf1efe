#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/flipped_faces.h"
#include "partition/metrics/self_intersections.h"
#include "partition/metrics/volume.h"
#include "partition/vector_area.h"
#include "solvers/rounding/joined_copies.h"
#include "solvers/rounding/rounded_surface.h"
#include "tests/support/digitised.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::Materials;

namespace {

/// Materials, and the direction of the true wall between two of them at a point.
struct LabelVolume {
    std::string name;
    Materials material;
    std::function<Point(Index one, Index other, const Point& point)> direction;
};

constexpr Index n_voxels = 20;
constexpr double radius_of_bodies = 8.3;

/// A ball that planes through its middle cut into pieces. @param as_board neighbouring pieces alternate between two
/// materials, as the fields of a chess board: lines of four sheets.
LabelVolume cut_ball(std::string name, const std::vector<Point>& planes, bool as_board = false)
{
    const auto piece = [=](const Point& point) {
        Index sides = 0;
        for (std::size_t i = 0; i < planes.size(); ++i) {
            const Index side = point.dot(planes[i]) > 0.0 ? 1 : 0;
            sides = as_board ? (sides + side) % 2 : 2 * sides + side;
        }
        return point.norm() < radius_of_bodies ? 1 + sides : 0;
    };
    const auto direction = [=](Index one, Index other, const Point& point) {
        if (one == 0 || other == 0)
            return Point(point.normalized());
        return *std::ranges::min_element(planes, {}, [&](const Point& plane) { return std::abs(point.dot(plane)); });
    };
    return {std::move(name), piece, direction};
}

/// A ball whose points belong to the nearest of some seeds.
LabelVolume cells()
{
    const std::vector<Point> seeds{{5.0, 1.0, 0.0}, {-3.0, 4.5, 2.0},  {-4.0, -4.0, 1.0},
                                   {1.0, 0.0, 6.0}, {2.0, -4.0, -5.0}, {0.5, 3.0, -4.5}};
    const auto nearest = [=](const Point& point) {
        const auto found =
            std::ranges::min_element(seeds, {}, [&](const Point& seed) { return (point - seed).norm(); });
        return point.norm() < radius_of_bodies ? 1 + static_cast<Index>(found - seeds.begin()) : 0;
    };
    const auto direction = [=](Index one, Index other, const Point& point) {
        return one == 0 || other == 0 ? Point(point.normalized())
                                      : Point((seeds[usize(one) - 1] - seeds[usize(other) - 1]).normalized());
    };
    return {"cells", nearest, direction};
}

/// Directions at right angles to each other, oblique to all axes.
const std::vector<Point>& oblique()
{
    static const std::vector<Point> directions{Point(2.0, 1.0, 0.5).normalized(), Point(-1.0, 1.5, 1.0).normalized(),
                                               Point(0.25, -2.5, 4.0).normalized()};
    return directions;
}

std::vector<LabelVolume> label_volumes()
{
    const std::vector<Point> axes{Point::UnitX(), Point::UnitY(), Point::UnitZ()};
    const std::vector<Point> two{oblique()[0], oblique()[1]};
    return {cut_ball("halves", {oblique()[0]}), cut_ball("quarters", two),
            cut_ball("chess board", two, true), cut_ball("chess board along the axes", axes, true),
            cut_ball("eighths", oblique()),     cells()};
}

PolygonMesh in_triangles(const PolygonMesh& quads)
{
    PolygonMesh mesh;
    mesh.vertices = quads.vertices;
    for (Index f = 0; f < quads.n_faces(); ++f) {
        const auto c = quads.face(f);
        mesh.add_face(std::array{c[0], c[1], c[2]});
        mesh.add_face(std::array{c[0], c[2], c[3]});
    }
    return mesh;
}

/// The smooth surface where lines of several sheets move; the test fails without one.
Points smooth_materials(const PolygonMesh& mesh, const std::vector<Index>& fixed = {})
{
    Topology topology = make_topology(mesh, run_in_parallel);
    free_junctions(mesh, topology, run_in_parallel);
    free_boundary(topology);
    fix_vertices(topology, fixed);
    const auto result = smooth_rounded(mesh, topology, mesh.vertices, {}, run_in_parallel);
    REQUIRE(result);
    return result->positions;
}

Point middle_of(const PolygonMesh& mesh, const Points& positions, Index f)
{
    Point total = Point::Zero();
    for (const Index v : mesh.face(f))
        total += positions.row(v);
    return total / static_cast<double>(mesh.face(f).size());
}

double degrees(double cosine)
{
    return 180.0 / std::numbers::pi * std::acos(std::clamp(cosine, -1.0, 1.0));
}

/// The mean angle to the true walls, of each wall of at least 40 faces.
std::map<std::pair<Index, Index>, double> angles_of_walls(const LabelVolume& volume, const PolygonMesh& mesh,
                                                          const Points& positions)
{
    std::map<std::pair<Index, Index>, std::vector<double>> of_walls;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        // In the middle of the square of a triangle, too.
        const Points corners = mesh.vertices(std::vector<Index>(mesh.face(f).begin(), mesh.face(f).end()), Eigen::all);
        const Point middle = 0.5 * (corners.colwise().minCoeff() + corners.colwise().maxCoeff());
        const Point to_side = 0.5 * vector_area(mesh.face(f), mesh.vertices).normalized();
        const auto [low, high] = std::minmax({volume.material(middle - to_side), volume.material(middle + to_side)});
        const Point wall = volume.direction(low, high, middle_of(mesh, positions, f));
        of_walls[{low, high}].push_back(
            degrees(std::abs(wall.dot(vector_area(mesh.face(f), positions).stableNormalized()))));
    }
    std::map<std::pair<Index, Index>, double> means;
    for (const auto& [wall, angles] : of_walls)
        if (angles.size() >= 40)
            means[wall] = std::accumulate(angles.begin(), angles.end(), 0.0) / static_cast<double>(angles.size());
    return means;
}

/// The mean angle by which lines of three and more sheets turn at their vertices.
double turn_of_lines(const PolygonMesh& mesh, const Points& positions)
{
    std::map<std::pair<Index, Index>, int> n_faces;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto c = mesh.face(f);
        for (std::size_t i = 0; i < c.size(); ++i)
            ++n_faces[std::minmax(c[i], c[(i + 1) % c.size()])];
    }
    std::map<Index, std::vector<Index>> along;
    for (const auto& [edge, n] : n_faces)
        if (n > 2) {
            along[edge.first].push_back(edge.second);
            along[edge.second].push_back(edge.first);
        }
    double total = 0.0;
    int n_turns = 0;
    for (const auto& [v, ends] : along)
        if (ends.size() == 2) {
            const Point here = positions.row(v);
            const Point to = (here - positions.row(ends[0])).stableNormalized();
            total += degrees(to.dot((positions.row(ends[1]) - here).stableNormalized()));
            ++n_turns;
        }
    return total / n_turns;
}

/// Each segment with a closed surface of its own, so that walls between two of them are there twice.
PolygonMesh closed_segments(const Materials& material, Index n, const std::vector<Index>& labels = {1, 2})
{
    std::vector<PolygonMesh> segments;
    for (const Index label : labels)
        segments.push_back(test::voxel_faces([&](const Point& point) { return material(point) == label; }, n));
    return test::together(segments);
}

/// A ball, and the same ball moved by a vector of whole numbers, without what the first one has.
Materials two_balls(const Point& moved, double ball_radius)
{
    return [=](const Point& point) {
        const Point from_first = point + 0.5 * moved;
        return from_first.norm() < ball_radius ? 1 : (from_first - moved).norm() < ball_radius ? 2 : 0;
    };
}

using Place = std::tuple<double, double, double>;

/// The vertices at each place.
std::map<Place, std::vector<Index>> by_place(const Points& points)
{
    std::map<Place, std::vector<Index>> found;
    for (Index v = 0; v < points.rows(); ++v)
        found[{points(v, 0), points(v, 1), points(v, 2)}].push_back(v);
    return found;
}

/// The two copies of each end of the edges that lie on edges of another component.
std::set<std::pair<Index, Index>> ends_of_shared_edges(const PolygonMesh& mesh)
{
    const auto places = by_place(mesh.vertices);
    const auto copies_of = [&](Index v) {
        const auto& copies = places.at({mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)});
        return std::pair(copies.front(), copies.back());
    };
    std::set<std::pair<Index, Index>> edges;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (std::size_t i = 0; i < mesh.face(f).size(); ++i) {
            const Index v = mesh.face(f)[i];
            const Index w = mesh.face(f)[(i + 1) % mesh.face(f).size()];
            edges.insert({v, w});
            edges.insert({w, v});
        }
    std::set<std::pair<Index, Index>> found;
    for (const auto& [v, w] : edges) {
        const auto of_v = copies_of(v);
        const auto of_w = copies_of(w);
        if (of_v.first != of_v.second && edges.contains({of_v.first, of_w.first}) &&
            edges.contains({of_v.second, of_w.second})) {
            found.insert(of_v);
            found.insert(of_w);
        }
    }
    return found;
}

}  // namespace

TEST_CASE("walls between materials become smooth with their lines, within half a voxel, and nothing crosses")
{
    for (const LabelVolume& volume : label_volumes())
        for (const bool has_triangles : {false, true}) {
            CAPTURE(volume.name);
            CAPTURE(has_triangles);
            const PolygonMesh quads = test::wall_faces(volume.material, n_voxels);
            const PolygonMesh mesh = has_triangles ? in_triangles(quads) : quads;
            const Points smooth = smooth_materials(mesh);
            CHECK((smooth - mesh.vertices).cwiseAbs().maxCoeff() <= 0.5);
            CHECK(self_intersections(mesh, smooth, run_in_parallel).empty());
            CHECK(flipped_faces(mesh, mesh.vertices, smooth).empty());
            for (const auto& wall : angles_of_walls(volume, mesh, smooth)) {
                CAPTURE(wall.first.first);
                CAPTURE(wall.first.second);
                CHECK(wall.second < 12.0);
            }
            // Stairs turn by 40 to 80 degrees. Oblique lines of a chess board are torn into pieces by voxels.
            CHECK(turn_of_lines(mesh, smooth) < (volume.name == "chess board" ? 33.0 : 18.0));
        }
}

TEST_CASE("segments with closed surfaces of their own keep together where they touch, and keep their volumes")
{
    struct Contact {
        const char* name;
        Point moved;
        double ball_radius;
        bool has_edges;
    };
    for (const Contact& contact :
         {Contact{"a large wall", Point(6.0, 4.0, 2.0), 6.3, true},
          Contact{"a few faces", Point(9.0, 7.0, 6.0), 6.3, true}, Contact{"edges", Point(10.0, 8.0, 2.0), 6.3, true},
          Contact{"single vertices", Point(8.0, 8.0, 8.0), 6.3, false}})
        for (const bool has_triangles : {false, true}) {
            CAPTURE(std::string(contact.name));
            CAPTURE(has_triangles);
            const PolygonMesh quads = closed_segments(two_balls(contact.moved, contact.ball_radius), 26);
            const PolygonMesh mesh = has_triangles ? in_triangles(quads) : quads;
            const Points smooth = smooth_materials(mesh);
            CHECK((smooth - mesh.vertices).cwiseAbs().maxCoeff() <= 0.5);
            Index n_joined = 0;
            for (const auto& [one, other] : ends_of_shared_edges(mesh)) {
                ++n_joined;
                CHECK(smooth.row(one) == smooth.row(other));
            }
            CHECK((n_joined > 0) == contact.has_edges);
            // The wall lies on its copy before and afterwards.
            const auto before = self_intersections(mesh, mesh.vertices, run_in_parallel);
            for (const FacePair& pair : self_intersections(mesh, smooth, run_in_parallel))
                CHECK(std::ranges::binary_search(before, pair));
            const Topology topology = make_topology(mesh);
            const Components components = face_components(mesh, topology);
            for (Index c = 0; c < components.count(); ++c) {
                const auto volume = [&](const Points& positions) {
                    double total = 0.0;
                    for (const Index f : components.nodes[c])
                        total += cone_volume(mesh.face(f), positions, Point::Zero());
                    return total;
                };
                CHECK(std::abs(volume(smooth) / volume(mesh.vertices) - 1.0) < 0.01);
            }
        }
}

TEST_CASE("copies of a vertex stay where one of them is held")
{
    const PolygonMesh mesh = closed_segments(two_balls(Point(6.0, 4.0, 2.0), 6.3), 26);
    const auto places = by_place(mesh.vertices);
    const auto shared = std::ranges::find_if(places, [](const auto& place) { return place.second.size() == 2; });
    REQUIRE(shared != places.end());
    for (const Index held : shared->second) {
        const Points smooth = smooth_materials(mesh, {held});
        for (const Index v : shared->second)
            CHECK(smooth.row(v) == mesh.vertices.row(v));
    }
}

TEST_CASE("it does not matter which of two segments that touch comes first")
{
    const Materials balls = two_balls(Point(6.0, 4.0, 2.0), 6.3);
    const PolygonMesh mesh = closed_segments(balls, 26);
    const PolygonMesh other = closed_segments(balls, 26, {2, 1});
    const Points smooth = smooth_materials(mesh);
    const Points of_other = smooth_materials(other);
    const Index n = test::voxel_faces([&](const Point& point) { return balls(point) == 1; }, 26).n_vertices();
    const Index n_other = other.n_vertices() - n;
    REQUIRE(other.vertices.bottomRows(n) == mesh.vertices.topRows(n));
    CHECK((of_other.bottomRows(n) - smooth.topRows(n)).cwiseAbs().maxCoeff() < 1e-3);
    CHECK((of_other.topRows(n_other) - smooth.bottomRows(n_other)).cwiseAbs().maxCoeff() < 1e-3);
}

TEST_CASE("vertices that rounding brings to one place within a component are not joined")
{
    const PolygonMesh coarse = test::rounded(test::triangle_torus(20, 10), Point::Constant(1.0));
    const auto joined = [](const PolygonMesh& mesh) {
        const Topology topology = make_topology(mesh);
        return join_copies(mesh, topology, face_components(mesh, topology), mesh.vertices);
    };
    CHECK_FALSE(joined(coarse));
    CHECK_FALSE(joined(test::side_by_side({coarse, coarse})));
    const PolygonMesh twice = test::together({coarse, coarse});
    const auto copies = joined(twice);
    REQUIRE(copies);
    const Index n = coarse.n_vertices();
    const auto places = by_place(coarse.vertices);
    Index n_joined = 0;
    for (const auto& [place, vertices] : places)
        for (const Index v : vertices) {
            const bool is_alone = vertices.size() == 1;
            CHECK(copies->original_of[v] == v);
            if (!is_alone)
                CHECK(copies->original_of[n + v] == n + v);
            n_joined += copies->original_of[n + v] == v ? 1 : 0;
        }
    CHECK(n_joined > 0);
    CHECK(n_joined < n);
    CHECK(copies->mesh.n_faces() < twice.n_faces());
    CHECK(copies->all_faces.n_faces() == twice.n_faces());
}

TEST_CASE("components that touch in points, without a common edge, are not joined")
{
    // A quad, and triangles with three of its corners, two of them at the ends of its diagonal.
    PolygonMesh mesh;
    mesh.vertices.resize(9, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, /**/ 0, 0, 0, 1, 1, 0, 0.5, 0.5, -1, 1, 0, 0, 2, 0.5, -1;
    mesh.add_face(std::array<Index, 4>{0, 1, 2, 3});
    mesh.add_face(std::array<Index, 3>{4, 5, 6});
    mesh.add_face(std::array<Index, 3>{5, 8, 6});
    mesh.add_face(std::array<Index, 3>{6, 8, 7});
    const auto is_joined = [&] {
        const Topology topology = make_topology(mesh);
        return join_copies(mesh, topology, face_components(mesh, topology), mesh.vertices).has_value();
    };
    CHECK_FALSE(is_joined());
    mesh.add_face(std::array<Index, 3>{5, 7, 8});
    CHECK(is_joined());
}

TEST_CASE("walls between materials have the same bits however loops are run")
{
    const PolygonMesh mesh = in_triangles(test::wall_faces(cells().material, n_voxels));
    Topology topology = make_topology(mesh);
    free_junctions(mesh, topology);
    free_boundary(topology);
    const auto serial = smooth_rounded(mesh, topology, mesh.vertices, {});
    REQUIRE(serial);
    CHECK(serial->positions == smooth_materials(mesh));
}
