#include "engine/distributed/distributed_flow.h"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/rank_components.h"
#include "engine/distributed/rank_exchange.h"
#include "engine/distributed/rank_memory.h"
#include "engine/distributed/rank_meter.h"
#include "engine/distributed/rank_options.h"
#include "engine/distributed/rank_setup.h"
#include "engine/distributed/ranks/communicator.h"
#include "engine/distributed/rows_of_others.h"
#include "engine/measure/displacement_bound.h"
#include "engine/measure/origin_offset.h"
#include "engine/measure/remarks.h"
#include "engine/measure/update_limit.h"
#include "engine/options/flow_control.h"
#include "engine/options/option_table.h"
#include "engine/options/valid_options.h"
#include "engine/setup/automatic_choices.h"
#include "engine/steppers/directed_motion.h"
#include "engine/steppers/schur_stepper.h"
#include "engine/steppers/sweep_stepper.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// Only vertices of own faces have moved.
void require_within_limit(const UpdateLimit& limit, const RankMesh& mesh, const Points& after)
{
    const auto excess = limit.find(mesh.part.mesh.vertices, after);
    if (!excess)
        return;
    const auto corners = mesh.topology.corners_at(excess->vertex);
    const Index label = mesh.part.labels[mesh.topology.face_of[corners.front()]];
    throw ComputationError(too_far(
        fmt::format("sub-mesh {}, vertex {}", mesh.known[label].number, mesh.part.vertex_numbers[excess->vertex]),
        excess->what));
}

template <class Body>
void in_step(int step, Body&& body)
{
    try {
        body();
    } catch (const ComputationError& error) {
        throw ComputationError(fmt::format("step {}, {}", step, error.what()));
    }
}

/// A distributed flow on one rank.
class RankFlow {
  public:
    RankFlow(Communicator& comm, MeshPart& part, const FlowOptions& options, const RankObserver& on_step,
             const RankFlowState* resume)
        : comm_(comm)
        , part_(part)
        , options_(completed(options, part))
        , on_step_(on_step)
        , resume_(resume)
        , progress_(control_)
    {
    }

    /// @returns #V by 3: the positions of the part after all steps.
    Points run(RankReport& report)
    {
        const Stopwatch watch;
        const BoundingBox box = gather_box(comm_, part_.mesh);
        const Point offset = origin_offset(part_.box.value_or(box));
        require_valid(options_);
        RankMesh mesh = make_rank_mesh(comm_, part_, offset, options_);
        options_.motion.attachment_weights = mesh.part.attachment_weights;
        options_.motion.strength = mesh.part.strengths;
        Decomposition decomposition = decompose_rank_mesh(mesh);
        const std::int64_t n_interface_vertices = decomposition.n_interface_vertices;
        std::optional<RankExchange> exchange;
        std::unique_ptr<Stepper> stepper;
        if (options_.accuracy.tolerance) {
            stepper = std::make_unique<SchurStepper>(
                mesh.part.mesh, make_peer_sub_meshes(comm_, mesh, std::move(decomposition)), options_, progress_);
        } else {
            exchange.emplace(comm_, mesh.part, mesh.known);
            stepper = std::make_unique<SweepStepper>(
                mesh.part.mesh, make_rank_sub_meshes(comm_, mesh, std::move(decomposition), options_, *exchange),
                options_, progress_);
        }
        const UpdateLimit limit(mesh.part.mesh, (box.high - box.low).stableNorm(), options_.accuracy.largest_update);
        if (options_.report.measures) {
            meter_.emplace(comm_, mesh);
            report.before = meter_->measure(mesh.part.mesh.vertices, mesh.part.mesh.vertices);
        }
        if (options_.motion.within)
            bound_.emplace(make_bound(mesh));
        if (options_.motion.direction.kind != MotionDirection::Kind::Any)
            prepare_direction(mesh);
        vanishing_.emplace(options_, mesh.part.mesh.vertices, find_small_components(comm_, mesh));
        result_ = mesh.part.mesh.vertices;
        if (resume_ != nullptr)
            resume(mesh, *stepper);
        report.after = report.before;
        if (meter_ && resume_ != nullptr)
            report.after = meter_->measure(result_, result_);
        report.flow.seconds.analyse = watch.seconds();
        for (int step = resume_ != nullptr ? resume_->step + 1 : 1; step <= options_.steps; ++step) {
            take_step(step, mesh, limit, *stepper, report);
            if (on_step_)
                show(step, report.flow.steps.back(), mesh, offset, *stepper);
        }
        report.flow.seconds.total = watch.seconds();
        report.vertices = part_.mesh.n_vertices();
        report.foreign_vertices = std::max(mesh.part.mesh.n_vertices() - report.vertices, 0);
        describe(mesh, n_interface_vertices, *stepper, report.flow);
        return positions_of_part(mesh, result_, offset);
    }

