// Smooths a mesh on ranks of MPI, each of which has a part of it: mpirun -n 4 smooth-distributed INPUT OUTPUT …
//
//     a slice of the file on every rank ──► cut ──► whole sub-meshes on every rank ──► flow ──► slices ──► file

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/distributed/cut/distributed_cut.h"
#include "engine/distributed/distributed_flow.h"
#include "engine/distributed/files/open_together.h"
#include "engine/distributed/files/shared_mesh_file.h"
#include "engine/distributed/parts/deal.h"
#include "engine/distributed/parts/slice_measures.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "engine/distributed/rank_checkpoint.h"
#include "engine/distributed/ranks/mpi_transport.h"
#include "engine/distributed/ranks/packing.h"
#include "engine/setup/presets.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/index_lists.h"
#include "partition/io/input_file.h"
#include "samples/command/distributed_command.h"
#include "samples/files/mesh_results.h"
#include "samples/files/output_files.h"
#include "samples/process/peak_memory.h"
#include "samples/report/rank_report.h"
#include "samples/report/rank_roughness.h"
#include "samples/report/report_json.h"
#include "samples/report/report_text.h"
#include "samples/runs/rank_inputs.h"
#include "samples/runs/smoothing_run.h"

using namespace seamflow;

namespace {

/// Errors in a mesh are reported with the name of its file.
template <class Action>
void about_file(const std::filesystem::path& path, Action&& action)
{
    try {
        action();
    } catch (const InputError& error) {
        throw InputError(path.string() + ": " + error.what());
    }
}

/// The ranks on a machine share its cores.
int threads_of_rank(Communicator& comm, const std::string& host, const SmoothCommand& command)
{
    int n_here = 0;
    for (const Bytes& bytes : comm.allgather(packed(std::vector<char>(host.begin(), host.end())))) {
        const auto other = unpacked<char>(bytes);
        n_here += std::ranges::equal(other, host) ? 1 : 0;
    }
    const int threads = command.options.resources.threads;
    return command.chooses_threads ? std::max(1, threads / n_here) : threads;
}

/// One rank's share of a run.
class RankRun {
  public:
    /// @param out where rank 0 prints, unlike the others.
    RankRun(Transport& ranks, DistributedCommand& command, DistributedRecord& record, std::ostream& out)
        : ranks_(ranks)
        , command_(command.flow)
        , sharing_(command.sharing)
        , record_(record)
        , out_(out)
    {
    }

    ExitStatus run()
    {
        const Stopwatch whole;
        run_together(ranks_, [&](Communicator& comm) { begin(comm); });
        FlowOptions options = command_.options;
        options.cut = {};
        options.motion.weld.reset();
        options.report.measures = tells_measures();
        about_file(command_.input, [&] {
            record_.report =
                distributed_mean_curvature_flow(ranks_, part_, options, observer(), resume_ ? &*resume_ : nullptr);
        });
        record_.setup_seconds += record_.report.setup_seconds;
        run_together(ranks_, [&](Communicator& comm) { end(comm, whole); });
        return require_converged();
    }

  private:
    /// Whether the measures are reported anywhere.
    [[nodiscard]] bool tells_measures() const
    {
        return !command_.quiet || !command_.report.empty() || !command_.csv.empty();
    }

