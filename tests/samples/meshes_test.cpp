#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/topology.h"
#include "partition/vector_area.h"
#include "samples/meshes/meshes.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

constexpr std::array<Index, 5> sizes{100, 137, 1000, 2500, 9999};

Index euler_characteristic(const PolygonMesh& mesh, const Topology& topology)
{
    const auto boundary = std::count(topology.twin.begin(), topology.twin.end(), -1);
    const auto edges = (mesh.n_corners() + static_cast<Index>(boundary)) / 2;
    return mesh.n_vertices() - edges + mesh.n_faces();
}

bool is_part(std::string_view kind)
{
    return std::ranges::any_of(std::array{"box", "gear", "stepped-cylinder", "chamfered-plate"},
                               [&](const char* part) { return kind.starts_with(part); });
}

Index expected_characteristic(std::string_view kind)
{
    if (kind == "noisy-sphere" || kind.starts_with("box"))
        return 2;
    return kind.ends_with("cylinder") || is_part(kind) ? 0 : 1;
}

bool oriented_alike(const PolygonMesh& mesh, const Topology& topology)
{
    for (Index h = 0; h < mesh.n_corners(); ++h)
        if (const Index twin = topology.twin[h]; twin >= 0 && mesh.face_vertices[h] == mesh.face_vertices[twin])
            return false;
    return true;
}

std::map<std::size_t, Index> faces_by_sides(const PolygonMesh& mesh)
{
    std::map<std::size_t, Index> count;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        ++count[mesh.face(f).size()];
    return count;
}

/// The number of sides of all faces; 0 where they differ.
std::size_t count_of_sides(const PolygonMesh& mesh)
{
    const auto count = faces_by_sides(mesh);
    return count.size() == 1 ? count.begin()->first : 0;
}

double volume_of(const PolygonMesh& mesh)
{
    double volume = 0.0;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        volume += Point(mesh.vertices.row(mesh.face(f)[0])).dot(vector_area(mesh.face(f), mesh.vertices)) / 3.0;
    return volume;
}

using Vector2 = Eigen::RowVector2d;

double cross(const Vector2& a, const Vector2& b)
{
    return a.x() * b.y() - a.y() * b.x();
}

bool segments_cross(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d)
{
    return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

/// Whether no two edges of a face cross, seen along z.
bool simple_from_above(const PolygonMesh& mesh, Index f)
{
    const auto corners = mesh.face(f);
    const auto point = [&](std::size_t k) -> Vector2 {
        return mesh.vertices.row(corners[k % corners.size()]).head<2>();
    };
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (segments_cross(point(i), point(i + 1), point(j), point(j + 1)))
                return false;
    return true;
}

/// Area of a face seen along z, positive if it runs counter-clockwise.
double area_from_above(const PolygonMesh& mesh, Index f)
{
    const auto corners = mesh.face(f);
    double doubled = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k)
        doubled += cross(mesh.vertices.row(corners[k]).head<2>(),
                         mesh.vertices.row(corners[(k + 1) % corners.size()]).head<2>());
    return doubled / 2.0;
}

}  // namespace

TEST_CASE("every kind of mesh is valid, manifold, oriented and of about the size asked for")
{
    for (const MeshKind& kind : mesh_kinds())
        for (const Index wanted : sizes) {
            if (kind.has_cells)
                continue;
            CAPTURE(std::string(kind.name));
            CAPTURE(wanted);
            if (is_part(kind.name) && wanted < fewest_vertices_of_parts) {
                CHECK_THROWS_AS(make_mesh(kind.name, wanted), OptionError);
                continue;
            }
            const PolygonMesh mesh = make_mesh(kind.name, wanted);
            CHECK_NOTHROW(require_valid(mesh));
            CHECK(std::abs(mesh.n_vertices() - wanted) <= 0.1 * wanted);
            const Topology topology = make_topology(mesh);
            CHECK(std::count(topology.kind.begin(), topology.kind.end(), VertexKind::NonManifold) == 0);
            CHECK(std::count(topology.kind.begin(), topology.kind.end(), VertexKind::Isolated) == 0);
            CHECK(euler_characteristic(mesh, topology) == expected_characteristic(kind.name));
            CHECK(oriented_alike(mesh, topology));
        }
}

TEST_CASE("the same arguments give the same mesh, another seed another one")
{
    for (const MeshKind& kind : mesh_kinds()) {
        CAPTURE(std::string(kind.name));
        const MeshVariation noisy{.seed = 7, .amplitude = {}, .noise = 0.2};
        const Index wanted = kind.has_cells ? fewest_vertices_of_labels : 500;
        const PolygonMesh once = make_mesh(kind.name, wanted, noisy);
        const PolygonMesh again = make_mesh(kind.name, wanted, noisy);
        CHECK(once.vertices == again.vertices);
        CHECK(once.face_vertices == again.face_vertices);
        CHECK(once.face_offsets == again.face_offsets);
        const PolygonMesh other = make_mesh(kind.name, wanted, {.seed = 8, .amplitude = {}, .noise = 0.2});
        CHECK(once.vertices != other.vertices);
    }
}

