#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "engine/setup/sweep_plan.h"
#include "engine/tasks/task_graph.h"
#include "partition/decomposition/decomposition.h"
#include "partition/index.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// What a sub-mesh sends to other ranks in a sweep, each once.
enum class MessageKind : std::uint8_t {
    /// Vᵏ.
    Position,
    /// The sub-mesh's result with Γ held.
    Prediction,
    /// Vᵏ⁺¹ as solved.
    Solution,
};

/// The message that takes the place of a foreign sub-mesh's task. An own sub-mesh sends its position before the sweep,
/// and the others after these tasks.
constexpr MessageKind message_of(TaskKind kind)
{
    switch (kind) {
    case TaskKind::Predict:
        return MessageKind::Prediction;
    case TaskKind::Solve:
        return MessageKind::Solution;
    default:
        return MessageKind::Position;
    }
}

/// The sub-meshes around a sweep's own that belong to other ranks. Their tasks are events here: their results arrive
/// while the sweep runs. For this they have their own states, with those of their vertices that this rank knows.
class ForeignSubMeshes {
  public:
    ForeignSubMeshes() = default;
    ForeignSubMeshes(const ForeignSubMeshes&) = delete;
    ForeignSubMeshes& operator=(const ForeignSubMeshes&) = delete;
    virtual ~ForeignSubMeshes() = default;

    [[nodiscard]] virtual bool is_foreign(Index s) const = 0;

    /// Agrees with the other ranks on what to send; all do so together, once.
    /// @param sweeps their plans. @param further per sub-mesh, local indices of vertices whose positions and solutions
    ///        are needed besides those that sweeps read; or empty.
    virtual void connect(const Decomposition& decomposition, std::span<const SweepPlan> sweeps,
                         std::span<const std::vector<Index>> further) = 0;

    /// Whether data of this kind will arrive from a foreign sub-mesh.
    /// @param sweep the number of the plan: 0 forward, 1 backward.
    [[nodiscard]] virtual bool awaits(MessageKind kind, std::size_t sweep, Index s) const = 0;

    /// Sets the event that waits for the arrival.
    virtual void set_event(MessageKind kind, std::size_t sweep, Index s, TaskGraph::Node event) = 0;

    /// Copies what has arrived; called by the event.
    /// @param rows #local by 3, of the foreign sub-mesh.
    virtual void receive(MessageKind kind, Index s, Points& rows) = 0;

    /// Sends the rows of an own sub-mesh that other ranks need. Any thread may call it, during a run.
    virtual void send(MessageKind kind, std::size_t sweep, Index s, const Points& rows) = 0;

    /// Runs one sweep.
    /// @param begin called first, when messages of this run may be sent.
    virtual void run(TaskGraph& graph, std::size_t sweep, const std::function<void()>& begin,
                     const std::function<void()>& join) = 0;
};

}  // namespace seamflow