    /// Reads, cuts, and deals the sub-meshes to the ranks.
    void begin(Communicator& comm)
    {
        command_.options.resources.threads = threads_of_rank(comm, ranks_.host(), command_);
        workers_.emplace(command_.options.resources.threads);
        const Stopwatch reading;
        file_ = open_together(comm, command_.input, sharing_, workers_->exec());
        RankSlice slice = file_->read(comm);
        about_file(command_.input, [&] { record_.size = measure(comm, slice); });
        comm.at_first_rank([&] { require_faces(command_.input, record_.size.faces, file_->faults()); });
        comm.look_together([&] { settle_amount(); });
        const SliceBounds bounds = gather_bounds(comm, slice);
        if (!command_.labels.empty())
            slice.labels = read_labels(comm, command_, file_->faults(), bounds.faces);
        const std::uint64_t mesh = command_.checkpoint.empty() ? 0 : checksum_of_mesh(comm, slice);
        std::vector<std::int64_t> fixed = read_fixed(comm, command_, record_.size.vertices);
        const std::vector<double> weights = read_weights(comm, command_, record_.size.vertices);
        record_.run.read_seconds = reading.seconds();
        print_input(out_, record_.run, record_.size.vertices, record_.size.faces);
        print_preset(out_, record_.run, command_.chosen);
        print_amount(out_, record_.run.scale, command_.options);
        comm.at_first_rank([&] { look_at_results(); });

        const Stopwatch setting_up;
        cut(comm, slice);
        about_file(command_.input, [&] { part_ = deal(comm, slice); });
        move_with_seams(fixed);
        part_.fixed.resize(part_.vertex_numbers.size());
        std::ranges::transform(part_.vertex_numbers, part_.fixed.begin(),
                               [&](std::int64_t number) { return std::ranges::binary_search(fixed, number) ? 1 : 0; });
        if (!command_.checkpoint.empty())
            find_checkpoint(comm, mesh, slice, bounds, fixed, weights);
        part_.attachment_weights = deal_weights(comm, weights, seams_, part_.vertex_numbers, bounds.vertices);
        bring_back(comm, seams_, slice);
        slice_vertices_ = std::move(slice.vertices);
        if (tells_measures())
            record_.run.surface.before.roughness = roughness_.emplace(part_, record_.size.vertices).measure(comm);
        record_.setup_seconds = setting_up.seconds();
    }

    /// Converts amounts given in sizes of the mesh to numbers.
    void settle_amount()
    {
        record_.run.scale = {record_.size.mean_edge, record_.size.diagonal};
        about_file(command_.input, [&] {
            MotionOptions& motion = command_.options.motion;
            motion.weld =
                command_.weld ? std::optional(length_of(*command_.weld, record_.size.diagonal)) : std::nullopt;
            motion.within =
                command_.within ? std::optional(length_of(*command_.within, record_.size.diagonal)) : std::nullopt;
            if (command_.attach)
                motion.attachment = attachment_of(*command_.attach, record_.size.diagonal);
            if (motion.attachment > 0.0)
                record_.run.attachment = motion.attachment;
            record_.run.has_attachment_weights = !command_.attach_weights.empty();
            if (command_.options.laplacian == Laplacian::Uniform && std::isnormal(record_.size.mean_edge))
                command_.options.uniform_edge = record_.size.mean_edge;
            command_.options.time_step =
                time_step_of(command_.amount, record_.run.scale, command_.options.steps, filter_of(command_.options));
        });
        record_.time_step = command_.options.time_step;
    }

    /// Finds an earlier run, if there was one.
    /// @param mesh checksum of the input. @param slice with the labels of the cut. @param weights at rank 0.
    void find_checkpoint(Communicator& comm, std::uint64_t mesh, const RankSlice& slice, const SliceBounds& bounds,
                         const std::vector<std::int64_t>& fixed, const std::vector<double>& weights)
    {
        FlowOptions options = command_.options;
        options.motion.fixed_vertices.assign(fixed.begin(), fixed.end());
        options.motion.attachment_weights = weights;
        // These do not change the result.
        options.report = {};
        FlowIdentity identity = identify(PolygonMesh{}, options);
        for (FlowIdentity::Entry& entry : identity.entries)
            if (entry.name == "mesh")
                entry.value = fmt::format("{} vertices and {} faces with checksum {:x}", record_.size.vertices,
                                          record_.size.faces, mesh);
        identity.entries.push_back({"cut", fmt::format("that with checksum {:x}", checksum_of_labels(comm, slice))});
        checkpoint_.emplace(command_.checkpoint, std::move(identity));
        resume_ = checkpoint_->find(comm, bounds.vertices, command_.options.steps);
        if (!resume_)
            return;
        out_ << "resumed    after step " << resume_->step << ", from " << checkpoint_->file().string() << std::endl;
        if (command_.every_step)
            record_.remarks.push_back(fmt::format(
                "--every-step wrote no files for the steps up to {}, which an earlier run took.", resume_->step));
    }

    /// Keeps the state after a step where the period or the end of the run asks for it.
    void keep_checkpoint(const RankStepState& state)
    {
        const CheckpointPeriod& period = command_.checkpoint_period;
        const std::uint8_t is_due = since_kept_.seconds() >= period.seconds ? 1 : 0;
        const bool is_kept = state.comm.broadcast(std::vector<std::uint8_t>{is_due}).front() != 0;
        if (state.step != command_.options.steps && (state.step % period.steps != 0 || !is_kept))
            return;
        checkpoint_->keep(state.comm, state.capture(slice_vertices_));
        since_kept_.lap();
    }

