#pragma once

#include <memory>
#include <vector>

#include "engine/options/flow_control.h"
#include "engine/ranks/transport.h"

namespace seamflow {

class Communicator;

/// The ranks that share the steps of flows (see FlowControl::ranks), as rank 0 sees them: rank 0 runs each flow, with
/// the whole mesh, and the others have sub-meshes of the flow and do their part of each step. Between steps the others
/// wait for rank 0 in serve_flows. One flow at a time takes a step; a flow ends before the group does.
class RankGroup final : public StepSharing {
  public:
    /// All ranks begin together, the other ranks in serve_flows.
    /// @param transport of rank 0, which must outlive this.
    explicit RankGroup(Transport& transport);

    /// Dismisses the other ranks, with status 0, if `dismiss` has not been called.
    ~RankGroup() override;

    [[nodiscard]] Communicator& comm() { return *comm_; }
    [[nodiscard]] int size() const { return size_; }

    /// The number of ranks, this one included, on the machine of rank 0.
    [[nodiscard]] int n_on_this_machine() const { return n_on_this_machine_; }

    /// Sets the number of threads of each rank in shared work. 0, the default: rank 0 has those of its flow, and each
    /// other rank its share of the threads of its machine. The flow of rank 0 may have more threads: other ranks wait
    /// while it works alone.
    void set_threads_of_each(int threads) { threads_of_each_ = threads; }
    [[nodiscard]] int threads_of_each() const { return threads_of_each_; }

    /// Whether the ranks can share the steps: there are several ranks and several sub-meshes, no schedule is recorded,
    /// and steps are sweeps with one copy of Γ and without overlap, or converged steps. Rank 0 takes all other steps
    /// alone.
    [[nodiscard]] bool can_share(const FlowPlan& plan, const StepSettings& settings) const override;
    /// Makes a RankStepper, which shares its steps among all ranks.
    std::unique_ptr<HeatStepper> make_stepper(const PolygonMesh& mesh, const Topology& topology, const FlowPlan& plan,
                                              const StepSettings& settings, std::vector<double> curvature,
                                              Progress& progress) override;

    /// Returns a number for a further flow.
    int add_flow() { return n_flows_++; }

    /// Ends the other ranks: serve_flows returns this status there. To be called once.
    void dismiss(int status);

  private:
    std::unique_ptr<Communicator> comm_;
    int size_;
    int n_on_this_machine_;
    int threads_of_each_ = 0;
    int n_flows_ = 0;
    bool has_dismissed_ = false;
};

/// Serves the requests of rank 0 on another rank, and waits between them, which takes hardly any processor time.
/// Failures of this rank are thrown on rank 0.
/// @param threads the threads of the machine, which its ranks share if rank 0 does not set a number for each; 0: one
/// per core.
/// @returns the status with which rank 0 ends the ranks.
int serve_flows(Transport& transport, int threads);

}  // namespace seamflow
