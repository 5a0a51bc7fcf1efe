#include <cstdint>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "partition/eigen.h"
#include "samples/meshes/meshes.h"
#include "tests/support/messages.h"

using namespace seamflow;

namespace {

/// What is said about matrices that make no mesh; empty if they make one.
template <class Vertices, class Faces>
std::string matrix_complaint(const Vertices& vertices, const Faces& faces)
{
    return test::message_of<InputError>([&] { to_polygon_mesh(vertices, faces); });
}

}  // namespace

TEST_CASE("matrices of any storage order and type make the same mesh")
{
    const PolygonMesh mesh = make_quads(100);
    const Eigen::Map<const Eigen::Matrix<Index, Eigen::Dynamic, 4, Eigen::RowMajor>> rows(mesh.face_vertices.data(),
                                                                                          mesh.n_faces(), 4);
    const auto check = [&](const auto& vertices, const auto& faces) {
        const PolygonMesh made = to_polygon_mesh(vertices, faces);
        CHECK(made.vertices == mesh.vertices);
        CHECK(made.face_offsets == mesh.face_offsets);
        CHECK(made.face_vertices == mesh.face_vertices);
    };
    check(Eigen::MatrixXd(mesh.vertices), Eigen::MatrixXi(rows));
    check(mesh.vertices, rows);
    check(Eigen::MatrixX3d(mesh.vertices), rows.cast<std::int64_t>());
    check(mesh.vertices.cast<long double>(), rows.cast<std::uint16_t>().eval());
    CHECK(to_polygon_mesh(mesh.vertices, mesh.face_offsets, mesh.face_vertices).face_vertices == mesh.face_vertices);
    CHECK(to_polygon_mesh(mesh.vertices, Eigen::MatrixXi(0, 0)).n_faces() == 0);
}

TEST_CASE("matrices of another shape are refused")
{
    const Eigen::MatrixXd vertices = Eigen::MatrixXd::Random(3, 5);
    const Eigen::MatrixXi triangle = Eigen::RowVector3i(0, 1, 2);
    CHECK(matrix_complaint(vertices, triangle) ==
          "the matrix of vertices is 3 by 5: it must have 3 columns, and a row per vertex");
    CHECK(matrix_complaint(vertices.leftCols(3), triangle) == "");
    CHECK(matrix_complaint(vertices.leftCols(3), triangle.leftCols(2)) ==
          "the matrix of faces is 1 by 2: it must have 3 columns or more, and a row per face");
}

TEST_CASE("a vertex that there is not is named by row and column")
{
    const Points vertices = Points::Random(4, 3);
    Eigen::MatrixXi faces(2, 3);
    faces << 0, 1, 2, 0, 4, 3;
    CHECK(matrix_complaint(vertices, faces) == "faces(1, 1) is 4, but the vertices are 0 to 3");
    faces(0, 2) = -1;
    CHECK(matrix_complaint(vertices, faces) == "faces(0, 2) is -1, but the vertices are 0 to 3");
    // What would be 1 in 32 bits.
    const Eigen::Matrix<std::int64_t, 1, 3> wide(0, (std::int64_t{1} << 32) + 1, 2);
    CHECK(matrix_complaint(vertices, wide) == "faces(0, 1) is 4294967297, but the vertices are 0 to 3");
    const Eigen::Matrix<std::uint64_t, 1, 3> unsigned_one(0, 1, std::numeric_limits<std::uint64_t>::max());
    CHECK(matrix_complaint(vertices, unsigned_one) ==
          "faces(0, 2) is 18446744073709551615, but the vertices are 0 to 3");
}
