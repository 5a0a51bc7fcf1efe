#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "solvers/systems/neumann_system.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/heap.h"
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

TEST_CASE("sub-meshes' residuals vanish in sum at the update by the whole step, and condensed they lead the way there")
{
    WatchedMemory memory;
    SolverWorkspace workspace;
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        for (const Laplacian laplacian : symmetric_laplacians)
            for (const Precision precision : {Precision::Automatic, Precision::Single, Precision::Double}) {
                CAPTURE(name_of(laplacian));
                const Points expected = undecomposed_step(cut, laplacian, neumann_time_step);
                const double size = cut.mesh.vertices.cwiseAbs().maxCoeff();
                const double rounding = precision == Precision::Double ? 1e-9 : 1e-4;
                std::map<Index, Point> residuals;
                double largest = 0.0;
                for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
                    const NeumannSystem system(sub_mesh, sub_mesh.face_vertices, laplacian);
                    const Points positions = localised(sub_mesh, cut.mesh.vertices);
                    const Points update = (localised(sub_mesh, expected) - positions).topRows(sub_mesh.n_vertices);
                    Points increments = Points::Zero(sub_mesh.n_vertices, 3);
                    const auto equations = system.assemble(positions, increments, neumann_time_step, workspace);
                    auto factor = system.factorise(equations, precision, memory, workspace.ldl);
                    REQUIRE(factor);
                    CHECK(factor->is_single() == (precision != Precision::Double));
                    CHECK(memory.taken() ==
                          (factor->is_single() ? system.factor_bytes<float>() : system.factor_bytes<double>()));
                    Points on_interface(system.n_interface(), 3);
                    system.condense(equations, *factor, on_interface);
                    largest = std::max(largest, on_interface.size() > 0 ? on_interface.cwiseAbs().maxCoeff() : 0.0);
                    for (Index i = 0; i < system.n_interface(); ++i)
                        on_interface.row(i) = update.row(sub_mesh.interface.vertices[i]);
                    system.back_substitute(*factor, on_interface, increments);
                    for (const Index v : std::span(system.unknowns()).first(system.n_interior()))
                        CHECK((increments.row(v) - update.row(v)).norm() < rounding * size);

                    // Once more, with what that has left.
                    for (Index i = 0; i < system.n_interface(); ++i)
                        increments.row(sub_mesh.interface.vertices[i]) = on_interface.row(i);
                    const auto left = system.assemble(positions, increments, neumann_time_step, workspace);
                    system.condense(left, *factor, on_interface);
                    for (Index i = 0; i < system.n_interface(); ++i) {
                        const Index v = sub_mesh.local_to_global[sub_mesh.interface.vertices[i]];
                        residuals.try_emplace(v, Point::Zero()).first->second += on_interface.row(i);
                    }
                    system.back_substitute(*factor, Points::Zero(system.n_interface(), 3), increments);
                    for (const Index v : system.unknowns())
                        CHECK((increments.row(v) - update.row(v)).norm() < 1e-9 * size);
                }
                CHECK(static_cast<Index>(residuals.size()) == decomposition.n_interface_vertices);
                for (const auto& [v, residual] : residuals)
                    CHECK(residual.norm() < 1e-8 * largest);
            }
    }
    CHECK(memory.taken() == 0);
}

TEST_CASE("where single precision would lose too many digits there is no factor, unless it is asked for")
{
    SolverWorkspace workspace;
    // One face as thin as a sliver: an edge a millionth as long as the others.
    CutMesh cut = cut_meshes().front();
    const Decomposition whole = test::decompose(cut);
    const SubMesh& sub_mesh = whole.sub_meshes.front();
    const NeumannSystem system(sub_mesh, sub_mesh.face_vertices, Laplacian::Fujiwara);
    Points positions = localised(sub_mesh, cut.mesh.vertices);
    const Points increments = Points::Zero(sub_mesh.n_vertices, 3);
    const auto is_factorised = [&](Precision precision) {
        const auto equations = system.assemble(positions, increments, neumann_time_step, workspace);
        return system.factorise(equations, precision, heap(), workspace.ldl).has_value();
    };
    CHECK(is_factorised(Precision::Automatic));
    const std::span<const Index> interior = std::span(system.unknowns()).first(system.n_interior());
    bool is_sliver = false;
    for (std::size_t i = 0; i < sub_mesh.face_vertices.values.size() && !is_sliver; ++i) {
        const Index v = sub_mesh.face_vertices.values[i];
        const Index w = sub_mesh.face_vertices.values[(i + 1) % sub_mesh.face_vertices.values.size()];
        const auto is_inside = [&](Index u) {
            return std::find(interior.begin(), interior.end(), u) != interior.end();
        };
        if (v == w || !is_inside(v) || !is_inside(w))
            continue;
        positions.row(w) = positions.row(v) + 1e-6 * (positions.row(w) - positions.row(v));
        is_sliver = true;
    }
    REQUIRE(is_sliver);
    CHECK_FALSE(is_factorised(Precision::Automatic));
    CHECK(is_factorised(Precision::Double));
}
