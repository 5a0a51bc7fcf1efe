#include "engine/distributed/rank_memory.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// @throws InputError unless the state has vertices for the whole mesh, and as much as the stepper saves.
void require_fitting(const RankFlowState& state, std::span<const std::int64_t> numbers, std::int64_t n_vertices,
                     const StepMemory& saved)
{
    if (!numbers.empty() && numbers.back() >= n_vertices)
        throw InputError("the state to resume from has fewer vertices than the mesh");
    const auto has_rows = [&](const Points& array) { return array.rows() == state.vertices.rows(); };
    if (state.arrays.size() != saved.arrays.size() || state.numbers.size() != saved.numbers.size() ||
        !std::ranges::all_of(state.arrays, has_rows))
        throw InputError("the state to resume from belongs to steps of another kind");
}

}  // namespace

void collect_memory(Communicator& comm, const RankMesh& mesh, const Stepper& stepper, RankFlowState& state)
{
    StepMemory memory;
    stepper.save(memory);
    state.numbers = std::move(memory.numbers);
    std::vector<std::int64_t> numbers;
    for (const Index v : stepper.saved_vertices())
        numbers.push_back(mesh.part.vertex_numbers[v]);
    for (const Points& array : memory.arrays) {
        RankSlice range;
        range.vertices = Points::Zero(state.vertices.rows(), 3);
        collect_positions(comm, numbers, array, range);
        state.arrays.push_back(std::move(range.vertices));
    }
}

void restore_memory(Communicator& comm, const RankMesh& mesh, const RankFlowState& state, Stepper& stepper)
{
    RankSlice range;
    range.vertices = state.vertices;
    const SliceBounds bounds = gather_bounds(comm, range);
    const std::vector<std::int64_t>& numbers = mesh.part.vertex_numbers;
    StepMemory memory;
    stepper.save(memory);
    comm.look_together([&] { require_fitting(state, numbers, bounds.vertices.back(), memory); });
    memory = {
        .positions = fetch_positions(comm, range, numbers, bounds.vertices), .arrays = {}, .numbers = state.numbers};
    const std::vector<Index> vertices = stepper.saved_vertices();
    for (const Points& array : state.arrays) {
        range.vertices = array;
        memory.arrays.emplace_back(fetch_positions(comm, range, numbers, bounds.vertices)(vertices, Eigen::all));
    }
    comm.look_together([&] {
        if (!memory.positions.allFinite())
            throw InputError("the state to resume from has vertices that are not finite");
        stepper.restore(memory);
    });
}

}  // namespace seamflow
