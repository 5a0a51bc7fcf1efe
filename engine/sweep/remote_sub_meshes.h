#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/sweep/sweep_plan.h"
#include "engine/tasks/task_graph.h"
#include "partition/decomposition/decomposition.h"
#include "partition/index.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The data that a sub-mesh sends to other ranks in a sweep, each kind once.
enum class MessageKind : std::uint8_t {
    /// Vᵏ.
    Position,
    /// The sub-mesh's result with Γ fixed.
    Prediction,
    /// Vᵏ⁺¹ as solved.
    Solution,
};

/// The message that replaces a task of a remote sub-mesh. An own sub-mesh sends its position before the sweep, and its
/// prediction and solution after these tasks.
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

/// The sub-meshes of other ranks around a sweep's own sub-meshes. In this rank's graph their tasks are events: their
/// results arrive while the sweep runs. Their states have the vertices that this rank knows.
class RemoteSubMeshes {
  public:
    RemoteSubMeshes() = default;
    RemoteSubMeshes(const RemoteSubMeshes&) = delete;
    RemoteSubMeshes& operator=(const RemoteSubMeshes&) = delete;
    virtual ~RemoteSubMeshes() = default;

    [[nodiscard]] virtual bool is_remote(Index s) const = 0;

    /// Exchanges with the other ranks which rows to send; all ranks call this together, once.
    /// @param sweeps the plans of the sweeps. @param further per sub-mesh, local indices of vertices whose positions
    ///        and solutions are needed besides those that sweeps read; or empty.
    virtual void connect(const Decomposition& decomposition, std::span<const SweepPlan> sweeps,
                         std::span<const std::vector<Index>> further) = 0;

    /// Whether a message of this kind will arrive from a remote sub-mesh.
    /// @param sweep the number of the plan: 0 forward, 1 backward.
    [[nodiscard]] virtual bool awaits(MessageKind kind, std::size_t sweep, Index s) const = 0;

    /// Sets the event that the arrival of the message starts.
    virtual void set_event(MessageKind kind, std::size_t sweep, Index s, TaskGraph::Node event) = 0;

    /// Copies the rows that have arrived; called by the event.
    /// @param rows #local by 3, of the remote sub-mesh.
    virtual void receive(MessageKind kind, Index s, Points& rows) = 0;

    /// Sends the rows of an own sub-mesh that other ranks need. Any thread may call this during a run.
    virtual void send(MessageKind kind, std::size_t sweep, Index s, const Points& rows) = 0;

    /// Runs one sweep.
    /// @param begin called before any task, when messages of this run may be sent. @param join called after all tasks.
    virtual void run(TaskGraph& graph, std::size_t sweep, const std::function<void()>& begin,
                     const std::function<void()>& join) = 0;
};

}  // namespace seamflow
