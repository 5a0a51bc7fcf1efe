#include "samples/runs/rank_checkpoints.h"

#include <filesystem>

#include <fmt/format.h>

namespace seamflow {

namespace {

FlowIdentity identity_of(Communicator& comm, const SmoothCommand& command, const RankRunInputs& inputs,
                         const RankSlice& slice)
{
    FlowOptions options = command.options;
    options.motion.fixed_vertices.assign(inputs.fixed.begin(), inputs.fixed.end());
    options.motion.attachment_weights = inputs.weights;
    options.motion.strength = inputs.strengths;
    // These do not change the result.
    options.report = {};
    FlowIdentity identity = identify(PolygonMesh{}, options);
    for (FlowIdentity::Entry& entry : identity.entries)
        if (entry.name == "mesh")
            entry.value = fmt::format("{} vertices and {} faces with checksum {:x}", inputs.size.vertices,
                                      inputs.size.faces, inputs.mesh);
    identity.entries.push_back({"cut", fmt::format("that with checksum {:x}", checksum_of_labels(comm, slice))});
    return identity;
}

}  // namespace

RankCheckpoints::RankCheckpoints(Communicator& comm, const SmoothCommand& command, const RankRunInputs& inputs,
                                 const RankSlice& slice)
    : period_(command.checkpoint_period)
    , steps_(command.options.steps)
    , checkpoint_(command.checkpoint, identity_of(comm, command, inputs, slice))
{
}

std::optional<RankFlowState> RankCheckpoints::find(Communicator& comm, std::span<const std::int64_t> bounds) const
{
    return checkpoint_.find(comm, bounds, steps_);
}

void RankCheckpoints::keep(const RankStepState& state, const Points& vertices)
{
    const std::uint8_t is_due = since_kept_.seconds() >= period_.seconds ? 1 : 0;
    const bool is_kept = state.comm.broadcast(std::vector<std::uint8_t>{is_due}).front() != 0;
    if (state.step != steps_ && (state.step % period_.steps != 0 || !is_kept))
        return;
    checkpoint_.keep(state.comm, state.capture(vertices));
    since_kept_.lap();
}

}  // namespace seamflow
