#include <algorithm>
#include <cstdint>
#include <cstring>

#include <doctest/doctest.h>

#include "partition/decomposition/sweep_plan.h"
#include "solvers/direct/factor_memory.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/systems/sub_mesh_system.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;

namespace {

/// The heap, counted.
class CountedMemory final : public FactorMemory {
  public:
    std::span<std::byte> take(std::size_t bytes) override
    {
        ++n_takes;
        n_live += 1;
        most_bytes = std::max(most_bytes, bytes);
        return heap_memory().take(bytes);
    }

    void give_back(std::span<std::byte> memory) override
    {
        n_live -= 1;
        heap_memory().give_back(memory);
    }

    int n_takes = 0;
    int n_live = 0;
    std::size_t most_bytes = 0;
};

}  // namespace

TEST_CASE("the heap gives every factor memory of its own, fit for doubles")
{
    const auto a = heap_memory().take(1000);
    const auto b = heap_memory().take(1000);
    for (const auto& memory : {a, b}) {
        CHECK(memory.size() >= 1000);
        CHECK(reinterpret_cast<std::uintptr_t>(memory.data()) % alignof(double) == 0);
    }
    std::memset(a.data(), 1, a.size());
    std::memset(b.data(), 2, b.size());
    CHECK(static_cast<int>(a.front()) == 1);
    CHECK(static_cast<int>(a.back()) == 1);
    heap_memory().give_back(a);
    heap_memory().give_back(b);
}

TEST_CASE("kept memory is the same, factor after factor, until one needs more")
{
    KeptMemory memory;
    const auto first = memory.take(1000);
    CHECK(first.size() == 1000);
    memory.give_back(first);
    CHECK(memory.take(500).data() == first.data());
    const auto larger = memory.take(4000);
    CHECK(larger.size() == 4000);
    CHECK(reinterpret_cast<std::uintptr_t>(larger.data()) % alignof(double) == 0);
}

TEST_CASE(
    "a system takes memory for its factor when it factorises, no more than it says, and gives it back when solved")
{
    for (const test::CutMesh& cut : test::cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        const SubMesh& sub_mesh = decomposition.sub_meshes.front();
        CountedMemory memory;
        SolverWorkspace workspace;
        workspace.factors = &memory;
        const auto system = make_predicted_system(sub_mesh, Laplacian::Fujiwara, workspace);
        const Points positions = test::localised(sub_mesh, cut.mesh.vertices);
        const std::vector<InterfaceRole> roles(sub_mesh.interface.vertices.size(), InterfaceRole::Follows);
        CHECK(memory.n_takes == 0);
        for (int step = 1; step <= 2; ++step) {
            Points solution = positions;
            system->assemble(positions, positions, 0.001, 1.0, roles, workspace);
            system->factorise(workspace);
            CHECK(memory.n_live == 1);
            system->predict(positions, solution, workspace);
            CHECK(memory.n_live == 1);
            solution = positions;
            system->solve(positions, solution, workspace);
            CHECK(memory.n_live == 0);
            CHECK(memory.n_takes == step);
        }
        CHECK(memory.most_bytes > 0);
        CHECK(memory.most_bytes <= system->factor_bytes());
    }
}
