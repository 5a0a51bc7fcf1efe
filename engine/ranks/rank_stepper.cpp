#include "engine/ranks/rank_stepper.h"

#include <algorithm>
#include <exception>
#include <span>
#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "partition/index_lists.h"

namespace seamflow {

bool RankGroup::can_share(const FlowPlan& plan, const StepSettings& settings) const
{
    const auto* const sweeps = std::get_if<SweepSteps>(&plan.way);
    const bool can_share_sweeps =
        sweeps != nullptr && (std::holds_alternative<PredictedTransmission>(sweeps->conditions) ||
                              std::holds_alternative<AdaptedConditions>(sweeps->conditions));
    return size() > 1 && plan.cut.n_parts > 1 &&
           (can_share_sweeps || std::holds_alternative<ConvergedSteps>(plan.way)) && !settings.records_schedule;
}

std::unique_ptr<HeatStepper> RankGroup::make_stepper(const PolygonMesh& mesh, const Topology& topology,
                                                     const FlowPlan& plan, const StepSettings& settings,
                                                     std::vector<double> curvature, Progress& progress)
{
    return std::make_unique<RankStepper>(*this, mesh, topology, plan, settings, std::move(curvature), progress);
}

RankStepper::RankStepper(RankGroup& ranks, const PolygonMesh& mesh, const Topology& topology, const FlowPlan& plan,
                         const StepSettings& settings, std::vector<double> curvature, Progress& progress)
    : ranks_(&ranks)
    , flow_(ranks.add_flow())
    , n_sub_meshes_(plan.cut.n_parts)
    , sub_meshes_(static_cast<std::size_t>(ranks.size()))
    , positions_(mesh.vertices)
{
    if (const int threads = ranks.threads_of_each(); threads > 0 && threads < n_threads_of_arena())
        threads_ = std::make_unique<Workers>(threads);
    deal(mesh, topology, plan, settings, std::move(curvature), progress);
}

/// Deals their parts to all ranks, rank 0 included, and numbers the rows that their steppers save.
void RankStepper::deal(const PolygonMesh& mesh, const Topology& topology, const FlowPlan& plan,
                       const StepSettings& settings, std::vector<double> curvature, Progress& progress)
{
    Communicator& comm = ranks_->comm();
    std::vector<std::vector<SavedRow>> saved(static_cast<std::size_t>(comm.size()));
    Dealer dealer(mesh, topology, plan.cut, plan.way, settings, std::move(curvature), comm.size());
    comm.run([&] {
        // The other ranks begin while rank 0 makes its own part.
        for (int rank = comm.size() - 1; rank > 0; --rank) {
            Packer message = rank_message({.task = RankTask::Deal, .flow = flow_, .value = ranks_->threads_of_each()});
            dealer.deal(rank, message);
            comm.give(rank, message.take());
            // The rank confirms its part, so that one part at a time takes memory here.
            comm.take(rank);
        }
        Packer of_first;
        dealer.deal(0, of_first);
        Bytes message = of_first.take();
        Unpacker unpacker(message);
        DealtMesh dealt = dealt_mesh(unpacker);
        message = Bytes();
        in_own_threads([&] { own_ = std::make_unique<RankPart>(comm, std::move(dealt), progress); });
        saved[0] = own_->saved_rows();
        for (int rank = 1; rank < comm.size(); ++rank)
            saved[static_cast<std::size_t>(rank)] = unpacked<SavedRow>(comm.take(rank));
    });
    known_vertices_ = std::move(dealer.known_vertices());
    sent_vertices_ = std::move(dealer.sent_vertices());
    for (Index s = 0; s < n_sub_meshes_; ++s)
        sub_meshes_[dealer.holders()[s]].push_back(s);
    number_saved_rows(saved, dealer.holders());
}

/// Numbers the saved rows of all ranks. Several ranks save the same row: the rank of its lowest sub-mesh provides it.
void RankStepper::number_saved_rows(const std::vector<std::vector<SavedRow>>& of_ranks,
                                    const std::vector<Index>& holders)
{
    std::vector<SavedRow> all;
    for (const std::vector<SavedRow>& rows : of_ranks)
        all.insert(all.end(), rows.begin(), rows.end());
    sort_unique(all);
    n_saved_ = static_cast<Index>(all.size());
    for (std::size_t rank = 0; rank < of_ranks.size(); ++rank) {
        std::vector<Index>& rows = saved_rows_.emplace_back();
        std::vector<std::uint8_t>& is_used = is_used_.emplace_back();
        for (const SavedRow& row : of_ranks[rank]) {
            rows.push_back(static_cast<Index>(std::ranges::lower_bound(all, row) - all.begin()));
            is_used.push_back(holders[row.lowest] == static_cast<Index>(rank) ? 1 : 0);
        }
    }
}

/// Runs work on rank 0 with as many threads as each rank has.
void RankStepper::in_own_threads(const std::function<void()>& work) const
{
    threads_ ? threads_->execute(work) : work();
}

RankStepper::~RankStepper()
{
    // Destroyed on the threads on which the members were made, because each thread has memory of its own.
    in_own_threads([&] { own_.reset(); });
    try {
        Communicator& comm = ranks_->comm();
        comm.run([&] {
            for (int rank = 1; rank < comm.size(); ++rank)
                comm.give(rank, rank_message({.task = RankTask::Drop, .flow = flow_}).take());
        });
    } catch (const std::exception&) {
        // Other ranks end without being told, too.
    }
}

/// Sends a request to all ranks.
/// @returns the answers of all ranks.
std::vector<Bytes> RankStepper::ask(RankTask task, const Put& put) const
{
    Communicator& comm = ranks_->comm();
    std::vector<Bytes> answers(static_cast<std::size_t>(comm.size()));
    comm.run([&] {
        for (int rank = 1; rank < comm.size(); ++rank) {
            Packer message = rank_message({.task = task, .flow = flow_});
            if (put)
                put(rank, message);
            comm.give(rank, message.take());
        }
        Packer to_self;
        if (put)
            put(0, to_self);
        const Bytes message = to_self.take();
        Unpacker unpacker(message);
        in_own_threads([&] { answers[0] = own_->act(task, unpacker); });
        for (int rank = 1; rank < comm.size(); ++rank)
            answers[static_cast<std::size_t>(rank)] = comm.take(rank);
    });
    return answers;
}

void RankStepper::step(const Points&)
{
    are_current_ = false;
    ask(RankTask::Step);
}

const Points& RankStepper::positions() const
{
    if (are_current_)
        return positions_;
    const std::vector<Bytes> answers = ask(RankTask::Positions);
    for (std::size_t rank = 0; rank < answers.size(); ++rank) {
        Unpacker unpacker(answers[rank]);
        unpacker.get_rows(positions_, sent_vertices_[rank]);
    }
    are_current_ = true;
    return positions_;
}

void RankStepper::set_positions(const Points& image, const SimilarityOfComponents&)
{
    positions_ = image;
    are_current_ = true;
    ask(RankTask::SetPositions, [&](int rank, Packer& message) { message.put_rows(image, known_vertices_[rank]); });
}

void RankStepper::set_data(const Points& data, DataSteps steps)
{
    positions_ = data;
    are_current_ = true;
    ask(RankTask::SetData, [&](int rank, Packer& message) {
        message.put(steps);
        message.put_rows(data, known_vertices_[rank]);
    });
}

void RankStepper::set_vertices(std::span<const Index> vertices, const Points& to)
{
    if (are_current_)
        move_rows(vertices, to, positions_);
    ask(RankTask::SetVertices, [&](int, Packer& message) {
        message.put_all(vertices);
        message.put_points(to);
    });
}

void RankStepper::save(StepMemory& memory) const
{
    memory.positions = positions();
    const std::vector<Bytes> answers = ask(RankTask::Save);
    for (std::size_t rank = 0; rank < answers.size(); ++rank) {
        Unpacker unpacker(answers[rank]);
        // The numbers are the same on all ranks.
        memory.numbers = unpacker.get_all<double>();
        memory.arrays.resize(unpacker.get<std::size_t>(), Points::Zero(n_saved_, 3));
        for (Points& array : memory.arrays) {
            const Points rows = unpacker.get_points();
            for (std::size_t i = 0; i < saved_rows_[rank].size(); ++i)
                if (is_used_[rank][i] != 0)
                    array.row(saved_rows_[rank][i]) = rows.row(static_cast<Index>(i));
        }
    }
}

void RankStepper::restore(const StepMemory& memory)
{
    StepMemoryReader reader(memory);
    for (std::size_t i = 0; i < memory.arrays.size(); ++i)
        reader.array_of_any(n_saved_);
    positions_ = memory.positions;
    are_current_ = true;
    ask(RankTask::Restore, [&](int rank, Packer& message) {
        message.put_rows(memory.positions, known_vertices_[rank]);
        message.put_all(std::span<const double>(memory.numbers));
        message.put(memory.arrays.size());
        for (const Points& array : memory.arrays)
            message.put_rows(array, saved_rows_[rank]);
    });
}

void RankStepper::add_seconds(PhaseSeconds& seconds) const
{
    FlowReport report;
    report_to(report);
    seconds.add_tasks(report.seconds);
}

/// The report on a step is the same on all ranks.
void RankStepper::report_to(StepReport& report) const
{
    own_->stepper().report_to(report);
}

void RankStepper::report_to(FlowReport& report) const
{
    FlowReport of_own;
    own_->stepper().report_to(of_own);
    std::vector<SubMeshReport> sub_meshes(usize(n_sub_meshes_));
    report.resources = {};
    double interface = 0.0;
    const std::vector<Bytes> answers = ask(RankTask::Describe);
    for (std::size_t rank = 0; rank < answers.size(); ++rank) {
        Unpacker answer(answers[rank]);
        const auto share = answer.get<RankShare>();
        const ResourceReport& resources = share.resources;
        report.ranks.push_back(share.record);
        report.resources.threads += resources.threads;
        report.resources.live_factors += resources.live_factors;
        report.resources.factor_memory_bytes += resources.factor_memory_bytes;
        report.resources.single_factors += resources.single_factors;
        report.cut.interface_vertices += share.n_interface_vertices;
        // In the equation on Γ the ranks wait for each other, so that its wall-clock times are not added.
        PhaseSeconds seconds = share.seconds;
        interface = std::max(interface, std::exchange(seconds.interface, 0.0));
        report.seconds.add_tasks(seconds);
        const auto of_rank = answer.get_all<SubMeshReport>();
        for (std::size_t i = 0; i < of_rank.size(); ++i)
            sub_meshes[sub_meshes_[rank][i]] = of_rank[i];
    }
    report.seconds.interface += interface;
    report.cut.sub_meshes.insert(report.cut.sub_meshes.end(), sub_meshes.begin(), sub_meshes.end());
    report.convergence.steps_short_of_tolerance = of_own.convergence.steps_short_of_tolerance;
    report.convergence.steps_stagnated = of_own.convergence.steps_stagnated;
    // The remarks concern steps as a whole, and are the same on all ranks.
    report.remarks.insert(report.remarks.end(), of_own.remarks.begin(), of_own.remarks.end());
}

}  // namespace seamflow
