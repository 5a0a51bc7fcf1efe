#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/ranks/communicator.h"
#include "engine/ranks/dealt_mesh.h"
#include "engine/setup/sweep_plan.h"
#include "engine/steppers/foreign_sub_meshes.h"
#include "engine/tasks/step_graph.h"
#include "partition/decomposition/decomposition.h"

namespace seamflow {

/// A sub-mesh that a rank knows, whole or in part.
struct KnownSubMesh {
    /// Its number in the whole mesh.
    Index number = 0;
    /// Its owner.
    int rank = 0;
    Index n_vertices = 0;
    /// One of its faces, as numbered in the whole mesh.
    std::array<Index, 1> faces{};
};

/// Those of a dealt mesh.
std::vector<KnownSubMesh> known_sub_meshes(const DealtMesh& dealt, const Decomposition& decomposition);

/// Exchanges data of sub-meshes between ranks while a sweep runs: one message for each sub-mesh, kind of news and rank
/// that waits for it. A separate thread receives them, and starts the tasks that waited.
class RankExchange final : public ForeignSubMeshes {
  public:
    /// @param comm, vertex_numbers the vertices that the rank knows, as in the whole mesh; both must outlive this.
    /// @param known all sub-meshes that the rank knows, ascending.
    RankExchange(Communicator& comm, const std::vector<Index>& vertex_numbers, std::vector<KnownSubMesh> known);

    [[nodiscard]] bool is_foreign(Index s) const override { return known_[s].rank != comm_->rank(); }
    void connect(const Decomposition& decomposition, std::span<const SweepPlan> sweeps,
                 std::span<const std::vector<Index>> further) override;
    [[nodiscard]] bool awaits(News news, std::size_t sweep, Index s) const override;
    void set_event(News news, std::size_t sweep, Index s, StepGraph::Node event) override;
    void receive(News news, Index s, Points& rows) override;
    void send(News news, std::size_t sweep, Index s, const Points& rows) override;
    void run(StepGraph& graph, std::size_t sweep, const std::function<void()>& begin,
             const std::function<void()>& join) override;
    void run_for(Index s, const std::function<void()>& body) const override;

  private:
    static constexpr std::size_t n_kinds = 3;
    static std::size_t kind(News news) { return static_cast<std::size_t>(news); }

    /// What a rank needs of a sub-mesh: the local rows for each kind of news, and whether the sub-mesh predicts for it
    /// in each sweep.
    struct Interest {
        int rank = -1;
        std::array<std::vector<Index>, n_kinds> rows;
        std::vector<std::uint8_t> predicts;

        [[nodiscard]] bool includes(News news, std::size_t sweep) const
        {
            return !rows[kind(news)].empty() && (news != News::Prediction || predicts[sweep] != 0);
        }
    };
    /// Data that is to arrive in a sweep.
    struct Arrival {
        News news;
        Index sub_mesh;
        StepGraph::Node event;
        bool has_come;
    };

    void find_own_interest(const Decomposition& decomposition, std::span<const SweepPlan> sweeps,
                           std::span<const std::vector<Index>> further);
    void receive_all(StepGraph& graph, std::vector<Arrival>& arrivals);
    void deliver(Message message, StepGraph& graph, std::vector<Arrival>& arrivals);
    [[nodiscard]] Index known_index(Index number) const;

    Communicator* comm_;
    const std::vector<Index>* vertex_numbers_;
    std::vector<KnownSubMesh> known_;
    /// Per foreign sub-mesh, what this rank needs; per own one, what others need.
    std::vector<Interest> own_interest_;
    std::vector<std::vector<Interest>> listeners_;
    /// Per sweep.
    std::vector<std::vector<Arrival>> arrivals_;
    /// Per kind of news and foreign sub-mesh: what has arrived in this run.
    std::array<std::vector<Bytes>, n_kinds> mail_;
    /// The number of this run; and messages for later ones.
    std::uint64_t run_ = 0;
    std::vector<Message> early_;
};

}  // namespace seamflow
