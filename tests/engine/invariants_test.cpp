#include <cmath>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/topology.h"
#include "samples/meshes/meshes.h"
#include "solvers/laplacian/geometry.h"
#include "tests/support/flows.h"
#include "tests/support/random_meshes.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::all_laplacians;
using test::flowed;
using test::height_fields;
using test::largest_difference;

namespace {

PolygonMesh flat(PolygonMesh mesh)
{
    mesh.vertices.col(2).setZero();
    return mesh;
}

/// Bricks, three of which meet at their corners.
std::vector<Index> labels_of_tiles(const PolygonMesh& mesh)
{
    std::vector<Index> labels;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const Point middle = centroid(mesh.face(f), mesh.vertices);
        const auto row = static_cast<Index>(3.0 * middle.y());
        labels.push_back(4 * row + static_cast<Index>(3.0 * middle.x() + 0.5 * (row % 2)));
    }
    return labels;
}

FlowOptions sweep_options(Laplacian laplacian, Index subdomains)
{
    FlowOptions options;
    options.accuracy.approach = Approach::Sweep;
    options.laplacian = laplacian;
    options.time_step = 0.002;
    options.steps = 3;
    options.cut.subdomains = subdomains;
    return options;
}

}  // namespace

TEST_CASE("a flat mesh stays flat whatever the cut")
{
    for (const PolygonMesh& mesh : height_fields())
        for (const Laplacian laplacian : all_laplacians)
            for (const Index subdomains : {1, 2, 5, 16}) {
                CAPTURE(name_of(laplacian));
                CAPTURE(subdomains);
                const Points result = flowed(flat(mesh), sweep_options(laplacian, subdomains));
                CHECK(result.allFinite());
                CHECK(result.col(2).cwiseAbs().maxCoeff() == 0.0);
            }
}

TEST_CASE("with Alexa-Wardetzky a flat mesh of triangles does not move at all without the correction")
{
    const PolygonMesh mesh = flat(make_triangles(900));
    for (const Index subdomains : {1, 2, 5, 16}) {
        FlowOptions options = sweep_options(Laplacian::AlexaWardetzky, subdomains);
        options.interface.correction = Correction::None;
        CHECK(largest_difference(flowed(mesh, options), mesh.vertices) <= 1e-12);
    }
}

TEST_CASE("moving the input rigidly moves the result alike")
{
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
    const Eigen::RowVector3d shift(3.0, -1.0, 2.0);
    const auto moved = [&](const Points& points) { return Points((points * rotation.transpose()).rowwise() + shift); };
    for (const PolygonMesh& mesh : height_fields())
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(name_of(laplacian));
            const FlowOptions options = sweep_options(laplacian, 6);
            PolygonMesh moved_mesh = mesh;
            moved_mesh.vertices = moved(mesh.vertices);
            CHECK(largest_difference(flowed(moved_mesh, options), moved(flowed(mesh, options))) <= 1e-9);
        }
}

TEST_CASE("scaling by s, with dt s² and p / s, scales the result")
{
    for (const double s : {1e-3, 7.0, 1e4})
        for (const PolygonMesh& mesh : height_fields())
            for (const Laplacian laplacian : all_laplacians) {
                CAPTURE(name_of(laplacian));
                CAPTURE(s);
                FlowOptions options = sweep_options(laplacian, 6);
                options.interface.p = 20.0;
                const Points expected = s * flowed(mesh, options);
                PolygonMesh scaled = mesh;
                scaled.vertices *= s;
                options.time_step *= s * s;
                options.interface.p = 20.0 / s;
                CHECK(largest_difference(flowed(scaled, options), expected) <= 1e-9 * s);
            }
}

TEST_CASE("other numbers of the vertices and faces move the result by rounding alone where the cut is given")
{
    RandomNumbers random(7);
    for (const PolygonMesh& mesh : height_fields()) {
        const auto new_vertex = test::random_permutation(mesh.n_vertices(), random);
        const auto old_face = test::random_permutation(mesh.n_faces(), random);
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(name_of(laplacian));
            FlowOptions options = sweep_options(laplacian, 0);
            options.interface.colouring = Colouring::Label;
            options.cut.labels = labels_of_tiles(mesh);
            const Points result = flowed(mesh, options);
            std::vector<Index> labels;
            for (const Index f : old_face)
                labels.push_back(options.cut.labels[f]);
            options.cut.labels = labels;
            const Points renumbered = flowed(test::renumbered(mesh, new_vertex, old_face), options);
            CHECK(largest_difference(renumbered(new_vertex, Eigen::all), result) <= 1e-11);
        }
    }
}

TEST_CASE("boundary vertices and vertices without faces stay to the bit")
{
    for (PolygonMesh mesh : height_fields()) {
        mesh.vertices.conservativeResize(mesh.n_vertices() + 1, 3);
        mesh.vertices.row(mesh.n_vertices() - 1) << 0.1, 0.2, 0.3;
        const Topology topology = make_topology(mesh);
        for (const Laplacian laplacian : all_laplacians) {
            const Points result = flowed(mesh, sweep_options(laplacian, 6));
            int moved = 0;
            for (Index v = 0; v < mesh.n_vertices(); ++v)
                if (topology.kind[v] == VertexKind::Interior)
                    moved += (result.row(v) - mesh.vertices.row(v)).norm() > 0.0 ? 1 : 0;
                else
                    CHECK(result.row(v) == mesh.vertices.row(v));
            CHECK(moved > 700);
        }
    }
}

TEST_CASE("components that nothing joins flow as they do alone")
{
    const PolygonMesh first = make_triangles(400);
    const PolygonMesh second = make_hexagons(400);
    const PolygonMesh both = test::side_by_side({first, second});
    for (const Laplacian laplacian : all_laplacians) {
        const Points result = flowed(both, sweep_options(laplacian, 2));
        const Points offset_first = both.vertices.topRows(first.n_vertices());
        PolygonMesh alone = first;
        alone.vertices = offset_first;
        FlowOptions options = sweep_options(laplacian, 1);
        // That of both.
        options.uniform_edge = mean_edge_length(both, both.vertices);
        CHECK(largest_difference(result.topRows(first.n_vertices()), flowed(alone, options)) <= 1e-12);
    }
}

TEST_CASE("the flow shrinks the height of a bump, decomposed and not, to about the same")
{
    for (const PolygonMesh& mesh : height_fields())
        for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::PtackovaVelho}) {
            CAPTURE(name_of(laplacian));
            const double before = mesh.vertices.col(2).norm();
            const double undecomposed = flowed(mesh, sweep_options(laplacian, 1)).col(2).norm();
            const double decomposed = flowed(mesh, sweep_options(laplacian, 4)).col(2).norm();
            CHECK(undecomposed < 0.8 * before);
            CHECK(decomposed == test::relative(undecomposed, 0.05));
        }
}
