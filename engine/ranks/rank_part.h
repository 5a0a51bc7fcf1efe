#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/ranks/communicator.h"
#include "engine/ranks/dealt_mesh.h"
#include "engine/ranks/rank_exchange.h"
#include "engine/ranks/rank_message.h"
#include "engine/steppers/heat_stepper.h"
#include "engine/steppers/rank_sub_meshes.h"
#include "engine/steppers/sweep_stepper.h"
#include "engine/tasks/progress.h"

namespace seamflow {

/// The sub-meshes of one rank, and the stepper for them.
class RankPart {
  public:
    /// All ranks construct their parts together. @param comm, progress must outlive this.
    RankPart(Communicator& comm, DealtMesh dealt, Progress& progress);

    /// Serves a request of rank 0, as all ranks do together. @returns the answer.
    Bytes act(RankTask task, Unpacker& message);

    [[nodiscard]] const Stepper& stepper() const { return *stepper_; }

    /// One per row of the arrays that the stepper saves.
    [[nodiscard]] const std::vector<SavedRow>& saved_rows() const { return saved_; }

  private:
    void step();
    std::vector<Index> make_converged_stepper(const IterationStop& stop, RankSubMeshes sub_meshes, Progress& progress);
    std::vector<Index> make_sweep_stepper(const SweepSteps& sweeps, RankSubMeshes sub_meshes, Progress& progress);
    void report_to(Packer& answer) const;

    Communicator& comm_;
    DealtMesh dealt_;
    /// The number of threads, counted before steps: an arena of one thread reports another one as soon as messages have
    /// started tasks.
    int n_threads_;
    /// The number of messages sent in steps, and their bytes.
    std::uint64_t n_messages_ = 0;
    std::uint64_t n_bytes_ = 0;
    std::int64_t n_interface_vertices_ = 0;
    /// The local numbers of the vertices whose positions rank 0 gets from this rank.
    std::vector<Index> sent_vertices_;
    std::vector<SavedRow> saved_;
    /// Only for sweeps.
    std::optional<RankExchange> exchange_;
    std::unique_ptr<Stepper> stepper_;
    /// The same stepper, if its steps are converged; null if they are sweeps.
    HeatStepper* heat_ = nullptr;
    /// #V by 3: Vᵏ, during a step.
    Points before_ = Points(0, 3);
};

}  // namespace seamflow
