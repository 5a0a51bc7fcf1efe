#include <cmath>
#include <limits>
#include <random>

#include <doctest/doctest.h>

#include "partition/cracks.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/weld.h"
#include "samples/meshes/meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

/// Every face with vertices of its own, which are moved by up to `width` in each coordinate.
PolygonMesh cracked(const PolygonMesh& mesh, double width)
{
    PolygonMesh loose;
    loose.vertices.resize(mesh.n_corners(), 3);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> offset(-width, width);
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        std::vector<Index> corners;
        for (const Index v : mesh.face(f)) {
            const auto corner = static_cast<Index>(loose.n_corners() + std::ssize(corners));
            loose.vertices.row(corner) = mesh.vertices.row(v);
            for (int c = 0; c < 3; ++c)
                loose.vertices(corner, c) += offset(random);
            corners.push_back(corner);
        }
        loose.add_face(corners);
    }
    return loose;
}

}  // namespace

TEST_CASE("cracks are found, and the distance that is proposed closes them")
{
    for (const PolygonMesh& mesh : {make_noisy_sphere(400), make_quads(400)}) {
        const double edge = mean_edge_length(mesh);
        for (const double width : {1e-9, 1e-6, 1e-4}) {
            const PolygonMesh loose = cracked(mesh, width * edge);
            const auto cracks = find_cracks(loose, make_topology(loose));
            REQUIRE(cracks);
            CHECK(cracks->n_vertices > loose.n_vertices() / 2);
            CHECK(cracks->width < 4.0 * width * edge);
            CHECK(cracks->weld_distance >= cracks->width);
            const auto welded = weld(loose, make_topology(loose), cracks->weld_distance);
            REQUIRE(welded);
            CHECK(welded->n_edges == cracks->n_edges);
            CHECK_FALSE(find_cracks(welded->mesh, welded->topology));
            CHECK(sentence(remark_on_cracks(*cracks)).find(": weld ") != std::string::npos);
        }
    }
}

TEST_CASE("boundaries that are far from each other, or lie on each other, are no cracks")
{
    for (const PolygonMesh& mesh : {make_quads(400), make_noisy_sphere(400), test::cylinder(20, 5)})
        CHECK_FALSE(find_cracks(mesh, make_topology(mesh)));
    const PolygonMesh on_each_other = cracked(make_quads(100), 0.0);
    CHECK_FALSE(find_cracks(on_each_other, make_topology(on_each_other)));
    CHECK_FALSE(find_cracks(PolygonMesh{}, make_topology(PolygonMesh{})));
}