    /// Whether results can hold the mesh, and what of the input they will lack. On rank 0.
    void look_at_results()
    {
        std::error_code ignored;
        std::vector<std::filesystem::path> results{command_.output};
        if (command_.every_step)
            results.push_back(command_.every_step->path(1));
        for (const auto& path : results) {
            file_->require_writable_as(path);
            if (const MeshFile* const whole = file_->whole())
                require_storable(whole->mesh, path, kind_for_writing(path, whole->kind));
        }
        const MeshFile* const whole = file_->whole();
        if (whole != nullptr)
            record_.remarks = remarks_on_losses(command_.output, true, *whole);
        if (file_->faults().count > 0)
            record_.remarks.push_back(
                remark_on_faces(file_->faults(), command_.output, true,
                                whole != nullptr ? whole->kind : FileKind{*format_of(command_.input)}));
        if (std::filesystem::equivalent(command_.input, command_.output, ignored))
            record_.remarks.push_back("The result has replaced the input, in one go when it was complete.");
    }

    void cut(Communicator& comm, RankSlice& slice)
    {
        DistributedCut found = command_.labels.empty() ? cut_together(comm, slice, command_.options)
                                                       : cut_together_by_labels(comm, slice, command_.options);
        if (!found.choice.empty())
            record_.choices.push_back(found.choice);
        if (!command_.parts.empty())
            labels_ = labels_of_all_faces(comm, slice, found.left_out);
        of_cut_ = std::move(found.remarks);
        seams_ = std::move(found.seams);
    }

    /// Vertices along seams are held if one that they move with is held.
    void move_with_seams(std::vector<std::int64_t>& fixed) const
    {
        std::vector<std::int64_t> firsts;
        for (const SeamVertex& one : seams_.vertices)
            if (std::ranges::binary_search(fixed, one.vertex))
                firsts.push_back(one.first);
        fixed.insert(fixed.end(), firsts.begin(), firsts.end());
        sort_unique(fixed);
    }

    /// Prints every step, and writes it where --every-step or --checkpoint asks for that.
    RankObserver observer()
    {
        if (!command_.verbose && !command_.every_step && !checkpoint_)
            return {};
        return [this](const RankStepState& state) {
            if (command_.verbose)
                print_rank_step(out_, state, command_.options.steps, record_.size.mean_edge);
            if (command_.every_step) {
                const Stopwatch watch;
                file_->write(state.comm, command_.every_step->path(state.step),
                             vertices_of_range(state.comm, state.part));
                record_.run.write_seconds += watch.seconds();
            }
            if (checkpoint_)
                keep_checkpoint(state);
        };
    }

    /// Positions of the vertices of this rank's range after steps.
    Points vertices_of_range(Communicator& comm, const MeshPart& part) const
    {
        RankSlice slice;
        slice.vertices = slice_vertices_;
        collect_positions(comm, part.vertex_numbers, part.mesh.vertices, slice);
        bring_back(comm, seams_, slice);
        return std::move(slice.vertices);
    }

    /// Notes the measures and the remarks: of cut, flow and files, each once.
    void note_flow()
    {
        std::vector<std::string> all = of_cut_;
        for (const auto& remarks : {record_.run.remarks, record_.report.remarks, record_.remarks})
            for (const std::string& remark : remarks)
                if (std::ranges::find(all, remark) == all.end())
                    all.push_back(remark);
        record_.remarks = std::move(all);
        if (!record_.report.before)
            return;
        const auto note = [](const RankMeasures& measures, SurfaceLook& look) {
            look.area = measures.area;
            if (measures.volume)
                look.volume = std::abs(*measures.volume);
        };
        note(*record_.report.before, record_.run.surface.before);
        note(*record_.report.after, record_.run.surface.after);
    }

    /// If steps have missed their tolerance, the results are not what was asked for.
    ExitStatus require_converged() const
    {
        const std::string missed = missed_tolerance(command_, record_.report.convergence);
        if (missed.empty())
            return ExitStatus::Success;
        if (ranks_.rank() == 0)
            std::cerr << "smooth-distributed: " << missed << "; " << command_.output.string()
                      << " has the last state\n";
        return ExitStatus::ComputationFailed;
    }

