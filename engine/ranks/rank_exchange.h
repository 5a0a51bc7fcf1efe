#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/ranks/communicator.h"
#include "engine/ranks/dealt_mesh.h"
#include "engine/sweep/remote_sub_meshes.h"
#include "engine/sweep/sweep_plan.h"
#include "engine/tasks/task_graph.h"
#include "partition/decomposition/decomposition.h"

namespace seamflow {

/// Exchanges data of sub-meshes between ranks while a sweep runs: one message for each sub-mesh, kind of message and
/// rank that waits for it. A separate thread receives messages, and starts the tasks that wait for them.
class RankExchange final : public RemoteSubMeshes {
  public:
    /// @param comm, dealt must outlive this.
    RankExchange(Communicator& comm, const DealtMesh& dealt);

    [[nodiscard]] bool is_remote(Index s) const override { return holder(s) != comm_->rank(); }
    void connect(const Decomposition& decomposition, std::span<const SweepPlan> sweeps,
                 std::span<const std::vector<Index>> further) override;
    [[nodiscard]] bool awaits(MessageKind kind, std::size_t sweep, Index s) const override;
    void set_event(MessageKind kind, std::size_t sweep, Index s, TaskGraph::Node event) override;
    void receive(MessageKind kind, Index s, Points& rows) override;
    void send(MessageKind kind, std::size_t sweep, Index s, const Points& rows) override;
    void run(TaskGraph& graph, std::size_t sweep, const std::function<void()>& begin,
             const std::function<void()>& join) override;

  private:
    static constexpr std::size_t n_kinds = 3;
    static std::size_t index_of(MessageKind kind) { return static_cast<std::size_t>(kind); }
    /// The rank of a known sub-mesh.
    [[nodiscard]] int holder(Index s) const { return dealt_->holders[dealt_->known[s]]; }

    /// The rows of a sub-mesh that a rank needs, as local indices for each kind of message; and whether the rank uses
    /// its prediction in each sweep.
    struct Interest {
        int rank = -1;
        std::array<std::vector<Index>, n_kinds> rows;
        std::vector<std::uint8_t> predicts;

        /// Whether the rank needs a message of this kind in a sweep.
        [[nodiscard]] bool includes(MessageKind kind, std::size_t sweep) const
        {
            return !rows[index_of(kind)].empty() && (kind != MessageKind::Prediction || predicts[sweep] != 0);
        }
    };
    /// A message that is to arrive in a sweep.
    struct PendingMessage {
        MessageKind kind;
        Index sub_mesh;
        TaskGraph::Node event;
        bool has_come;
    };

    void find_own_interest(const Decomposition& decomposition, std::span<const SweepPlan> sweeps,
                           std::span<const std::vector<Index>> further);
    void receive_all(TaskGraph& graph, std::vector<PendingMessage>& pending);
    void deliver(Message message, TaskGraph& graph, std::vector<PendingMessage>& pending);
    [[nodiscard]] Index known_index(Index number) const;

    Communicator* comm_;
    const DealtMesh* dealt_;
    /// Per remote sub-mesh: the rows that this rank needs.
    std::vector<Interest> own_interest_;
    /// Per own sub-mesh: the rows that other ranks need, one entry for each of these ranks.
    std::vector<std::vector<Interest>> listeners_;
    /// Per sweep: the messages that will arrive.
    std::vector<std::vector<PendingMessage>> pending_;
    /// Per kind of message and remote sub-mesh: the bytes that have arrived in this run.
    std::array<std::vector<Bytes>, n_kinds> mail_;
    /// The number of this run; and messages of later runs, which have arrived early.
    std::uint64_t run_ = 0;
    std::vector<Message> early_;
};

}  // namespace seamflow
