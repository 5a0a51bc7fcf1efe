#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "partition/metrics/edge_measures.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

/// A disc of n triangles, whose middle may be a tip.
PolygonMesh cone(Index n, double height)
{
    PolygonMesh mesh;
    mesh.vertices = Points::Zero(n + 1, 3);
    mesh.vertices(n, 2) = height;
    for (Index v = 0; v < n; ++v) {
        const double angle = 2.0 * std::numbers::pi * v / n;
        mesh.vertices.row(v) << std::cos(angle), std::sin(angle), 0.0;
        mesh.add_face(std::array{v, (v + 1) % n, n});
    }
    return mesh;
}

}  // namespace

TEST_CASE("a vertex far from its neighbours is a spike, on triangles and on polygons, wherever it is")
{
    for (const PolygonMesh& plain : {make_triangles(900), make_quads(900), make_hexagons(900), make_noisy_sphere(900)})
        for (const Index v : {Index{0}, plain.n_vertices() / 2}) {
            CHECK(find_spikes(plain, plain.vertices).empty());
            PolygonMesh mesh = plain;
            const double edge = mean_edge_length(plain);
            mesh.vertices.row(v) += Point(0.0, 0.0, -9999.0 * edge);
            const std::vector<Spike> spikes = find_spikes(mesh, mesh.vertices);
            REQUIRE(spikes.size() == 1);
            CHECK(spikes[0].vertex == v);
            CHECK(spikes[0].distance > 1000.0);
            CHECK(sentence(remark_on_spikes(spikes))
                      .starts_with("Vertex " + std::to_string(v) + " (numbered from 0) is "));
            // The mean edge is that of the others.
            CHECK(mean_edge_length(mesh) == test::relative(edge, 0.02));
        }
}

TEST_CASE("one look at all edges finds the same spikes and the same mean as two")
{
    // How far vertices are rises with their numbers, so that only some are spikes.
    for (const double height : {0.0, 3.0, 5.0, 9.0, 9999.0})
        for (const PolygonMesh& plain : {make_triangles(900), make_hexagons(900), make_noisy_sphere(900)}) {
            PolygonMesh mesh = plain;
            const double edge = mean_edge_length(plain);
            for (Index v = 5; v < mesh.n_vertices(); v += 97)
                mesh.vertices.row(v) *= 1.0 + height * edge * v / 100.0;
            const EdgeMeasures measures = measure_edges(mesh, mesh.vertices);
            CHECK(measures.mean == mean_edge_length(mesh));
            const std::vector<Spike> spikes = find_spikes(mesh, mesh.vertices);
            REQUIRE(measures.spikes.size() == spikes.size());
            for (std::size_t i = 0; i < spikes.size(); ++i) {
                CHECK(measures.spikes[i].vertex == spikes[i].vertex);
                CHECK(measures.spikes[i].distance == spikes[i].distance);
            }
            CHECK(spikes.empty() == (height == 0.0));
        }
}

TEST_CASE(
    "a block of vertices far from all around it is one spike, and is filled from its rim; half of a surface is none")
{
    for (const PolygonMesh& plain :
         {make_triangles(900), make_quads(900), make_hexagons(900), make_noisy_sphere(900)}) {
        const double edge = mean_edge_length(plain);
        const Point middle = plain.vertices.row(plain.n_vertices() / 2);
        const Point far(0.0, 0.0, -9999.0 * edge);
        for (const double radius : {1.2, 2.5}) {
            std::vector<Index> block;
            PolygonMesh mesh = plain;
            for (Index v = 0; v < plain.n_vertices(); ++v)
                if ((plain.vertices.row(v) - middle).norm() < radius * edge) {
                    block.push_back(v);
                    mesh.vertices.row(v) += far;
                }
            REQUIRE(block.size() > 2);
            const std::vector<Spike> spikes = find_spikes(mesh, mesh.vertices);
            REQUIRE(spikes.size() == block.size());
            for (std::size_t i = 0; i < block.size(); ++i)
                CHECK(spikes[i].vertex == block[i]);
            const Points filled = without_spikes(mesh, make_topology(mesh), spikes, mesh.vertices);
            CHECK((filled - plain.vertices).rowwise().norm().maxCoeff() < (1.0 + radius) * edge);
        }
    }
    for (PolygonMesh halves : {make_quads(900), make_hexagons(900)}) {
        const double middle = halves.vertices.col(0).mean();
        for (auto row : halves.vertices.rowwise())
            if (row.x() > middle)
                row.z() -= 9999.0;
        CHECK(find_spikes(halves, halves.vertices).empty());
    }
}

TEST_CASE("the middle of a disc and the tip of a cone are no spikes, however many triangles they have")
{
    for (const Index n : {6, 100, 1000})
        for (const double height : {0.0, 1.0, 3.0})
            CHECK(find_spikes(cone(n, height), cone(n, height).vertices).empty());
    CHECK(find_spikes(cone(100, 30.0), cone(100, 30.0).vertices).size() == 1);
}
