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
#include "engine/distributed/parts/still_faces.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "engine/distributed/ranks/mpi_transport.h"
#include "engine/measure/remarks.h"
#include "engine/setup/presets.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/io/input_file.h"
#include "samples/command/distributed_command.h"
#include "samples/files/about_file.h"
#include "samples/files/mesh_results.h"
#include "samples/files/output_files.h"
#include "samples/process/peak_memory.h"
#include "samples/report/rank_roughness.h"
#include "samples/report/report_json.h"
#include "samples/report/report_text.h"
#include "samples/runs/rank_checkpoints.h"
#include "samples/runs/rank_field_run.h"
#include "samples/runs/rank_inputs.h"
#include "samples/runs/run_output.h"
#include "samples/runs/smoothing_run.h"

using namespace seamflow;

namespace {

/// One rank's share of a run.
class RankRun {
  public:
    /// @param out where rank 0 prints, unlike the others.
    RankRun(Transport& ranks, DistributedCommand& command, RunRecord& run, std::ostream& out)
        : ranks_(ranks)
        , command_(command.flow)
        , sharing_(command.sharing)
        , run_(run)
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
            report_ =
                distributed_mean_curvature_flow(ranks_, part_, options, observer(), resume_ ? &*resume_ : nullptr);
        });
        run_together(ranks_, [&](Communicator& comm) { end(comm, whole); });
        return require_converged(command_, report_.flow.convergence, ranks_.rank() == 0 ? "smooth-distributed" : "");
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
        about_file(command_.input, [&] { inputs_.size = measure(comm, slice); });
        comm.at_first_rank([&] { require_faces(command_.input, inputs_.size.faces, file_->faults()); });
        comm.look_together([&] { settle_amount(); });
        file_->keep_normals_across(seam_distance_of(command_));
        const SliceBounds bounds = gather_bounds(comm, slice);
        if (!command_.labels.empty())
            slice.labels = read_labels(comm, command_, file_->faults(), bounds.faces);
        if (!command_.checkpoint.empty())
            inputs_.mesh = checksum_of_mesh(comm, slice);
        inputs_.fixed = read_fixed(comm, command_, inputs_.size.vertices);
        inputs_.weights = read_weights(comm, command_, inputs_.size.vertices);
        inputs_.strengths = read_strengths(comm, command_, file_->whole() != nullptr ? &file_->whole()->mesh : nullptr,
                                           run_, inputs_.size.vertices);
        run_.read_seconds = reading.seconds();
        print_input(out_, run_, inputs_.size.vertices, inputs_.size.faces);
        print_preset(out_, run_, command_.chosen);
        print_amount(out_, run_.scale, command_.options);
        comm.at_first_rank([&] { look_at_results(); });

        const Stopwatch setting_up;
        const StillFaces still = leave_out_still(comm, slice, bounds);
        cut(comm, slice, still);
        about_file(command_.input, [&] { part_ = deal(comm, slice); });
        hold_in_part(seams_, inputs_.fixed, part_);
        if (!command_.checkpoint.empty())
            find_checkpoint(comm, slice, bounds);
        part_.attachment_weights = deal_to_vertices(comm, std::move(inputs_.weights), seams_, OfSeam::Largest,
                                                    part_.vertex_numbers, bounds.vertices);
        part_.strengths = deal_to_vertices(comm, std::move(inputs_.strengths), seams_, OfSeam::Least,
                                           part_.vertex_numbers, bounds.vertices);
        if (leaves_out_faces_)
            part_.box = still.box;
        still_area_ = still.area;
        bring_back(comm, seams_, slice);
        slice_vertices_ = std::move(slice.vertices);
        if (tells_measures())
            run_.surface.before.roughness = roughness_.emplace(part_, inputs_.size.vertices).measure(comm);
        cut_seconds_ = setting_up.seconds();
    }

    /// Converts amounts given in sizes of the mesh to numbers.
    void settle_amount()
    {
        run_.scale = {inputs_.size.mean_edge, inputs_.size.diagonal};
        about_file(command_.input, [&] {
            resolve_lengths(command_, run_);
            run_.has_attachment_weights = !command_.attach_weights.empty();
            if (command_.options.laplacian == Laplacian::Uniform && std::isnormal(run_.scale.mean_edge))
                command_.options.uniform_edge = run_.scale.mean_edge;
            command_.options.time_step =
                time_step_of(command_.amount, run_.scale, command_.options.steps, filter_of(command_.options));
        });
    }

    /// Finds an earlier run, if there was one.
    /// @param slice with the labels of the cut.
    void find_checkpoint(Communicator& comm, const RankSlice& slice, const SliceBounds& bounds)
    {
        checkpoints_.emplace(comm, command_, inputs_, slice);
        resume_ = checkpoints_->find(comm, bounds.vertices);
        if (!resume_)
            return;
        out_ << "resumed    after step " << resume_->step << ", from " << checkpoints_->file().string() << std::endl;
        if (command_.every_step)
            remarks_.push_back(fmt::format(
                "--every-step wrote no files for the steps up to {}, which an earlier run took.", resume_->step));
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
            remarks_ = remarks_on_losses(command_.output, true, *whole);
        if (file_->faults().count > 0)
            remarks_.push_back(remark_on_faces(file_->faults(), command_.output, true,
                                               whole != nullptr ? whole->kind : FileKind{*format_of(command_.input)}));
        if (std::filesystem::equivalent(command_.input, command_.output, ignored))
            remarks_.push_back("The result has replaced the input, in one go when it was complete.");
    }

    /// Only the faces around a region flow, unless the boundary moves, as with smooth.
    StillFaces leave_out_still(Communicator& comm, RankSlice& slice, const SliceBounds& bounds)
    {
        const bool has_region = !command_.region.empty() && command_.options.motion.boundary == Boundary::Fixed;
        StillFaces still;
        still.n_left = inputs_.size.faces;
        if (has_region)
            still = leave_out_still_faces(comm, hand_out(comm, inputs_.strengths, bounds.vertices), slice);
        leaves_out_faces_ = still.n_left < inputs_.size.faces;
        if (leaves_out_faces_)
            choices_.push_back(remark_on_still_faces(still.n_left));
        if (still.n_left == 0)
            remarks_.push_back(remark_on_empty_region());
        return still;
    }

    void cut(Communicator& comm, RankSlice& slice, const StillFaces& still)
    {
        DistributedCut found = command_.labels.empty() ? cut_together(comm, slice, command_.options)
                                                       : cut_together_by_labels(comm, slice, command_.options);
        if (!found.choice.empty())
            choices_.push_back(found.choice);
        repaired_faces_ = static_cast<Index>(found.repaired_faces);
        if (!command_.parts.empty())
            labels_ = labels_with(labels_of_all_faces(comm, slice, found.left_out), still.faces, found.n_parts);
        of_cut_ = std::move(found.remarks);
        seams_ = std::move(found.seams);
    }

    /// Prints every step, and writes it where --every-step or --checkpoint asks for that.
    RankObserver observer()
    {
        if (!command_.verbose && !command_.every_step && !checkpoints_)
            return {};
        return [this](const RankStepState& state) {
            if (command_.verbose)
                print_step(out_, state.report, state.step, command_.options.steps, run_.scale.mean_edge);
            if (command_.every_step) {
                const Stopwatch watch;
                file_->write(state.comm, command_.every_step->path(state.step),
                             vertices_of_range(state.comm, state.part));
                run_.write_seconds += watch.seconds();
            }
            if (checkpoints_)
                checkpoints_->keep(state, slice_vertices_);
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

    /// Adds to the report of the flow what only the run knows: the cut, and the remarks of cut, flow and files, each
    /// once.
    void complete_report()
    {
        FlowReport& flow = report_.flow;
        flow.seconds.cut = cut_seconds_;
        flow.seconds.total += cut_seconds_;
        flow.cut.repaired_faces = repaired_faces_;
        flow.mesh.vertices = inputs_.size.vertices;
        flow.mesh.faces = inputs_.size.faces;
        flow.choices.insert(flow.choices.end(), choices_.begin(), choices_.end());
        std::vector<std::string> all = of_cut_;
        for (const auto& remarks : {run_.remarks, flow.remarks, remarks_})
            for (const std::string& remark : remarks)
                if (std::ranges::find(all, remark) == all.end())
                    all.push_back(remark);
        flow.remarks = std::move(all);
        if (!report_.before)
            return;
        // Nothing is known of the volume with the faces that are left out.
        const auto note = [&](const RankMeasures& measures, SurfaceLook& look) {
            look.area = measures.area + still_area_;
            if (measures.volume && !leaves_out_faces_)
                look.volume = std::abs(*measures.volume);
        };
        note(*report_.before, run_.surface.before);
        note(*report_.after, run_.surface.after);
    }

    /// Writes, and reports what was done.
    void end(Communicator& comm, const Stopwatch& whole)
    {
        const Stopwatch writing;
        const Points vertices = vertices_of_range(comm, part_);
        if (roughness_)
            run_.surface.after.roughness = roughness_->measure(comm);
        part_ = {};
        complete_report();
        FlowReport& flow = report_.flow;
        run_.surface.moved = measure_moves(comm, slice_vertices_, vertices);
        const auto remarks = file_->write(comm, command_.output, vertices);
        flow.remarks.insert(flow.remarks.end(), remarks.begin(), remarks.end());
        remark_on_loss(command_.options, run_.surface, flow.remarks, false);
        if (!command_.parts.empty())
            file_->write_labelled(comm, command_.parts, vertices, labels_);
        run_.write_seconds += writing.seconds();
        run_.seconds = whole.seconds();
        RankRecord own{.vertices = report_.vertices,
                       .foreign_vertices = report_.foreign_vertices,
                       .peak_memory_bytes = peak_memory_bytes(),
                       .threads = command_.options.resources.threads};
        for (const RankTraffic& step : report_.traffic) {
            own.messages += step.messages;
            own.bytes += step.bytes;
        }
        run_.ranks = comm.gather_all(std::vector<RankRecord>{own});
        comm.at_first_rank([&] {
            const std::string report = smooth_report_json(run_, flow);
            if (!command_.report.empty())
                write_text(command_.report, report);
            if (!command_.csv.empty())
                write_text(command_.csv, steps_csv(report));
        });
        if (command_.verbose)
            print_details(out_, run_, flow);
        print_ranks(out_, run_);
        print_result(out_, run_, flow);
    }

    Transport& ranks_;
    SmoothCommand& command_;
    FileSharing sharing_;
    RunRecord& run_;
    std::ostream& out_;
    std::optional<Workers> workers_;
    std::unique_ptr<SharedMeshFile> file_;
    MeshPart part_;
    std::optional<RankRoughness> roughness_;
    /// Positions of this rank's range of vertices in the file, and with --parts the labels of its faces.
    Points slice_vertices_ = Points(0, 3);
    std::vector<Index> labels_;
    JoinedSeams seams_;
    RankRunInputs inputs_;
    /// Of the cut, and of the files of the run.
    std::vector<std::string> choices_;
    bool leaves_out_faces_ = false;
    /// Of the faces that are left out: they stay as they are.
    double still_area_ = 0.0;
    Index repaired_faces_ = 0;
    double cut_seconds_ = 0.0;
    std::vector<std::string> of_cut_;
    std::vector<std::string> remarks_;
    std::optional<RankCheckpoints> checkpoints_;
    std::optional<RankFlowState> resume_;
    RankReport report_;
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
    RunRecord run = begin_record(command.flow);
    std::ostream silence(nullptr);
    const bool is_taken = is_standard_stream(command.flow.output) || is_standard_stream(command.flow.report);
    std::ostream& out = command.flow.quiet || ranks.rank() > 0 ? silence : is_taken ? std::cerr : std::cout;
    try {
        if (command.flow.fields.exists())
            return run_fields_on_ranks(ranks, command, run, out);
        return RankRun(ranks, command, run, out).run();
    } catch (...) {
        // The report has the message of standard error, if it can be written.
        try {
            if (ranks.rank() == 0 && !command.flow.report.empty())
                write_text(command.flow.report, smooth_failure_json(run, current_failure()));
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