TEST_CASE("height fields cover the unit square with simple faces of positive area")
{
    for (const char* kind : {"triangles", "quads", "hexagons", "mixed"}) {
        CAPTURE(kind);
        const PolygonMesh mesh = make_mesh(kind, 2000);
        double area = 0.0;
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            CHECK(simple_from_above(mesh, f));
            CHECK(area_from_above(mesh, f) > 0.0);
            area += area_from_above(mesh, f);
        }
        CHECK(area == test::relative(1.0, 1e-5));
        CHECK(mesh.vertices.col(2).maxCoeff() <= 0.1);
        CHECK(mesh.vertices.col(2).minCoeff() >= -0.1);
    }
}

TEST_CASE("the mixed mesh stays simple at its largest jitter, and has faces of three to nine sides")
{
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        MixedPolygonsShape shape{.surface = {.seed = seed}, .jitter = 0.24, .changed = 1.0};
        const PolygonMesh mesh = make_mixed_polygons(3000, shape);
        for (Index f = 0; f < mesh.n_faces(); ++f)
            CHECK(simple_from_above(mesh, f));
        const auto count = faces_by_sides(mesh);
        for (std::size_t sides = 3; sides <= 9; ++sides)
            CHECK(count.count(sides) == 1);
        const Topology topology = make_topology(mesh);
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if (topology.kind[v] == VertexKind::Interior)
                CHECK(topology.corners_at(v).size() >= 3);
    }
}

TEST_CASE("the honeycomb is prevalently hexagonal")
{
    const PolygonMesh mesh = make_hexagons(5000);
    const auto count = faces_by_sides(mesh);
    CHECK(count.at(6) > 0.95 * mesh.n_faces());
    CHECK(count.at(6) + count.at(4) == mesh.n_faces());
}

TEST_CASE("a ring of pentagons joins the two levels of a cylinder")
{
    const PolygonMesh mesh = make_two_level_cylinder(7280);
    auto count = faces_by_sides(mesh);
    CHECK(count[5] + count[4] == mesh.n_faces());
    const Topology topology = make_topology(mesh);
    // The boundary is one coarse and one fine ring.
    CHECK(std::count(topology.twin.begin(), topology.twin.end(), -1) == 3 * count[5]);
    CHECK(mesh.vertices.col(2).minCoeff() == test::relative(-mesh.vertices.col(2).maxCoeff(), 1e-5));
}

TEST_CASE("flat options give flat meshes and round tubes")
{
    CHECK(make_hexagons(500, {.amplitude = 0.0}).vertices.col(2).isZero(0.0));
    const PolygonMesh tube = make_cylinder(500, {.radius = 2.0, .amplitude = 0.0});
    CHECK(((tube.vertices.leftCols<2>().rowwise().norm().array() - 2.0).abs() < 1e-14).all());
    const PolygonMesh ball = make_noisy_sphere(500, {.radius = 3.0, .amplitude = 0.0, .noise = 0.0});
    CHECK(((ball.vertices.rowwise().norm().array() - 3.0).abs() < 1e-14).all());
}

TEST_CASE("a height field has as many waves along x and y as asked for")
{
    for (const int waves : {1, 3}) {
        const PolygonMesh mesh = make_triangles(2500, {.amplitude = 0.3, .waves = waves, .noise = 0.0});
        const auto wave = [&](double x) { return std::cos(2.0 * std::numbers::pi * waves * x); };
        for (const auto& p : mesh.vertices.rowwise())
            CHECK(std::abs(p.z() - 0.3 * wave(p.x()) * wave(p.y())) <= 1e-12);
    }
}

TEST_CASE("extreme tubes keep their size")
{
    for (const double height : {0.01, 1000.0})
        for (const Index wanted : {100, 5000}) {
            CAPTURE(height);
            CHECK(std::abs(make_cylinder(wanted, {.height = height}).n_vertices() - wanted) <= 0.1 * wanted);
            CHECK(std::abs(make_two_level_cylinder(wanted, {.height = height}).n_vertices() - wanted) <= 0.1 * wanted);
        }
}