  private:
    /// Moves the vertices that this rank knows to where they were after a step.
    void resume(RankMesh& mesh, Stepper& stepper)
    {
        restore_memory(comm_, mesh, *resume_, stepper);
        mesh.part.mesh.vertices = stepper.positions();
        make_result(mesh);
    }

    /// Shows the part as it is now. Its initial positions are restored even if the observer throws.
    void show(int step, const StepReport& report, const RankMesh& mesh, const Point& offset, const Stepper& stepper)
    {
        Points positions = positions_of_part(mesh, result_, offset);
        part_.mesh.vertices.swap(positions);
        try {
            on_step_({step, report, part_, comm_,
                      [&](const Points& vertices) { return capture(mesh, step, vertices, stepper); }});
        } catch (...) {
            part_.mesh.vertices.swap(positions);
            throw;
        }
        part_.mesh.vertices.swap(positions);
    }

    /// All ranks call this together.
    [[nodiscard]] RankFlowState capture(const RankMesh& mesh, int step, const Points& vertices, const Stepper& stepper)
    {
        RankSlice range;
        range.vertices = vertices;
        collect_positions(comm_, part_.vertex_numbers, positions_of_part(mesh, mesh.part.mesh.vertices, Point::Zero()),
                          range);
        RankFlowState state{.step = step, .vertices = std::move(range.vertices)};
        collect_memory(comm_, mesh, stepper, state);
        return state;
    }

    /// Adds the step to the report.
    void take_step(int step, RankMesh& mesh, const UpdateLimit& limit, Stepper& stepper, RankReport& report)
    {
        const Stopwatch watch;
        const std::uint64_t messages = comm_.n_messages();
        const std::uint64_t bytes = comm_.n_bytes();
        in_step(step, [&] {
            vanishing_->step(stepper, mesh.part.mesh.vertices);
            direct(stepper, mesh.part.mesh.vertices);
            require_within_limit(limit, mesh, stepper.positions());
        });
        StepReport of_step;
        stepper.describe(of_step);
        of_step.seconds = watch.seconds();
        report.flow.seconds.step += of_step.seconds;
        report.traffic.push_back({.messages = comm_.n_messages() - messages, .bytes = comm_.n_bytes() - bytes});
        const Points before = meter_ ? result_ : Points();
        mesh.part.mesh.vertices = stepper.positions();
        make_result(mesh);
        if (meter_) {
            report.after = meter_->measure(before, result_);
            of_step.moved = report.after->displacement;
        }
        if (of_step.estimated_v_max)
            of_step.estimated_v_max = in_mean_edges(*of_step.estimated_v_max, mesh, report);
        report.flow.steps.push_back(of_step);
    }

    /// Mean edges of the flow; empty without measures.
    /// @param length the same on all ranks, which call this together.
    std::optional<double> in_mean_edges(double length, const RankMesh& mesh, const RankReport& report)
    {
        if (!meter_)
            return {};
        const Points& flowing = mesh.part.mesh.vertices;
        const double edge = bound_ ? meter_->measure(flowing, flowing).mean_edge : report.after->mean_edge;
        return edge > 0.0 ? std::optional(length / edge) : std::nullopt;
    }

    /// Derives the result from the positions from which the flow continues.
    void make_result(const RankMesh& mesh)
    {
        const Points before = std::exchange(result_, mesh.part.mesh.vertices);
        if (bound_)
            bound_->apply(result_);
        if (bound_ && directed_ && directed_->is_parallel())
            directed_->straighten(before, result_, run_in_parallel);
    }

    /// All ranks call this together.
    void prepare_direction(const RankMesh& mesh)
    {
        directed_.emplace(mesh.part.mesh, mesh.topology, options_.motion.direction);
        fetch_foreign_ = fetch_rows_of_others(
            comm_, mesh,
            select(run_in_parallel, mesh.part.mesh.n_vertices(), [&](Index v) { return !mesh.has_own_faces(v); }));
    }

    /// Leaves of a step only the motion along the lines that the options ask for. All ranks call this together: the
    /// positions then are right at all vertices that a rank knows, on whose faces the next normals depend.
    void direct(Stepper& stepper, const Points& before) const
    {
        if (!directed_)
            return;
        Points directed = stepper.positions();
        fetch_foreign_(directed);
        directed_->project(before, directed, run_in_parallel);
        fetch_foreign_(directed);
        stepper.continue_from(directed, {});
    }

    /// All ranks call this together.
    [[nodiscard]] DisplacementBound make_bound(const RankMesh& mesh)
    {
        const Index n = mesh.part.mesh.n_vertices();
        KnownElsewhere elsewhere;
        elsewhere.is_own.resize(at(n));
        for (Index v = 0; v < n; ++v)
            elsewhere.is_own[v] = mesh.has_own_faces(v) ? 1 : 0;
        elsewhere.fetch =
            fetch_rows_of_others(comm_, mesh, select(run_in_parallel, n, [&](Index v) {
                                     return elsewhere.is_own[v] == 0 &&
                                            std::ranges::any_of(neighbours_of(mesh.part.mesh, mesh.topology, v),
                                                                [&](Index w) { return elsewhere.is_own[w] != 0; });
                                 }));
        elsewhere.any = [&comm = comm_](bool holds) {
            const auto all = comm.gather_all(std::vector<std::uint8_t>{static_cast<std::uint8_t>(holds ? 1 : 0)});
            return std::ranges::find(all, 1) != all.end();
        };
        return {mesh.part.mesh, mesh.topology, *options_.motion.within, std::move(elsewhere)};
    }

