#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/motion/component_limits.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/metrics/volume.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/relative.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Volume and move of the first or second half of the vertices and faces, which are components of their own.
PolygonMesh half(const PolygonMesh& mesh, const Points& positions, bool is_first)
{
    const Index n = mesh.n_vertices() / 2;
    PolygonMesh part;
    part.vertices = is_first ? positions.topRows(n) : positions.bottomRows(n);
    for (Index f = is_first ? 0 : mesh.n_faces() / 2; f < (is_first ? mesh.n_faces() / 2 : mesh.n_faces()); ++f) {
        std::vector<Index> corners;
        for (const Index v : mesh.face(f))
            corners.push_back(is_first ? v : v - n);
        part.add_face(corners);
    }
    return part;
}

double volume(const PolygonMesh& mesh)
{
    return volume_of_cones(mesh, mesh.vertices, Point::Zero(), run_serially);
}

}  // namespace

TEST_CASE("a component that would lose too much is given less, along straight lines, and others are as they would be")
{
    const PolygonMesh large = make_noisy_sphere(4000, {.amplitude = 0.0, .noise = 0.0});
    PolygonMesh small = large;
    small.vertices *= 0.1;
    const PolygonMesh mesh = side_by_side({large, small});
    const Topology topology = make_topology(mesh);
    const double edge = mean_edge_length(mesh, mesh.vertices);
    FlowOptions options;
    options.time_step = 0.1 * edge * edge;
    const Points free = flowed(mesh, options);
    LimitedComponents limited(mesh, topology, {.volume = 0.02});
    Points positions = free;
    limited.apply(positions);
    const Index n = mesh.n_vertices() / 2;
    CHECK(same_bits(positions.topRows(n), free.topRows(n)));
    const double lost = 1.0 - volume(half(mesh, positions, false)) / volume(half(mesh, mesh.vertices, false));
    CHECK(1.0 - volume(half(mesh, free, false)) / volume(half(mesh, mesh.vertices, false)) > 0.05);
    CHECK(lost <= 0.02);
    CHECK(lost > 0.0199);
    const Points given = positions.bottomRows(n) - mesh.vertices.bottomRows(n);
    const Points asked = free.bottomRows(n) - mesh.vertices.bottomRows(n);
    const double factor = given.norm() / asked.norm();
    CHECK(factor > 0.1);
    // The second component is far from the origin.
    CHECK((given - factor * asked).norm() < 1e-8 * asked.norm());
    CHECK(sentence(limited.remark().value()).find("1 ") != std::string::npos);

    options.motion.limits = {.volume = 0.02};
    CHECK(same_bits(flowed(mesh, options), positions));
}

TEST_CASE("a remark says how much of its volume a component would have lost, in per cent and in units of the file")
{
    PolygonMesh mesh = make_box(600);
    mesh.vertices *= std::cbrt(50.0 / volume(mesh));
    const Topology topology = make_topology(mesh);
    LimitedComponents limited(mesh, topology, {.volume = 0.02});
    Points positions = mesh.vertices * std::cbrt(0.86);
    limited.apply(positions);
    CHECK(sentence(limited.remark().value()).find("more than 2 % of its volume (14 %: 7 in units of the file)") !=
          std::string::npos);
    CHECK(sentence(limited.remark().value()).find(" radius smooths") != std::string::npos);
    positions = mesh.vertices * std::cbrt(0.99);
    limited.apply(positions);
    CHECK_FALSE(limited.remark());
}

TEST_CASE("whether a component is closed does not depend on faces of others that are turned")
{
    const PolygonMesh sphere = make_noisy_sphere(1000, {.amplitude = 0.0, .noise = 0.0});
    PolygonMesh mesh = side_by_side({sphere, sphere});
    std::swap(mesh.face_vertices[0], mesh.face_vertices[1]);
    const Points shrunk = 0.95 * mesh.vertices;
    Points positions = shrunk;
    const Topology topology = make_topology(mesh);
    LimitedComponents limited(mesh, topology, {.volume = 0.02});
    limited.apply(positions);
    CHECK(same_bits(positions.topRows(sphere.n_vertices()), shrunk.topRows(sphere.n_vertices())));
    const double left = volume(half(mesh, positions, false)) / volume(half(mesh, mesh.vertices, false));
    CHECK(left >= 0.98);
    CHECK(left < 0.9801);
}

