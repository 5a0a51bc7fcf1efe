#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "engine/ranks/rank_group.h"
#include "engine/ranks/rank_part.h"
#include "engine/setup/flow_plan.h"
#include "engine/steppers/heat_stepper.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/workers.h"
#include "partition/topology.h"

namespace seamflow {

/// Takes steps in sub-meshes that are dealt to ranks. Each rank, rank 0 included, has a stepper for its own sub-meshes;
/// ranks exchange the data that cross Γ. The bits are those of a single process, on any number of ranks. Positions are
/// sent to rank 0 only when it asks for them.
class RankStepper final : public HeatStepper {
  public:
    /// Deals the sub-meshes.
    /// @param ranks, progress must outlive the stepper; ranks.can_share(plan, settings) is true.
    /// @param curvature #V: ‖ΔV⁰‖, in 1/length; empty: as if it were 0.
    /// @throws as make_stepper, on the lowest rank that fails.
    RankStepper(RankGroup& ranks, const PolygonMesh& mesh, const Topology& topology, const FlowPlan& plan,
                const StepSettings& settings, std::vector<double> curvature, Progress& progress);
    ~RankStepper() override;

    /// @param before equal to positions().
    void step(const Points& before) override;
    [[nodiscard]] const Points& positions() const override;
    void set_positions(const Points& image, const SimilarityOfComponents& similarity) override;
    void set_data(const Points& data, DataSteps steps) override;
    void set_vertices(std::span<const Index> vertices, const Points& to) override;
    void save(StepMemory& memory) const override;
    void restore(const StepMemory& memory) override;
    void add_seconds(PhaseSeconds& seconds) const override;
    void report_to(StepReport& report) const override;
    void report_to(FlowReport& report) const override;

  private:
    /// Appends data to the message for a rank.
    using Put = std::function<void(int rank, Packer& message)>;

    void deal(const PolygonMesh& mesh, const Topology& topology, const FlowPlan& plan, const StepSettings& settings,
              std::vector<double> curvature, Progress& progress);
    void number_saved_rows(const std::vector<std::vector<SavedRow>>& of_ranks, const std::vector<Index>& holders);
    void in_own_threads(const std::function<void()>& work) const;
    std::vector<Bytes> ask(RankTask task, const Put& put = {}) const;

    RankGroup* ranks_;
    int flow_;
    Index n_sub_meshes_;
    /// The threads of rank 0 in shared work; null: all threads of the flow.
    std::unique_ptr<Workers> threads_;
    std::unique_ptr<RankPart> own_;
    /// Per rank: the vertices that it knows; the vertices whose positions it sends; and the numbers of its sub-meshes.
    std::vector<std::vector<Index>> known_vertices_;
    std::vector<std::vector<Index>> sent_vertices_;
    std::vector<std::vector<Index>> sub_meshes_;
    /// Per rank: the index of each row that its stepper saves among the saved rows of all ranks.
    std::vector<std::vector<Index>> saved_rows_;
    /// Per rank and saved row: 1 if the row is taken from this rank, as several ranks may save it.
    std::vector<std::vector<std::uint8_t>> is_used_;
    /// The number of different rows that the steppers of all ranks save.
    Index n_saved_ = 0;
    /// #V by 3: the positions; and whether they are those that the ranks have.
    mutable Points positions_;
    mutable bool are_current_ = true;
};

}  // namespace seamflow