TEST_CASE("machine parts are solid, flat and round where they should be, and enclose the volume that they should")
{
    const double pi = std::numbers::pi;
    const double wedge = std::sin(0.18) + 2.0 * 0.8 * std::sin(0.134) + 0.64 * std::sin(0.628318530717959 - 0.448);
    const double frustum = pi * 0.15 * (0.65 * 0.65 + 0.65 * 0.5 + 0.25) / 3.0;
    const double pyramid = 0.15 * (2.2 * 1.8 + 1.9 * 1.5 + 4.0 * 2.05 * 1.65) / 6.0;
    const std::map<std::string, double> volumes{
        {"box", 1.6 * 1.2},
        {"gear", 0.5 * (5.0 * wedge - 0.36 * pi)},
        {"stepped-cylinder", pi * (0.6 + 0.6 * 0.5625 - 1.2 * 0.25)},
        {"chamfered-plate", 2.2 * 1.8 * 0.35 + pyramid - 0.35 * 0.25 * pi - frustum}};
    for (const auto& [kind, volume] : volumes)
        for (const std::size_t sides : {3U, 4U}) {
            const std::string name = kind + (sides == 3 ? "" : "-quads");
            CAPTURE(name);
            const PolygonMesh mesh = make_mesh(name, 9999);
            CHECK(count_of_sides(mesh) == sides);
            CHECK(volume_of(mesh) == test::relative(volume, 2e-3));
        }
    CHECK_THROWS_AS(make_mesh("gear", 1000, {.seed = {}, .amplitude = 0.1, .noise = {}}), OptionError);
}

TEST_CASE("sheets between labels meet in lines alone, are of about the size asked for, and lie between their labels")
{
    const std::map<std::string, Index> n_labels{
        {"balls", 3}, {"bubbles", 4}, {"honeycomb", 0}, {"plates", 3}, {"foam", 25}};
    for (const MeshKind& kind : mesh_kinds())
        for (const Index wanted : {1000, 2500, 20000}) {
            if (!kind.has_cells)
                continue;
            CAPTURE(std::string(kind.name));
            CAPTURE(wanted);
            const LabelSurface surface = make_surface(kind.name, wanted);
            const PolygonMesh& mesh = surface.mesh;
            CHECK_NOTHROW(require_valid(mesh));
            // Small ones grow in jumps.
            CHECK(std::abs(mesh.n_vertices() - wanted) <= (wanted < 2000 ? 0.15 : 0.1) * wanted);
            CHECK(count_of_sides(mesh) == (kind.name.ends_with("-quads") ? 4 : 3));
            CHECK(mesh.vertices.minCoeff() >= 0.0);
            CHECK(mesh.vertices.maxCoeff() <= 1.06);
            Topology topology = make_topology(mesh);
            free_junctions(mesh, topology);
            const auto has = [&](VertexKind k) { return std::ranges::count(topology.kind, k) > 0; };
            CHECK(has(VertexKind::Junction));
            // Where a foam has a short edge, two sheets may touch in one corner of voxels.
            CHECK(std::ranges::count(topology.kind, VertexKind::NonManifold) <=
                  (kind.name.starts_with("foam") ? 2 : 0));
            CHECK_FALSE(has(VertexKind::Isolated));
            CHECK(has(VertexKind::Boundary) == (kind.name.starts_with("honeycomb") || kind.name.starts_with("plates")));
            std::set<Index> labels(surface.front.begin(), surface.front.end());
            labels.insert(surface.back.begin(), surface.back.end());
            const Index expected = n_labels.at(std::string(kind.name.substr(0, kind.name.find('-'))));
            CHECK((expected == 0 ? labels.size() > 15 : std::cmp_equal(labels.size(), expected)));
            for (Index h = 0; h < mesh.n_corners(); ++h)
                if (const Index twin = topology.twin[h]; twin >= 0) {
                    const Index f = topology.face_of[h];
                    const Index g = topology.face_of[twin];
                    REQUIRE(surface.front[f] == surface.front[g]);
                    REQUIRE(surface.back[f] == surface.back[g]);
                    REQUIRE(mesh.face_vertices[h] != mesh.face_vertices[twin]);
                }
        }
    CHECK_THROWS_AS(make_mesh("foam", 999), OptionError);
    CHECK_THROWS_AS(make_mesh("balls", 1000, {.seed = {}, .amplitude = 0.1, .noise = {}}), OptionError);
}

TEST_CASE("the normals of faces between labels point to the front")
{
    const auto label = [](const Point& point) { return point[2] < 1.0 ? Index{7} : Index{4}; };
    const LabelSurface surface = faces_between(2, label);
    REQUIRE(surface.mesh.n_faces() == 4);
    for (Index f = 0; f < 4; ++f) {
        CHECK(vector_area(surface.mesh.face(f), surface.mesh.vertices) == Point(0, 0, 1));
        CHECK(surface.front[f] == 4);
        CHECK(surface.back[f] == 7);
    }
}

TEST_CASE("arguments outside their limits are refused")
{
    CHECK_THROWS_AS(make_mesh("dodecahedron", 1000), OptionError);
    CHECK_THROWS_AS(make_mesh("quads", 99), OptionError);
    CHECK_THROWS_AS(make_mesh("noisy-sphere", 1000, {.seed = {}, .amplitude = {}, .noise = -1.0}), OptionError);
    CHECK_THROWS_AS(make_mesh("cylinder", 1000, {.seed = {}, .amplitude = 1.5, .noise = {}}), OptionError);
    CHECK_THROWS_AS(make_quads(1000, {.amplitude = std::nan("")}), OptionError);
    CHECK_THROWS_AS(make_mixed_polygons(1000, {.surface = {}, .jitter = 0.5}), OptionError);
}
