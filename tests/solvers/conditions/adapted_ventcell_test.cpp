#include <doctest/doctest.h>

#include "solvers/conditions/adapted_robin.h"
#include "solvers/conditions/adapted_ventcell.h"
#include "solvers/conditions/derivatives.h"
#include "tests/support/conditions.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("the Ventcell row is the Robin row and dt q ∂t")
{
    const double time_step = 0.02;
    const double p = 5.0;
    for (const double q : {0.0, 0.5})
        for (const CutMesh& cut : cut_meshes()) {
            CAPTURE(cut.name);
            const Decomposition decomposition = test::decompose(cut);
            for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
                const Points positions = localised(sub_mesh, cut.mesh.vertices);
                AdaptedRobin robin(sub_mesh);
                const auto ventcell = make_adapted_ventcell(sub_mesh, q);
                robin.begin_step(positions, positions, time_step, p);
                ventcell->begin_step(positions, positions, time_step, p);
                for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
                    std::vector<double> robin_row;
                    std::vector<double> row;
                    CHECK(row_of(*ventcell, i, positions, row) == row_of(robin, i, positions, robin_row));
                    std::vector<double> tangential(row.size());
                    add_tangential_derivative(robin.stencils(), i, tangential_weights(sub_mesh, i, positions), 1.0,
                                              tangential);
                    for (std::size_t k = 0; k < row.size(); ++k)
                        CHECK(row[k] == doctest::Approx(robin_row[k] + time_step * q * tangential[k]).epsilon(1e-14));
                }
            }
        }
}
