#include <doctest/doctest.h>

#include "engine/measure/mesh_size.h"
#include "samples/meshes/meshes.h"
#include "tests/support/relative.h"

using namespace seamflow;

TEST_CASE("a mesh is as large as its faces together, and its edges as long as they are on average")
{
    PolygonMesh square = make_quads(400);
    square.vertices.col(2).setZero();
    const Eigen::RowVector3d lowest = square.vertices.colwise().minCoeff();
    const Eigen::RowVector3d width = square.vertices.colwise().maxCoeff() - lowest;
    const MeshSize size = size_of(square);
    CHECK(size.vertices == square.n_vertices());
    CHECK(size.area == test::relative(width.x() * width.y(), 1e-5));
    CHECK(total_area(square) == size.area);
    double edges = 0.0;
    for (Index f = 0; f < square.n_faces(); ++f) {
        const auto corners = square.face(f);
        for (std::size_t k = 0; k < 4; ++k)
            edges += (square.vertices.row(corners[(k + 1) % 4]) - square.vertices.row(corners[k])).norm();
    }
    CHECK(size.mean_edge == test::relative(edges / square.n_corners(), 1e-5));

    const MeshSize nothing = size_of(PolygonMesh{});
    CHECK(nothing.vertices == 0);
    CHECK(nothing.area == 0.0);
    CHECK(nothing.mean_edge == 0.0);
}
