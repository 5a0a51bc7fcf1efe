#include <doctest/doctest.h>

#include "solvers/estimate/ptackova_rows.h"
#include "tests/support/allocations.h"
#include "tests/support/matrices.h"

using namespace seamflow;

namespace {

double vertex_area(const PolygonMesh& mesh, const Topology& topology, Index v)
{
    double sum = 0.0;
    for (const Index corner : topology.corners_at(v)) {
        const auto corners = mesh.face(topology.face_of[corner]);
        sum += area(corners, mesh.vertices) / static_cast<double>(corners.size());
    }
    return sum;
}

}  // namespace

TEST_CASE("the residuals are rows of the whole system times the areas of their vertices, without allocations")
{
    constexpr double time_step = 0.03;
    for (const auto& sound : test::sound_meshes()) {
        CAPTURE(sound.name);
        const PolygonMesh& mesh = sound.mesh;
        const Topology& topology = sound.topology;
        const Points& before = mesh.vertices;
        const Points after = before + 0.05 * Points::Random(before.rows(), 3);
        const Eigen::MatrixXd laplacian = test::dense_laplacian(Laplacian::PtackovaVelho, mesh, topology);
        const Points expected = after - before + time_step * laplacian * after;
        std::vector<Index> vertices;
        IndexLists faces;
        for (Index v = mesh.n_vertices(); v-- > 0;)
            if (topology.kind[v] == VertexKind::Interior && v % 3 != 0)
                vertices.push_back(v);
        for (const Index v : vertices) {
            for (const Index corner : topology.corners_at(v))
                faces.values.push_back(topology.face_of[corner]);
            faces.close();
        }
        PtackovaRows rows(mesh, topology, vertices, faces);
        Points residuals(static_cast<Eigen::Index>(vertices.size()), 3);
        const Executor exec = run_serially;
        const long allocations = test::n_allocations();
        rows.evaluate(mesh, topology, before, after, time_step, exec, residuals);
        CHECK(test::n_allocations() == allocations);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Point found = residuals.row(static_cast<Eigen::Index>(i)) / vertex_area(mesh, topology, vertices[i]);
            const Point row = expected.row(vertices[i]);
            CHECK((found - row).norm() <= 1e-10 * (1.0 + row.norm()));
        }
    }
}
