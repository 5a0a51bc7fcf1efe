#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/coordinate_steps.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/vector_area.h"
#include "solvers/denoising/vertex_averages.h"
#include "solvers/rounding/flat_facets.h"
#include "solvers/rounding/rounded_surface.h"
#include "tests/support/digitised.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::ball;
using test::crossed_edges;
using test::Inside;
using test::voxel_faces;

namespace {

std::vector<std::uint8_t> flat_in(const PolygonMesh& mesh, const Point& steps = Point::Ones())
{
    const Topology topology = make_topology(mesh);
    const auto planes = find_coordinate_steps(mesh.vertices, mean_edge_length(mesh));
    return flat_facets(mesh.vertices, VertexAverages(mesh, topology).neighbours(), planes, steps, run_in_parallel);
}

Index count_flat(const std::vector<std::uint8_t>& bits)
{
    return static_cast<Index>(std::ranges::count_if(bits, [](std::uint8_t of) { return of != 0; }));
}

Inside cylinder(double radius, double half_height)
{
    return [=](const Point& point) {
        return std::hypot(point.x() - 0.2, point.y() - 0.3) < radius && std::abs(point.z()) < half_height;
    };
}

std::optional<SmoothedWithinSteps> smoothed_freely(const PolygonMesh& mesh)
{
    Topology topology = make_topology(mesh, run_in_parallel);
    free_boundary(topology);
    return smooth_rounded(mesh, topology, mesh.vertices, {}, run_in_parallel);
}

/// Below 0 where there is sea.
double ground(double x, double y)
{
    return 10.0 * std::sin(x / 23.0) * std::cos(y / 31.0) + 5.0 * std::sin((x + 2.0 * y) / 37.0);
}

}  // namespace

TEST_CASE("summits, ridges and saddles are nowhere flat, whatever their size and place on the lattice")
{
    for (double radius = 3.3; radius < 25.0; radius += 1.7)
        for (const double shift : {0.0, 0.21, 0.43}) {
            CAPTURE(radius);
            CAPTURE(shift);
            const Point centre(shift, 0.5 * shift, -shift);
            const Inside inside = [&](const Point& point) { return (point - centre).norm() < radius; };
            const auto n = static_cast<Index>(2.0 * radius) + 6;
            CHECK(count_flat(flat_in(voxel_faces(inside, n))) == 0);
            CHECK(count_flat(flat_in(crossed_edges(inside, n))) == 0);
        }
    const Inside torus = [](const Point& point) {
        return std::hypot(std::hypot(point.x(), point.y()) - 12.0, point.z()) < 5.2;
    };
    CHECK(count_flat(flat_in(voxel_faces(torus, 40))) == 0);
    const Inside lying = [](const Point& point) {
        return std::hypot(point.y(), point.z()) < 9.4 && std::abs(point.x() * 0.96 + point.y() * 0.28) < 15.0;
    };
    CHECK(count_flat(flat_in(voxel_faces(lying, 44))) == 0);
    const auto saddle = [](double x, double y) {
        return std::round(((x - 40.0) * (x - 40.0) - (y - 40.0) * (y - 40.0)) / 90.0);
    };
    CHECK(count_flat(flat_in(test::height_grid(80, saddle), Point(0.0, 0.0, 1.0))) == 0);
}

TEST_CASE("the ends of a cylinder stay flat up to their rims, and its wall becomes round")
{
    for (const bool marching : {false, true}) {
        CAPTURE(marching);
        const PolygonMesh mesh =
            marching ? crossed_edges(cylinder(12.3, 15.0), 34) : voxel_faces(cylinder(12.3, 15.0), 34);
        const auto result = smoothed_freely(mesh);
        REQUIRE(result);
        const double top = mesh.vertices.col(2).maxCoeff();
        Index n_ends = 0;
        double furthest = 0.0;
        double off = 0.0;
        double n_wall = 0.0;
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if (std::abs(mesh.vertices(v, 2)) == top) {
                ++n_ends;
                CHECK(result->positions(v, 2) == mesh.vertices(v, 2));
            } else {
                const Point to = result->positions.row(v);
                off += std::abs(std::hypot(to.x() - 0.2, to.y() - 0.3) - 12.3);
                n_wall += 1.0;
                furthest = std::max(furthest, std::abs(to.x() - mesh.vertices(v, 0)));
            }
        CHECK(n_ends > 800);
        CHECK(off < 0.15 * n_wall);
        CHECK(furthest > 0.3);
    }
}

TEST_CASE("the sea beside hills stays level, and hills become smooth")
{
    const PolygonMesh truth = test::height_grid(140, [](double x, double y) { return std::max(0.0, ground(x, y)); });
    const PolygonMesh mesh = test::rounded(truth, Point(0.0, 0.0, 1.0));
    const auto result = smoothed_freely(mesh);
    REQUIRE(result);
    double at_sea = 0.0;
    double on_hills = 0.0;
    double before = 0.0;
    Index n_sea = 0;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const double error = result->positions(v, 2) - truth.vertices(v, 2);
        const double depth = -ground(mesh.vertices(v, 0), mesh.vertices(v, 1));
        if (depth > 2.0) {
            ++n_sea;
            at_sea += error * error;
        } else if (depth < 0.0) {
            on_hills += error * error;
            before += (mesh.vertices(v, 2) - truth.vertices(v, 2)) * (mesh.vertices(v, 2) - truth.vertices(v, 2));
        }
    }
    REQUIRE(n_sea > 3000);
    // 0.27 if what is flat moves.
    CHECK(std::sqrt(at_sea / n_sea) < 0.15);
    CHECK(on_hills < 0.2 * before);
}

TEST_CASE("flat facets are the same with other axes, units and orders")
{
    const PolygonMesh mesh = voxel_faces(cylinder(10.3, 9.0), 30);
    const std::vector<std::uint8_t> bits = flat_in(mesh);
    CHECK(count_flat(bits) > 600);
    PolygonMesh turned = mesh;
    turned.vertices.col(0) = 3.7 * mesh.vertices.col(2).array() + 1e4;
    turned.vertices.col(1) = 3.7 * mesh.vertices.col(0);
    turned.vertices.col(2) = -3.7 * mesh.vertices.col(1);
    const std::vector<std::uint8_t> of_turned = flat_in(turned, Point::Constant(3.7));
    for (std::size_t v = 0; v < bits.size(); ++v) {
        const unsigned expected =
            ((bits[v] & 4U) != 0 ? 1U : 0U) | ((bits[v] & 1U) != 0 ? 2U : 0U) | ((bits[v] & 2U) != 0 ? 4U : 0U);
        CHECK(of_turned[v] == expected);
    }
}
