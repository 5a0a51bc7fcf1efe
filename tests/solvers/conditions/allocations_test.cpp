#include <doctest/doctest.h>

#include "solvers/conditions/adapted_robin.h"
#include "solvers/conditions/predicted_side.h"
#include "tests/support/allocations.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Allocations by one step of a condition: all rows, both sides.
long allocations_in_step(TransmissionCondition& condition, Index n_rows, const Points& positions, std::span<double> row)
{
    const long before = n_allocations();
    condition.begin_step(positions, positions, 0.01, 3.0);
    for (Index i = 0; i < n_rows; ++i) {
        condition.left_hand_side(i, positions, row.first(condition.columns()[i].size()));
        row[0] += condition.right_hand_side(i, positions, positions).x();
    }
    return n_allocations() - before;
}

}  // namespace

TEST_CASE("from the second step on no condition allocates memory")
{
    std::vector<double> row(1000);
    for_each_sub_mesh([&](const CutMesh& cut, const SubMesh& sub_mesh) {
        const Points positions = localised(sub_mesh, cut.mesh.vertices);
        const long before = n_allocations();
        std::vector<std::unique_ptr<TransmissionCondition>> conditions;
        conditions.push_back(make_adapted_ventcell(sub_mesh));
        conditions.push_back(make_adapted_ventcell(sub_mesh, 0.4));
        conditions.push_back(make_ventcell(sub_mesh));
        conditions.push_back(make_ventcell(sub_mesh, 0.4));
        for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::PtackovaVelho})
            conditions.push_back(make_predicted_side(sub_mesh, laplacian));
        CHECK(n_allocations() > before);
        for (const auto& condition : conditions) {
            allocations_in_step(*condition, sub_mesh.interface.size(), positions, row);
            CHECK(allocations_in_step(*condition, sub_mesh.interface.size(), positions, row) == 0);
        }
    });
}
