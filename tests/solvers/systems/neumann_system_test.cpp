#include <algorithm>
#include <map>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "solvers/systems/neumann_system.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/matrices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

constexpr double neumann_time_step = 0.02;

/// Knows how much is taken, and spoils what is given back.
class WatchedMemory final : public FactorMemory {
  public:
    std::span<std::byte> take(std::size_t bytes) override
    {
        taken_ += bytes;
        return heap_memory().take(bytes);
    }

    void give_back(std::span<std::byte> memory) override
    {
        taken_ -= memory.size();
        std::fill(memory.begin(), memory.end(), std::byte{0xFF});
        heap_memory().give_back(memory);
    }

    [[nodiscard]] std::size_t taken() const { return taken_; }

  private:
    std::size_t taken_ = 0;
};

}  // namespace

TEST_CASE("the update by the whole step satisfies the sum of the sub-meshes' equations on Γ, and fills their interiors")
{
    SolverWorkspace workspace;
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        for (const Laplacian laplacian : symmetric_laplacians) {
            CAPTURE(name_of(laplacian));
            const Points expected = undecomposed_step(cut, laplacian, neumann_time_step);
            const double size = cut.mesh.vertices.cwiseAbs().maxCoeff();
            std::map<Index, Point> residuals;
            double largest = 0.0;
            for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
                NeumannSystem system(sub_mesh, laplacian);
                const Points positions = localised(sub_mesh, cut.mesh.vertices);
                const Points update = localised(sub_mesh, expected) - positions;
                system.assemble(positions, neumann_time_step, workspace);
                system.factorise(workspace);
                Points eliminated;
                Points share(system.n_interface(), 3);
                system.condense(eliminated, share, workspace);
                Points on_interface(system.n_interface(), 3);
                for (Index i = 0; i < system.n_interface(); ++i)
                    on_interface.row(i) = update.row(sub_mesh.interface.vertices[i]);
                largest = std::max(largest, share.size() > 0 ? share.cwiseAbs().maxCoeff() : 0.0);
                system.subtract_schur(on_interface, share);
                for (Index i = 0; i < system.n_interface(); ++i) {
                    const Index v = sub_mesh.local_to_global[sub_mesh.interface.vertices[i]];
                    residuals.try_emplace(v, Point::Zero()).first->second += share.row(i);
                }
                eliminated.bottomRows(system.n_interface()) = on_interface;
                system.fill_in(eliminated);
                REQUIRE(eliminated.rows() == static_cast<Eigen::Index>(system.unknowns().size()));
                for (std::size_t u = 0; u < system.unknowns().size(); ++u)
                    CHECK((eliminated.row(static_cast<Eigen::Index>(u)) - update.row(system.unknowns()[u])).norm() <
                          1e-9 * size);
            }
            CHECK(static_cast<Index>(residuals.size()) == decomposition.n_interface_vertices);
            for (const auto& [v, residual] : residuals)
                CHECK(residual.norm() < 1e-9 * largest);
        }
    }
}

TEST_CASE("what stays of a factor in borrowed memory gives the same products on Γ, and made again it fills in the same")
{
    SolverWorkspace kept_workspace;
    SolverWorkspace workspace;
    WatchedMemory memory;
    workspace.factors = &memory;
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        for (const Laplacian laplacian : symmetric_laplacians)
            for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
                NeumannSystem kept(sub_mesh, laplacian);
                NeumannSystem passing(sub_mesh, laplacian);
                passing.borrow_memory();
                const Index n = kept.n_interface();
                CHECK(passing.bytes_on_interface() == sizeof(double) * at(n * (n + 1) / 2));
                const Points positions = localised(sub_mesh, cut.mesh.vertices);
                const auto condensed = [&](const NeumannSystem& system, const SolverWorkspace& of_system) {
                    Points eliminated;
                    Points share(n, 3);
                    system.condense(eliminated, share, of_system);
                    return eliminated;
                };
                kept.assemble(positions, neumann_time_step, kept_workspace);
                kept.factorise(kept_workspace);
                Points expected = condensed(kept, kept_workspace);
                passing.assemble(positions, neumann_time_step, workspace);
                passing.factorise(workspace);
                CHECK(memory.taken() == passing.factor_bytes());
                CHECK(same_bits(condensed(passing, workspace), expected));
                passing.give_back_interior(workspace);
                CHECK(memory.taken() == 0);
                const Points on_interface = expected.bottomRows(n);
                Points of_kept = Points::Zero(n, 3);
                Points of_passing = Points::Zero(n, 3);
                kept.subtract_schur(on_interface, of_kept);
                passing.subtract_schur(on_interface, of_passing);
                CHECK(same_bits(of_kept, of_passing));
                passing.assemble(positions, neumann_time_step, workspace);
                passing.factorise_again(workspace);
                CHECK(memory.taken() == passing.factor_bytes());
                Points again = condensed(passing, workspace);
                kept.fill_in(expected);
                passing.fill_in(again);
                passing.give_back(workspace);
                CHECK(memory.taken() == 0);
                CHECK(same_bits(again, expected));
            }
    }
}
