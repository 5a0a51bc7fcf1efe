#include "engine/ranks/rank_part.h"

#include <algorithm>
#include <utility>

#include "engine/ranks/communicator_ranks.h"
#include "engine/ranks/peak_memory.h"
#include "engine/steppers/schur_stepper.h"
#include "engine/sweep/factor_windows.h"
#include "engine/sweep/sweep_order.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/decomposition/part_of_mesh.h"
#include "partition/decomposition/reverse_cuthill_mckee.h"
#include "partition/index_lists.h"
#include "partition/labels.h"

namespace seamflow {

namespace {

/// Per sub-mesh of all ranks: the sub-meshes with which it shares a vertex of Γ.
std::vector<std::vector<Index>> gather_adjacency(Communicator& comm, const DealtMesh& dealt,
                                                 const Decomposition& decomposition)
{
    struct Pair {
        Index from;
        Index to;
    };
    std::vector<Pair> own;
    for (std::size_t s = 0; s < dealt.known.size(); ++s)
        if (dealt.holders[dealt.known[s]] == comm.rank())
            for (const Index neighbour : decomposition.adjacency[s])
                own.push_back({dealt.known[s], dealt.known[neighbour]});
    std::vector<std::vector<Index>> adjacency(dealt.holders.size());
    for (const auto& [from, to] : comm.gather_all(own))
        adjacency[from].push_back(to);
    return adjacency;
}

/// Per sub-mesh of all ranks: Σ‖ΔV⁰‖, in 1/length.
std::vector<double> gather_curvatures(Communicator& comm, const DealtMesh& dealt, const Decomposition& decomposition)
{
    struct Total {
        Index number;
        double curvature;
    };
    const std::vector<double> totals = total_curvatures(decomposition, dealt.curvature);
    std::vector<Total> own;
    for (std::size_t s = 0; s < dealt.known.size(); ++s)
        if (dealt.holders[dealt.known[s]] == comm.rank())
            own.push_back({dealt.known[s], totals[s]});
    std::vector<double> of_all(dealt.holders.size(), 0.0);
    for (const auto& [number, curvature] : comm.gather_all(own))
        of_all[number] = curvature;
    return of_all;
}

/// Windows that are large enough forward and backward, whatever data cross Γ: computed as if every sub-mesh needed the
/// results of all sub-meshes around it. If ranks use their parts of both orders, and windows of at least this size,
/// they do not wait for each other in a circle: a solution waits only for factorisations that are earlier in the order
/// than the factorisations that wait for the solution.
std::vector<FactorWindow> sufficient_windows(const std::vector<std::vector<Index>>& adjacency,
                                             const std::vector<Index>& stage)
{
    const std::vector<Index> order = reverse_cuthill_mckee(adjacency);
    std::vector<FactorWindow> windows;
    for (const auto& direction : {stage, reversed(stage)}) {
        SweepPlan plan = empty_plan(direction);
        for (std::size_t s = 0; s < adjacency.size(); ++s)
            for (const Index neighbour : adjacency[s])
                (direction[neighbour] < direction[s] ? plan.traces : plan.predictions)[s].push_back(
                    {.from = neighbour, .to = static_cast<Index>(s), .source = {}, .target = {}});
        windows.push_back(least_window(plan, order_by_need(plan, order)));
    }
    return windows;
}

}  // namespace

RankPart::RankPart(Communicator& comm, DealtMesh dealt, Progress& progress)
    : comm_(comm)
    , dealt_(std::move(dealt))
    , n_threads_(n_threads_of_arena())
{
    for (Index v = 0; v < dealt_.mesh.n_vertices(); ++v)
        if (dealt_.is_sent[v] != 0)
            sent_vertices_.push_back(v);
    std::vector<std::uint8_t> is_own;
    for (const Index number : dealt_.known)
        is_own.push_back(dealt_.holders[number] == comm.rank() ? 1 : 0);
    Decomposition decomposition = decompose_part(dealt_.mesh, dealt_.topology, dealt_.labels, is_own, run_in_parallel);
    n_interface_vertices_ = decomposition.n_interface_vertices;
    std::vector<SubMeshName> names;
    for (std::size_t s = 0; s < dealt_.known.size(); ++s)
        names.push_back({dealt_.known[s], decomposition.sub_meshes[s].n_vertices, dealt_.first_faces[s]});
    RankSubMeshes own{std::move(decomposition), std::make_unique<CommunicatorRanks>(comm, dealt_.holders, dealt_.known),
                      std::move(names)};
    // The sub-meshes around a vertex, ascending: the lowest comes first.
    std::vector<Index> around;
    const auto* const converged = std::get_if<ConvergedSteps>(&dealt_.way);
    for (const Index v : converged != nullptr
                             ? make_converged_stepper(converged->stop, std::move(own), progress)
                             : make_sweep_stepper(std::get<SweepSteps>(dealt_.way), std::move(own), progress)) {
        labels_around(dealt_.topology, dealt_.labels, v, around);
        saved_.push_back({dealt_.known[around.front()], dealt_.vertex_numbers[v]});
    }
    if (converged == nullptr)
        return;
    // The mesh is freed: converged steps have copies of the data that they need.
    dealt_.mesh = {};
    dealt_.topology = {};
    dealt_.labels = std::vector<Index>();
}

/// Makes the stepper for converged steps.
/// @returns the vertex of each row that it saves.
std::vector<Index> RankPart::make_converged_stepper(const IterationStop& stop, RankSubMeshes sub_meshes,
                                                    Progress& progress)
{
    auto stepper =
        std::make_unique<SchurStepper>(dealt_.mesh, std::move(sub_meshes), dealt_.settings(), stop, progress);
    std::vector<Index> saved = stepper->saved_vertices();
    heat_ = stepper.get();
    stepper_ = std::move(stepper);
    return saved;
}

/// Makes the stepper for sweeps. All ranks compute the same stages and orders of factorisation, from the adjacency and
/// the curvature of all sub-meshes, which they gather; each keeps the entries of its own sub-meshes.
/// @returns the vertex of each row that the stepper saves.
std::vector<Index> RankPart::make_sweep_stepper(const SweepSteps& sweeps, RankSubMeshes sub_meshes, Progress& progress)
{
    exchange_.emplace(comm_, dealt_);
    SweepSubMeshes own{
        .decomposition = std::move(sub_meshes.decomposition), .names = std::move(sub_meshes.names), .stage = {}};
    RanksOfSweep ranks{.ranks = std::move(sub_meshes.ranks), .remote = &*exchange_};
    const auto adjacency = gather_adjacency(comm_, dealt_, own.decomposition);
    const auto curvatures = gather_curvatures(comm_, dealt_, own.decomposition);
    const std::vector<Index> stage_of_all = assign_stages(adjacency, sweeps.solves_in_order_of_numbers, curvatures);
    for (const Index number : dealt_.known) {
        own.stage.push_back(stage_of_all[number]);
        own.is_remote.push_back(dealt_.holders[number] == comm_.rank() ? 0 : 1);
    }
    // The own sub-meshes among those of all ranks, by their local numbers.
    const auto own_of = [&](const std::vector<Index>& all) {
        std::vector<Index> here;
        for (const Index number : all)
            if (dealt_.holders[number] == comm_.rank())
                here.push_back(find_in(dealt_.known, number));
        return here;
    };
    for (const FactorWindow& window : sufficient_windows(adjacency, stage_of_all))
        ranks.windows.push_back({own_of(window.order), own_of(window.freed), window.size});
    auto stepper = std::make_unique<SweepStepper>(dealt_.mesh, dealt_.topology, std::move(own), std::move(ranks),
                                                  dealt_.settings(), sweeps, progress);
    std::vector<Index> saved = stepper->saved_vertices();
    stepper_ = std::move(stepper);
    return saved;
}

/// Takes the step of this rank, and counts the messages sent.
void RankPart::step()
{
    const std::uint64_t messages = comm_.n_messages();
    const std::uint64_t bytes = comm_.n_bytes();
    before_ = stepper_->positions();
    stepper_->step(before_);
    n_messages_ += comm_.n_messages() - messages;
    n_bytes_ += comm_.n_bytes() - bytes;
}

Bytes RankPart::act(RankTask task, Unpacker& message)
{
    Packer answer;
    switch (task) {
    case RankTask::Step:
        step();
        break;
    case RankTask::Positions:
        answer.put_rows(stepper_->positions(), sent_vertices_);
        break;
    case RankTask::SetPositions:
        stepper_->set_positions(message.get_points(), {});
        break;
    case RankTask::SetData: {
        const auto steps = message.get<DataSteps>();
        heat_->set_data(message.get_points(), steps);
        break;
    }
    case RankTask::SetVertices: {
        std::vector<Index> vertices = message.get_all<Index>();
        for (Index& v : vertices)
            v = find_in(dealt_.vertex_numbers, v);
        stepper_->set_vertices(vertices, message.get_points());
        break;
    }
    case RankTask::Save: {
        StepMemory memory;
        stepper_->save(memory);
        answer.put_all(std::span<const double>(memory.numbers));
        answer.put(memory.arrays.size());
        for (const Points& array : memory.arrays)
            answer.put_points(array);
        break;
    }
    case RankTask::Restore: {
        StepMemory memory;
        memory.positions = message.get_points();
        memory.numbers = message.get_all<double>();
        memory.arrays.resize(message.get<std::size_t>());
        for (Points& array : memory.arrays)
            array = message.get_points();
        stepper_->restore(memory);
        break;
    }
    case RankTask::Describe:
        report_to(answer);
        break;
    case RankTask::Deal:
    case RankTask::Drop:
    case RankTask::Dismiss:
        break;
    }
    return answer.take();
}

/// Appends a RankShare, and the reports on the own sub-meshes, to the answer.
void RankPart::report_to(Packer& answer) const
{
    FlowReport report;
    stepper_->report_to(report);
    const auto n_known = static_cast<std::int64_t>(dealt_.vertex_numbers.size());
    const auto n_sent = static_cast<std::int64_t>(sent_vertices_.size());
    RankShare share{.record = {.vertices = n_sent,
                               .foreign_vertices = n_known - n_sent,
                               .messages = n_messages_,
                               .bytes = n_bytes_,
                               .peak_memory_bytes = peak_memory_bytes(),
                               .threads = n_threads_},
                    .resources = report.resources,
                    .seconds = report.seconds,
                    .n_interface_vertices = n_interface_vertices_};
    share.resources.threads = n_threads_;
    answer.put(share);
    answer.put_all(std::span<const SubMeshReport>(report.cut.sub_meshes));
}

}  // namespace seamflow