    /// All ranks call this together.
    void describe(const RankMesh& mesh, std::int64_t n_interface_vertices, const Stepper& stepper, FlowReport& report)
    {
        report.mesh.vertices = mesh.n_vertices;
        report.mesh.faces = mesh.n_faces;
        report.mesh.non_manifold_vertices = mesh.n_non_manifold;
        report.mesh.junction_vertices = mesh.n_junctions;
        report.time_step = options_.time_step;
        report.remarks = mesh.remarks;
        FlowReport own;
        own.convergence = {.approach = options_.accuracy.approach, .tolerance = options_.accuracy.tolerance};
        stepper.describe(own);
        add_up(mesh, n_interface_vertices, own, report);
        // The remarks of sweeps are of this rank's sub-meshes alone.
        if (!options_.accuracy.tolerance)
            own.remarks.clear();
        report.convergence = own.convergence;
        own.steps = report.steps;
        remark_on_drift(options_, own);
        report.remarks.insert(report.remarks.end(), own.remarks.begin(), own.remarks.end());
        if (!vanishing_->remark().empty())
            report.remarks.push_back(vanishing_->remark());
    }

    /// Puts the reports of all ranks on their sub-meshes, resources and tasks together, and on those of Γ.
    void add_up(const RankMesh& mesh, std::int64_t n_interface_vertices, const FlowReport& own, FlowReport& report)
    {
        struct Share {
            std::int64_t n_interface_vertices;
            ResourceReport resources;
            PhaseSeconds seconds;
        };
        ResourceReport of_rank = own.resources;
        of_rank.threads = options_.resources.threads;
        for (const Share& share : comm_.gather_all(std::vector{Share{n_interface_vertices, of_rank, own.seconds}})) {
            report.cut.interface_vertices += share.n_interface_vertices;
            report.resources.threads += share.resources.threads;
            report.resources.live_factors += share.resources.live_factors;
            report.resources.factor_memory_bytes += share.resources.factor_memory_bytes;
            report.resources.single_factors += share.resources.single_factors;
            report.seconds.add_tasks(share.seconds);
        }
        report.seconds.interface = own.seconds.interface;
        // Each rank describes its sub-meshes in the order of their numbers.
        const std::vector<std::int64_t> counts = comm_.gather_all(std::vector{std::ssize(own.cut.sub_meshes)});
        const std::vector<SubMeshReport> all = comm_.gather_all(own.cut.sub_meshes);
        std::vector<std::size_t> next(counts.size(), 0);
        std::exclusive_scan(counts.begin(), counts.end(), next.begin(), std::size_t{0});
        for (const OwnedSubMesh& sub_mesh : mesh.all)
            report.cut.sub_meshes.push_back(all[next[sub_mesh.rank]++]);
    }

    /// All ranks call this together.
    /// @param known of the vertices that this rank knows.
    [[nodiscard]] Points positions_of_part(const RankMesh& mesh, const Points& known, const Point& offset)
    {
        // A zero offset would turn -0 into 0.
        if (offset.isZero(0.0))
            return rows_of_part(comm_, part_, mesh, known, part_.mesh.vertices);
        return rows_of_part(comm_, part_, mesh, known.rowwise() + offset, part_.mesh.vertices);
    }

    Communicator& comm_;
    MeshPart& part_;
    FlowOptions options_;
    const RankObserver& on_step_;
    const RankFlowState* resume_;
    FlowControl control_;
    Progress progress_;
    std::optional<RankMeter> meter_;
    std::optional<DisplacementBound> bound_;
    std::optional<DirectedMotion> directed_;
    std::function<void(Points& rows)> fetch_foreign_;
    std::optional<VanishingComponents> vanishing_;
    /// For the vertices that this rank knows, after the last step.
    Points result_;
};

}  // namespace

RankReport distributed_mean_curvature_flow(Transport& transport, MeshPart& part, const FlowOptions& options,
                                           const RankObserver& on_step, const RankFlowState* resume)
{
    RankReport report;
    Points positions;
    run_together(transport, [&](Communicator& comm) {
        require_valid(options);
        require_for_ranks(options);
        require_valid(part);
        Workers workers(options.resources.threads);
        workers.execute([&] { positions = RankFlow(comm, part, options, on_step, resume).run(report); });
    });
    part.mesh.vertices = std::move(positions);
    return report;
}

}  // namespace seamflow
