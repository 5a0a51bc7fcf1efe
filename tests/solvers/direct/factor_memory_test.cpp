#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "solvers/direct/factor_memory.h"
#include "solvers/systems/interface_role.h"
#include "solvers/systems/sub_mesh_system.h"
#include "tests/support/cut_meshes.h"

using namespace seamflow;

namespace {

/// The heap, counted.
class CountedMemory final : public FactorMemory {
  public:
    int n_takes = 0;
    int n_live = 0;
    std::size_t most_bytes = 0;

  private:
    void* do_allocate(std::size_t bytes, std::size_t alignment) override
    {
        ++n_takes;
        ++n_live;
        most_bytes = std::max(most_bytes, bytes);
        return std::pmr::new_delete_resource()->allocate(bytes, alignment);
    }
    void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override
    {
        --n_live;
        std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
    }
    [[nodiscard]] bool do_is_equal(const FactorMemory& other) const noexcept override { return this == &other; }
};

}  // namespace

TEST_CASE("numbers go back when they die, and no numbers take no memory")
{
    CountedMemory memory;
    {
        auto a = take_numbers<double>(memory, 1000);
        const auto b = take_numbers<double>(memory, 10);
        const auto none = take_numbers<double>(memory, 0);
        CHECK(memory.n_live == 2);
        const auto moved = std::move(a);
        CHECK(memory.n_live == 2);
    }
    CHECK(memory.n_takes == 2);
    CHECK(memory.n_live == 0);
}

TEST_CASE("a pool grows to what is taken at once, and no further")
{
    FactorPool pool(100);
    CHECK(pool.bytes() == 0);
    for (int round = 0; round < 3; ++round) {
        std::vector<FactorNumbers<std::byte>> taken;
        for (const std::size_t bytes : {100U, 1U, 37U, 100U})
            taken.push_back(take_numbers<std::byte>(pool, bytes));
        taken.clear();
        CHECK(pool.bytes() == 400);
    }
}

TEST_CASE("without a least size, blocks fit what is taken, and are used again for the same")
{
    FactorPool pool;
    for (int round = 0; round < 3; ++round) {
        const auto large = take_numbers<std::byte>(pool, 4000);
        const auto small = take_numbers<std::byte>(pool, 500);
        const auto another = take_numbers<std::byte>(pool, 500);
        CHECK(small.get() != another.get());
        CHECK(pool.bytes() == 5000);
    }
}

TEST_CASE("blocks that are taken at the same time are apart and fit for doubles, and the last one back is the next")
{
    FactorPool pool(64);
    std::vector<FactorNumbers<std::byte>> taken;
    for (int i = 0; i < 10; ++i) {
        taken.push_back(take_numbers<std::byte>(pool, 64));
        CHECK(reinterpret_cast<std::uintptr_t>(taken.back().get()) % alignof(double) == 0);
    }
    std::sort(taken.begin(), taken.end());
    for (std::size_t i = 1; i < taken.size(); ++i)
        CHECK(taken[i - 1].get() + 64 <= taken[i].get());
    const std::byte* const third = taken[3].get();
    const std::byte* const seventh = taken[7].get();
    taken[3].reset();
    taken[7].reset();
    const auto first_taken = take_numbers<std::byte>(pool, 8);
    CHECK(first_taken.get() == seventh);
    CHECK(take_numbers<std::byte>(pool, 8).get() == third);
}

TEST_CASE("blocks of many sizes are apart and fit for every number")
{
    FactorPool pool;
    std::vector<FactorNumbers<std::byte>> taken;
    std::size_t bytes = 0;
    for (std::size_t size = 1; size < 3'000'000; size += 1 + size / 5) {
        taken.push_back(take_numbers<std::byte>(pool, size));
        bytes += size;
        CHECK(reinterpret_cast<std::uintptr_t>(taken.back().get()) % alignof(std::max_align_t) == 0);
        std::fill_n(taken.back().get(), size, static_cast<std::byte>(taken.size()));
    }
    CHECK(pool.bytes() == bytes);
    for (std::size_t i = 0; i < taken.size(); ++i) {
        const std::byte* const begin = taken[i].get();
        CHECK(std::all_of(begin, begin + taken[i].get_deleter().n,
                          [&](std::byte b) { return b == static_cast<std::byte>(i + 1); }));
    }
}

TEST_CASE("a system takes memory for its factor when it factorises, no more than it says, and the factor gives it back")
{
    for (const test::CutMesh& cut : test::cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        const SubMesh& sub_mesh = decomposition.sub_meshes.front();
        CountedMemory memory;
        SolverWorkspace workspace;
        const auto system = make_predicted_system({sub_mesh, sub_mesh.twin, Laplacian::Fujiwara}, workspace);
        const Points positions = test::localised(sub_mesh, cut.mesh.vertices);
        const std::vector<InterfaceRole> roles(sub_mesh.interface.vertices.size(), InterfaceRole::Follows);
        CHECK(memory.n_takes == 0);
        for (int step = 1; step <= 2; ++step) {
            Points solution = positions;
            const auto equations = system->assemble(positions, positions, 0.001, 1.0, roles, workspace);
            {
                const auto factor = system->factorise(equations, memory, workspace);
                CHECK(memory.n_live == 1);
                system->solve(factor, positions, solution, workspace);
                CHECK(memory.n_live == 1);
            }
            CHECK(memory.n_live == 0);
            CHECK(memory.n_takes == step);
        }
        CHECK(memory.most_bytes > 0);
        CHECK(memory.most_bytes <= system->factor_bytes());
    }
}