    /// Writes, and reports what was done.
    void end(Communicator& comm, const Stopwatch& whole)
    {
        const Stopwatch writing;
        const Points vertices = vertices_of_range(comm, part_);
        if (roughness_)
            record_.run.surface.after.roughness = roughness_->measure(comm);
        part_ = {};
        note_flow();
        record_.run.surface.moved = measure_moves(comm, slice_vertices_, vertices);
        const auto remarks = file_->write(comm, command_.output, vertices);
        record_.remarks.insert(record_.remarks.end(), remarks.begin(), remarks.end());
        remark_on_loss(command_.options, record_.run.surface, record_.remarks, false);
        if (!command_.parts.empty())
            file_->write_labelled(comm, command_.parts, vertices, labels_);
        record_.run.write_seconds += writing.seconds();
        record_.run.seconds = whole.seconds();
        RankRecord own{.vertices = record_.report.vertices,
                       .foreign_vertices = record_.report.foreign_vertices,
                       .peak_memory_bytes = peak_memory_bytes(),
                       .threads = command_.options.resources.threads};
        for (const RankStepReport& step : record_.report.steps) {
            own.messages += step.messages;
            own.bytes += step.bytes;
        }
        record_.ranks = comm.gather_all(std::vector<RankRecord>{own});
        comm.at_first_rank([&] {
            const std::string report = distributed_report_json(record_, command_.options);
            if (!command_.report.empty())
                write_text(command_.report, report);
            if (!command_.csv.empty())
                write_text(command_.csv, steps_csv(report));
        });
        print_distributed_result(out_, record_);
    }

    Transport& ranks_;
    SmoothCommand& command_;
    FileSharing sharing_;
    DistributedRecord& record_;
    std::ostream& out_;
    std::optional<Workers> workers_;
    std::unique_ptr<SharedMeshFile> file_;
    MeshPart part_;
    std::optional<RankRoughness> roughness_;
    /// Positions of this rank's range of vertices in the file, and with --parts the labels of its faces.
    Points slice_vertices_ = Points(0, 3);
    std::vector<Index> labels_;
    JoinedSeams seams_;
    std::vector<std::string> of_cut_;
    std::optional<RankCheckpoint> checkpoint_;
    std::optional<RankFlowState> resume_;
    Stopwatch since_kept_;
};

/// Rank 0 parses for all.
std::optional<ExitStatus> parse_together(Transport& ranks, int argc, char** argv, DistributedCommand& command)
{
    std::optional<ExitStatus> end;
    run_together(ranks, [&](Communicator& comm) {
        comm.at_first_rank([&] { end = parse_distributed_command(argc, argv, 0, command); });
        const auto ends = comm.gather_all(end ? std::vector<ExitStatus>{*end} : std::vector<ExitStatus>{});
        if (!ends.empty())
            end = ends.front();
        else if (comm.rank() > 0)
            end = parse_distributed_command(argc, argv, comm.rank(), command);
    });
    return end;
}

ExitStatus smooth_distributed(Transport& ranks, int argc, char** argv)
{
    DistributedCommand command;
    if (const auto end = parse_together(ranks, argc, argv, command))
        return *end;
    DistributedRecord record;
    record.run = begin_record(command.flow);
    std::ostream silence(nullptr);
    const bool is_taken = is_standard_stream(command.flow.output) || is_standard_stream(command.flow.report);
    std::ostream& out = command.flow.quiet || ranks.rank() > 0 ? silence : is_taken ? std::cerr : std::cout;
    try {
        return RankRun(ranks, command, record, out).run();
    } catch (...) {
        // The report has the message of standard error, if it can be written.
        try {
            if (ranks.rank() == 0 && !command.flow.report.empty())
                write_text(command.flow.report, smooth_failure_json(record.run, current_failure()));
        } catch (const OutputError&) {
        }
        throw;
    }
}

}  // namespace

int main(int argc, char** argv)
{
    // MPI ends all ranks as soon as one has ended with a failure: none does until rank 0 has reported it.
    std::unique_ptr<Transport> ranks;
    return run_program("smooth-distributed", [&] {
        ranks = make_mpi_transport();
        try {
            return smooth_distributed(*ranks, argc, argv);
        } catch (...) {
            if (ranks->rank() > 0)
                return current_failure().status;
            throw;
        }
    });
}
