#include "engine/sweep/sweep_graph.h"

#include <algorithm>
#include <cassert>

namespace seamflow {

namespace {

using Node = TaskGraph::Node;

/// Whether sub-mesh s takes over values of Γ that sub-mesh `leader` has solved.
[[maybe_unused]] bool follows(const SweepPlan& plan, Index s, Index leader)
{
    return std::ranges::any_of(plan.traces[s], [&](const Transfer& trace) { return trace.from == leader; });
}

/// Adds the tasks of one kind after the other, each with its dependencies.
class SweepBuilder {
  public:
    SweepBuilder(TaskGraph& graph, const PerformTask& perform, std::size_t sweep, const SweepPlan& plan,
                 const std::vector<std::vector<Index>>& adjacency, RemoteSubMeshes* remote)
        : graph_(graph)
        , perform_(perform)
        , sweep_(sweep)
        , plan_(plan)
        , adjacency_(adjacency)
        , remote_(remote)
        , root_(graph.add_root())
    {
    }

    void build(const FactorWindow& window, bool predicts)
    {
        add_factorisations_and_solves();
        if (remote_ != nullptr)
            wait_for_positions();
        wait_for_room(window);
        wait_for_traces();
        if (predicts)
            add_predictions();
        add_acceptances();
    }

  private:
    [[nodiscard]] bool is_remote(Index s) const { return remote_ != nullptr && remote_->is_remote(s); }

    Node add_task(TaskKind kind, Index s)
    {
        return graph_.add_task([perform = perform_, kind, s] { perform(kind, s); }, {kind, s});
    }

    /// Adds the arrival of the result of a remote sub-mesh's task; returns -1 if nothing waits for it.
    Node add_arrival(TaskKind kind, Index s)
    {
        if (!remote_->awaits(message_of(kind), sweep_, s))
            return -1;
        const Node event = graph_.add_event([perform = perform_, kind, s] { perform(kind, s); }, {kind, s});
        graph_.add_dependency(root_, event);
        remote_->set_event(message_of(kind), sweep_, s, event);
        return event;
    }

    [[nodiscard]] Index n_sub_meshes() const { return static_cast<Index>(adjacency_.size()); }

    /// Adds assembly with factorisation, and solve, of own sub-meshes; and the arrivals of positions and solutions of
    /// remote ones.
    void add_factorisations_and_solves()
    {
        for (Index s = 0; s < n_sub_meshes(); ++s) {
            if (is_remote(s)) {
                factorised_.push_back(add_arrival(TaskKind::AssembleAndFactorise, s));
                solved_.push_back(add_arrival(TaskKind::Solve, s));
                continue;
            }
            factorised_.push_back(add_task(TaskKind::AssembleAndFactorise, s));
            solved_.push_back(add_task(TaskKind::Solve, s));
            graph_.add_dependency(root_, factorised_.back());
            graph_.add_dependency(factorised_.back(), solved_.back());
        }
    }

    /// Makes the assembly of each own sub-mesh wait for the positions of adjacent sub-meshes of other ranks.
    void wait_for_positions()
    {
        for (Index s = 0; s < n_sub_meshes(); ++s)
            for (const Index neighbour : adjacency_[s])
                if (is_remote(neighbour) && factorised_[neighbour] >= 0)
                    graph_.add_dependency(factorised_[neighbour], factorised_[s]);
    }

    /// Makes factorisations wait until an earlier factor is freed.
    void wait_for_room(const FactorWindow& window)
    {
        for (std::size_t i = 0; i + usize(window.size) < window.order.size(); ++i)
            graph_.add_dependency(solved_[window.freed[i]], factorised_[window.order[i + usize(window.size)]]);
    }

    /// Makes the solve of each sub-mesh wait for the sub-meshes whose Vᵏ⁺¹ it takes.
    void wait_for_traces()
    {
        for (std::size_t s = 0; s < solved_.size(); ++s) {
            for (const Transfer& trace : plan_.traces[s])
                graph_.add_dependency(solved_[trace.from], solved_[s]);
            for (const Transfer& copies : plan_.copies[s])
                if (plan_.stage[copies.from] < plan_.stage[s])
                    graph_.add_dependency(solved_[copies.from], solved_[s]);
        }
    }

    /// Adds a prediction, between factorisation and solve, for every sub-mesh that follows another; and a task of the
    /// leading sub-mesh that reads it.
    void add_predictions()
    {
        std::vector<Node> predicted(solved_.size(), -1);
        for (Index s = 0; s < n_sub_meshes(); ++s) {
            if (is_remote(s))
                predicted[s] = add_arrival(TaskKind::Predict, s);
            if (is_remote(s) || plan_.traces[s].empty())
                continue;
            predicted[s] = add_task(TaskKind::Predict, s);
            graph_.add_dependency(factorised_[s], predicted[s]);
            graph_.add_dependency(predicted[s], solved_[s]);
        }
        for (Index s = 0; s < n_sub_meshes(); ++s) {
            if (plan_.predictions[s].empty())
                continue;
            const Node used = add_task(TaskKind::UsePredictions, s);
            graph_.add_dependency(factorised_[s], used);
            graph_.add_dependency(used, solved_[s]);
            if (predicted[s] >= 0)
                graph_.add_dependency(predicted[s], used);
            for (const Transfer& prediction : plan_.predictions[s]) {
                // The predicting sub-mesh follows here: its solve waits for that of s, and so for this task. The
                // arrival of its solution from another rank is made to wait, too.
                graph_.add_dependency(predicted[prediction.from], used);
                if (is_remote(prediction.from))
                    graph_.add_dependency(used, solved_[prediction.from]);
                else
                    assert(follows(plan_, prediction.from, s));
            }
        }
    }

    /// Adds the tasks that accept Vᵏ⁺¹: each waits until its sub-mesh and all adjacent ones have solved.
    void add_acceptances()
    {
        for (Index s = 0; s < n_sub_meshes(); ++s) {
            if (is_remote(s))
                continue;
            const Node accepted = add_task(TaskKind::Accept, s);
            graph_.add_dependency(solved_[s], accepted);
            for (const Index neighbour : adjacency_[s])
                if (solved_[neighbour] >= 0)
                    graph_.add_dependency(solved_[neighbour], accepted);
        }
    }

    TaskGraph& graph_;
    const PerformTask& perform_;
    std::size_t sweep_;
    const SweepPlan& plan_;
    const std::vector<std::vector<Index>>& adjacency_;
    RemoteSubMeshes* remote_;
    Node root_;
    std::vector<Node> factorised_;
    std::vector<Node> solved_;
};

}  // namespace

void add_sweep(TaskGraph& graph, const PerformTask& perform, std::size_t sweep, const SweepPlan& plan,
               const std::vector<std::vector<Index>>& adjacency, const FactorWindow& window, bool predicts,
               RemoteSubMeshes* remote)
{
    SweepBuilder(graph, perform, sweep, plan, adjacency, remote).build(window, predicts);
}

}  // namespace seamflow
