#include <doctest/doctest.h>

#include "solvers/interface/ptackova_residual.h"
#include "tests/support/matrices.h"

using namespace seamflow;

TEST_CASE("the residual is the row of the whole system times the area of the vertex")
{
    constexpr double time_step = 0.03;
    for (const auto& [name, mesh, topology] : test::sound_meshes()) {
        CAPTURE(name);
        const Points& before = mesh.vertices;
        const Points after = before + 0.05 * Points::Random(before.rows(), 3);
        const Eigen::MatrixXd laplacian = test::dense_laplacian(Laplacian::PtackovaVelho, mesh, topology);
        const Points expected = after - before + time_step * laplacian * after;
        for (Index v = 0; v < mesh.n_vertices(); ++v) {
            if (topology.kind[at(v)] != VertexKind::Interior)
                continue;
            double vertex_area = 0.0;
            for (const Index corner : topology.corners_at(v)) {
                const auto corners = mesh.face(topology.face_of[at(corner)]);
                vertex_area += area(corners, before) / static_cast<double>(corners.size());
            }
            const Point residual = ptackova_residual(mesh, topology, before, after, time_step, v);
            CHECK((residual / vertex_area - expected.row(v)).norm() <= 1e-10 * (1.0 + expected.row(v).norm()));
        }
    }
}
