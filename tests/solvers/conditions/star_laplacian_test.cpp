#include <doctest/doctest.h>

#include "solvers/conditions/star_laplacian.h"
#include "solvers/laplacian/mean_curvature.h"
#include "tests/support/conditions.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("the rows on Γ are those of the whole mesh")
{
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Topology topology = make_topology(cut.mesh);
        const Decomposition decomposition = test::decompose(cut);
        for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky}) {
            CAPTURE(name_of(laplacian));
            for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
                const Points positions = localised(sub_mesh, cut.mesh.vertices);
                StarLaplacian star(sub_mesh, laplacian);
                star.assemble(positions);
                for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
                    const Index v = sub_mesh.local_to_global[sub_mesh.interface.vertices[i]];
                    const Point expected = mean_curvature_vector(cut.mesh, topology, cut.mesh.vertices, laplacian, v);
                    const Point found = applied(star.columns()[i], star.row(i), positions);
                    double largest = 0.0;
                    for (const double coefficient : star.row(i))
                        largest = std::max(largest, std::abs(coefficient));
                    CHECK((found - expected).norm() <= 1e-12 * largest * (1.0 + positions.cwiseAbs().maxCoeff()));
                }
            }
        }
    }
}