TEST_CASE("a vertex of two components follows the stricter limit, once, and components that are exempt stay")
{
    // The lowest vertex of one sphere is the first of the other.
    PolygonMesh mesh = make_noisy_sphere(1000, {.amplitude = 0.0, .noise = 0.0});
    const Index n = mesh.n_vertices();
    const Index n_faces = mesh.n_faces();
    const Points first = mesh.vertices;
    Index lowest = 0;
    first.col(2).minCoeff(&lowest);
    mesh.vertices.conservativeResize(2 * n, 3);
    mesh.vertices.bottomRows(n) = first.rowwise() + (first.row(lowest) - first.row(0));
    for (Index f = 0; f < n_faces; ++f) {
        std::vector<Index> corners(mesh.face(f).begin(), mesh.face(f).end());
        for (Index& v : corners)
            v = v == 0 ? lowest : v + n;
        mesh.add_face(corners);
    }
    Points moved = mesh.vertices;
    for (Index v = 0; v < 2 * n; ++v)
        moved.row(v) *= v < n ? 0.99 : 0.95;
    const auto factor_at = [&](const Points& positions, Index v) {
        return (positions.row(v) - mesh.vertices.row(v)).norm() / (moved.row(v) - mesh.vertices.row(v)).norm();
    };
    const Topology topology = make_topology(mesh);
    LimitedComponents limited(mesh, topology, {.volume = 0.02});
    Points positions = moved;
    limited.apply(positions);
    const double of_first = factor_at(positions, lowest == 5 ? 6 : 5);
    const double of_second = factor_at(positions, n + 5);
    CHECK(of_second < 0.9 * of_first);
    CHECK(factor_at(positions, lowest) == relative(of_second, 1e-9));
    std::vector<std::uint8_t> exempt(usize(2 * n_faces), 0);
    std::fill(exempt.begin() + n_faces, exempt.end(), std::uint8_t{1});
    positions = moved;
    limited.apply(positions, exempt);
    CHECK(same_bits(positions.bottomRows(n), moved.bottomRows(n)));
    CHECK(factor_at(positions, lowest) == relative(of_first, 1e-9));
    positions = moved;
    LimitedComponents(mesh, topology, {.slide = 1e-8}).apply(positions, exempt);
    CHECK(same_bits(positions.bottomRows(n - 1), moved.bottomRows(n - 1)));
    CHECK_FALSE(same_bits(positions.topRows(n), moved.topRows(n)));
}

TEST_CASE("a remark names the limits that there are")
{
    const PolygonMesh mesh = make_noisy_sphere(500, {.amplitude = 0.0, .noise = 0.0});
    const Topology topology = make_topology(mesh);
    LimitedComponents limited(mesh, topology, {.move = 0.05});
    Points positions = 0.8 * mesh.vertices;
    limited.apply(positions);
    CHECK(sentence(limited.remark().value()).find("would have lost more than its noise: less was taken off") !=
          std::string::npos);
}

TEST_CASE("where less than a tenth would be left nothing is moved")
{
    PolygonMesh mesh = make_noisy_sphere(500, {.amplitude = 0.0, .noise = 0.0});
    const Topology topology = make_topology(mesh);
    LimitedComponents limited(mesh, topology, {.volume = 0.02});
    Points positions = Points::Zero(mesh.n_vertices(), 3);
    limited.apply(positions);
    CHECK(same_bits(positions, mesh.vertices));
    CHECK(limited.remark());
}

TEST_CASE("vertices of a component move along the normals by no more than the limit, open ones, too")
{
    for (const PolygonMesh& mesh : {make_noisy_sphere(2000, {.noise = 0.2}), make_quads(900)}) {
        const Topology topology = make_topology(mesh);
        const double edge = mean_edge_length(mesh, mesh.vertices);
        FlowOptions options;
        options.time_step = 5.0 * edge * edge;
        const Points free = flowed(mesh, options);
        const VertexNormals normals(mesh, topology);
        const auto move = [&](const Points& positions) {
            double total = 0.0;
            for (Index v = 0; v < mesh.n_vertices(); ++v) {
                const double along = (positions.row(v) - mesh.vertices.row(v)).dot(normals(v, free));
                total += along * along;
            }
            return std::sqrt(total / mesh.n_vertices());
        };
        const double limit = 0.6 * move(free);
        Points positions = free;
        LimitedComponents(mesh, topology, {.move = limit}).apply(positions);
        CHECK(std::abs(move(positions) / limit - 1.0) < 1e-3);
        // The stricter of both limits holds; open surfaces have no volume to keep.
        positions = free;
        LimitedComponents(mesh, topology, {.volume = 0.5, .move = limit}).apply(positions);
        CHECK(std::abs(move(positions) / limit - 1.0) < 1e-3);
        const bool is_open = std::ranges::count(topology.twin, -1) > 0;
        positions = free;
        LimitedComponents(mesh, topology, {.volume = 1e-4}).apply(positions);
        CHECK(same_bits(positions, free) == is_open);
        LimitedComponents unlimited(mesh, topology, {.move = 1.01 * move(free)});
        positions = free;
        unlimited.apply(positions);
        CHECK(same_bits(positions, free));
        CHECK_FALSE(unlimited.remark());
    }
}

TEST_CASE("no vertex slides along the surface further than the limit, and what it moves along the normal stays")
{
    const PolygonMesh mesh = make_noisy_sphere(4000, {.amplitude = 0.3, .noise = 0.2});
    const Topology topology = make_topology(mesh);
    const double edge = mean_edge_length(mesh, mesh.vertices);
    FlowOptions options;
    options.laplacian = Laplacian::Uniform;
    options.time_step = 2.0 * edge * edge;
    const Points free = flowed(mesh, options);
    const VertexNormals normals(mesh, topology);
    const double limit = 0.15 * edge;
    Points positions = free;
    LimitedComponents(mesh, topology, {.slide = limit}).apply(positions);
    int n_limited = 0;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const Point normal = normals(v, free);
        const Point asked = free.row(v) - mesh.vertices.row(v);
        const Point given = positions.row(v) - mesh.vertices.row(v);
        CHECK(std::abs(given.dot(normal) - asked.dot(normal)) <= 1e-12 * edge);
        const double slide = (asked - asked.dot(normal) * normal).norm();
        const double left = (given - given.dot(normal) * normal).norm();
        CHECK(std::abs(left - std::min(slide, limit)) <= 1e-12 * edge);
        if (slide <= limit)
            CHECK(same_bits(positions.row(v), free.row(v)));
        n_limited += slide > limit ? 1 : 0;
    }
    CHECK(n_limited > mesh.n_vertices() / 10);
    CHECK(n_limited < mesh.n_vertices());
}
