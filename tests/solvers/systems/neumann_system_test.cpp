#include <algorithm>
#include <map>
#include <optional>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "solvers/systems/neumann_system.h"
#include "solvers/systems/schur_complement.h"
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
    [[nodiscard]] std::size_t taken() const { return taken_; }

  private:
    void* do_allocate(std::size_t bytes, std::size_t alignment) override
    {
        taken_ += bytes;
        return std::pmr::new_delete_resource()->allocate(bytes, alignment);
    }
    void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override
    {
        taken_ -= bytes;
        std::fill_n(static_cast<std::byte*>(memory), bytes, std::byte{0xFF});
        std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
    }
    [[nodiscard]] bool do_is_equal(const FactorMemory& other) const noexcept override { return this == &other; }

    std::size_t taken_ = 0;
};

}  // namespace

TEST_CASE("the update by the whole step satisfies the sum of the sub-meshes' equations on Γ, and fills their interiors")
{
    WatchedMemory memory;
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
                NeumannSystem system(sub_mesh, sub_mesh.face_vertices, laplacian);
                const Points positions = localised(sub_mesh, cut.mesh.vertices);
                const Points update = localised(sub_mesh, expected) - positions;
                const auto equations = system.assemble(positions, neumann_time_step, workspace);
                const LdlSolver::Factor factor = system.factorise(equations, memory, workspace.ldl);
                CHECK(memory.taken() == system.factor_bytes());
                Points condensed;
                system.condense(equations, factor, condensed);
                SchurComplement schur;
                schur.take(factor, SchurComplement::Storage::Factor);
                Points share = condensed.bottomRows(system.n_interface());
                Points on_interface(system.n_interface(), 3);
                for (Index i = 0; i < system.n_interface(); ++i)
                    on_interface.row(i) = update.row(sub_mesh.interface.vertices[i]);
                largest = std::max(largest, share.size() > 0 ? share.cwiseAbs().maxCoeff() : 0.0);
                schur.subtract_product(on_interface, share);
                for (Index i = 0; i < system.n_interface(); ++i) {
                    const Index v = sub_mesh.local_to_global[sub_mesh.interface.vertices[i]];
                    residuals.try_emplace(v, Point::Zero()).first->second += share.row(i);
                }
                condensed.bottomRows(system.n_interface()) = on_interface;
                NeumannSystem::back_substitute(factor, condensed);
                REQUIRE(condensed.rows() == static_cast<Eigen::Index>(system.unknowns().size()));
                for (std::size_t u = 0; u < system.unknowns().size(); ++u)
                    CHECK((condensed.row(static_cast<Eigen::Index>(u)) - update.row(system.unknowns()[u])).norm() <
                          1e-9 * size);
            }
            CHECK(static_cast<Index>(residuals.size()) == decomposition.n_interface_vertices);
            for (const auto& [v, residual] : residuals)
                CHECK(residual.norm() < 1e-9 * largest);
        }
    }
}

TEST_CASE("what is copied of a factor gives the same products on Γ, and made again it gives the same interior")
{
    SolverWorkspace workspace;
    WatchedMemory memory;
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        for (const Laplacian laplacian : symmetric_laplacians)
            for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
                NeumannSystem system(sub_mesh, sub_mesh.face_vertices, laplacian);
                const Index n = system.n_interface();
                CHECK(SchurComplement::copy_bytes(n) == sizeof(double) * at(n * (n + 1) / 2));
                const Points positions = localised(sub_mesh, cut.mesh.vertices);
                const auto solved = [&](SchurComplement::Storage storage, Points& product) {
                    SchurComplement schur;
                    Points x;
                    std::optional<LdlSolver::Factor> factor;
                    const auto factorise = [&] {
                        const auto equations = system.assemble(positions, neumann_time_step, workspace);
                        factor = system.factorise(equations, memory, workspace.ldl);
                        CHECK(memory.taken() == system.factor_bytes());
                        system.condense(equations, *factor, x);
                    };
                    factorise();
                    schur.take(*factor, storage);
                    if (storage == SchurComplement::Storage::Copy) {
                        factor.reset();
                        CHECK(memory.taken() == 0);
                    }
                    product = Points::Zero(n, 3);
                    schur.subtract_product(x.bottomRows(n), product);
                    if (!factor)
                        factorise();
                    NeumannSystem::back_substitute(*factor, x);
                    return x;
                };
                Points of_kept;
                Points of_copy;
                const Points expected = solved(SchurComplement::Storage::Factor, of_kept);
                CHECK(memory.taken() == 0);
                CHECK(same_bits(solved(SchurComplement::Storage::Copy, of_copy), expected));
                CHECK(memory.taken() == 0);
                CHECK(same_bits(of_kept, of_copy));
            }
    }
}
