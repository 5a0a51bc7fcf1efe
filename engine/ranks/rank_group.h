#pragma once

#include "engine/ranks/communicator.h"
#include "engine/ranks/transport.h"

namespace seamflow {

/// The ranks that share the steps of flows (see FlowControl::ranks), as rank 0 sees them: it runs each flow, with the
/// whole mesh, and the others have their sub-meshes of it and take their part in each step. They wait for it in
/// serve_flows. One flow at a time takes a step; a flow ends before the group does.
class RankGroup {
  public:
    /// All ranks begin together, the others in serve_flows.
    /// @param transport of rank 0, which must outlive this.
    explicit RankGroup(Transport& transport);
    RankGroup(const RankGroup&) = delete;
    RankGroup& operator=(const RankGroup&) = delete;

    /// Dismisses the others, with status 0, if that has not been done.
    ~RankGroup();

    [[nodiscard]] Communicator& comm() { return comm_; }
    [[nodiscard]] int size() const { return comm_.size(); }

    /// How many of the ranks, this one included, are on its machine.
    [[nodiscard]] int n_on_this_machine() const { return n_on_this_machine_; }

    /// The threads of each rank in what they share; 0, as at first: rank 0 has those of its flow, and each other one
    /// its part of those of its machine. The flow of rank 0 may have more: others wait while it works alone.
    void set_threads_of_each(int threads) { threads_of_each_ = threads; }
    [[nodiscard]] int threads_of_each() const { return threads_of_each_; }

    /// A number for a further flow.
    int add_flow() { return n_flows_++; }

    /// Ends the others, once: serve_flows returns this status there.
    void dismiss(int status);

  private:
    Communicator comm_;
    int n_on_this_machine_;
    int threads_of_each_ = 0;
    int n_flows_ = 0;
    bool has_dismissed_ = false;
};

/// Does what rank 0 asks for, on every other rank, and waits for it in between, which takes hardly any time of a
/// processor. What fails here is thrown there.
/// @param threads of the machine, which the ranks on it share if rank 0 does not say how many each has; 0: of all
/// cores.
/// @returns what rank 0 ends with.
int serve_flows(Transport& transport, int threads);

}  // namespace seamflow
