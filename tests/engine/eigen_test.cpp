#include <cmath>
#include <limits>
#include <stdexcept>

#include <doctest/doctest.h>

#include "engine/eigen.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

FlowOptions two_steps()
{
    FlowOptions options;
    options.time_step = 0.002;
    options.steps = 2;
    options.cut.subdomains = 4;
    return options;
}

/// #F by n, of a mesh whose faces all have n sides.
Eigen::MatrixXi faces_of(const PolygonMesh& mesh)
{
    const Index sides = mesh.n_corners() / mesh.n_faces();
    return Eigen::Map<const Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        mesh.face_vertices.data(), mesh.n_faces(), sides);
}

}  // namespace

TEST_CASE_TEMPLATE("matrices flow as the same polygon mesh does, bit for bit", Matrix, Eigen::MatrixXd,
                   Eigen::MatrixX3d, Points)
{
    for (const PolygonMesh& mesh : {make_triangles(400), make_quads(400)}) {
        const Points expected = flowed(mesh, two_steps());
        Matrix by_matrix = mesh.vertices;
        int n_observed = 0;
        const FlowReport report =
            mean_curvature_flow(by_matrix, faces_of(mesh), two_steps(), [&](const StepState&) { ++n_observed; });
        CHECK(Points(by_matrix) == expected);
        CHECK(report.cut.n_sub_meshes() == 4);
        CHECK(n_observed == 2);
        Matrix by_arrays = mesh.vertices;
        mean_curvature_flow(by_arrays, mesh.face_offsets, mesh.face_vertices, two_steps());
        CHECK(Points(by_arrays) == expected);
    }
}

TEST_CASE("faces of any numbers of sides flow, and single precision is rounded once")
{
    PolygonMesh mesh = make_mixed_polygons(400);
    Eigen::MatrixXf vertices = mesh.vertices.cast<float>();
    mesh.vertices = vertices.cast<double>();
    mean_curvature_flow(vertices, mesh.face_offsets, mesh.face_vertices, two_steps());
    CHECK(vertices == Eigen::MatrixXf(flowed(mesh, two_steps()).cast<float>()));
}

TEST_CASE("part of a larger matrix, and memory of the caller, flow where they are")
{
    const PolygonMesh mesh = make_triangles(400);
    const Points expected = flowed(mesh, two_steps());
    Eigen::MatrixXd with_normals = Eigen::MatrixXd::Constant(mesh.n_vertices(), 6, 7.0);
    auto positions = with_normals.leftCols<3>();
    positions = mesh.vertices;
    mean_curvature_flow(positions, faces_of(mesh), two_steps());
    CHECK(Points(with_normals.leftCols<3>()) == expected);
    CHECK((with_normals.rightCols<3>().array() == 7.0).all());

    std::vector<double> memory(mesh.vertices.data(), mesh.vertices.data() + mesh.vertices.size());
    Eigen::Map<Points> map(memory.data(), mesh.n_vertices(), 3);
    mean_curvature_flow(map, faces_of(mesh), two_steps());
    CHECK(map == expected);
}

TEST_CASE("after a failure the rows are those of the last complete step")
{
    const PolygonMesh mesh = make_quads(400);
    Eigen::MatrixXd vertices = mesh.vertices;
    Points after_first;
    CHECK_THROWS_AS(mean_curvature_flow(vertices, faces_of(mesh), two_steps(),
                                        [&](const StepState& state) {
                                            after_first = state.positions;
                                            throw std::runtime_error("stop");
                                        }),
                    std::runtime_error);
    CHECK(vertices == after_first);
    CHECK(vertices != mesh.vertices);
}

TEST_CASE("matrices that cannot be used are refused, and stay")
{
    const PolygonMesh mesh = make_triangles(100);
    Eigen::MatrixXd vertices = mesh.vertices;
    Eigen::MatrixXi faces = faces_of(mesh);
    faces(5, 2) = mesh.n_vertices();
    CHECK_THROWS_AS(mean_curvature_flow(vertices, faces, two_steps()), InputError);
    faces(5, 2) = faces(5, 0);
    CHECK_THROWS_WITH_AS(mean_curvature_flow(vertices, faces, two_steps()), doctest::Contains("face 5 "), InputError);
    std::vector<Index> corners = mesh.face_vertices;
    corners[3 * 7] = -2;
    CHECK_THROWS_WITH_AS(mean_curvature_flow(vertices, mesh.face_offsets, corners, two_steps()),
                         doctest::Contains("face 7 (numbered from 0) names vertex -2"), InputError);
    Eigen::MatrixXd plane = mesh.vertices.leftCols<2>();
    CHECK_THROWS_AS(mean_curvature_flow(plane, faces_of(mesh), two_steps()), InputError);
    CHECK(Points(vertices) == mesh.vertices);
    vertices(3, 1) = std::nan("");
    CHECK_THROWS_WITH_AS(mean_curvature_flow(vertices, faces_of(mesh), two_steps()), doctest::Contains("vertex 3 "),
                         InputError);
}
