#include "samples/runs/rank_field_run.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/distributed/cut/distributed_cut.h"
#include "engine/distributed/cut/seams_of_fields.h"
#include "engine/distributed/distributed_fields.h"
#include "engine/distributed/files/open_together.h"
#include "engine/distributed/parts/deal.h"
#include "engine/distributed/parts/field_rows.h"
#include "engine/distributed/parts/slice_measures.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "samples/files/about_file.h"
#include "samples/files/mesh_results.h"
#include "samples/files/output_files.h"
#include "samples/report/field_report.h"
#include "samples/report/report_text.h"
#include "samples/runs/field_run.h"
#include "samples/runs/rank_inputs.h"
#include "samples/runs/run_output.h"
#include "samples/runs/smoothing_run.h"

namespace seamflow {

namespace {

/// The ranges of all columns over the vertices of all ranks.
std::vector<FieldRange> ranges_of_all(Communicator& comm, const Eigen::MatrixXd& own)
{
    std::vector<FieldRange> ranges(static_cast<std::size_t>(own.cols()));
    for (Eigen::Index c = 0; c < own.cols(); ++c)
        for (const FieldRange& block : comm.gather_all(ranges_of_blocks(own, c)))
            ranges[static_cast<std::size_t>(c)].add(block);
    return ranges;
}

/// One rank's share of a run.
class RankFieldRun {
  public:
    RankFieldRun(Transport& ranks, DistributedCommand& command, RunRecord& run, std::ostream& out)
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
        for (const FieldGroup& group : groups_) {
            run_together(ranks_, [&](Communicator& comm) { deal_group(comm, group); });
            about_file(command_.input, [&] { diffuse_group(); });
            run_together(ranks_, [&](Communicator& comm) { collect_group(comm, group); });
        }
        run_together(ranks_, [&](Communicator& comm) { end(comm, whole); });
        return require_converged(command_, summary_.report.flow.convergence,
                                 ranks_.rank() == 0 ? "smooth-distributed" : "");
    }

  private:
    /// Reads, and groups the fields.
    void begin(Communicator& comm)
    {
        command_.options.resources.threads = threads_of_rank(comm, ranks_.host(), command_);
        workers_.emplace(command_.options.resources.threads);
        const Stopwatch reading;
        file_ = open_together(comm, command_.input, sharing_, workers_->exec());
        slice_ = file_->read(comm);
        SharedMeshSize size;
        about_file(command_.input, [&] { size = measure(comm, slice_); });
        comm.at_first_rank([&] {
            require_faces(command_.input, size.faces, file_->faults());
            look_at_result();
        });
        comm.look_together([&] { settle_amount(size); });
        const SliceBounds bounds = gather_bounds(comm, slice_);
        bounds_ = bounds.vertices;
        fields_ = file_->read_fields(comm, command_.fields.names);
        summary_ = {.names = fields_.names, .n_vertices = size.vertices, .before = ranges_of_all(comm, fields_.values)};
        if (!command_.labels.empty())
            slice_.labels = read_labels(comm, command_, file_->faults(), bounds.faces);
        fixed_ = read_fixed(comm, command_, size.vertices);
        run_.read_seconds = reading.seconds();
        print_input(out_, run_, size.vertices, size.faces);
        print_field_amount(out_, run_.scale, command_.options, command_.fields.options);
        before_ = fields_.values;
        groups_ = groups_of_all(comm, before_);
    }

    /// Cuts the surface of the fields of a group, those faces whose vertices all have data, so that seams are joined as
    /// on one machine, and deals the sub-meshes and their fields to the ranks.
    void deal_group(Communicator& comm, const FieldGroup& group)
    {
        const Stopwatch cutting;
        RankSlice slice = &group == &groups_.back() ? std::move(slice_) : slice_;
        if (summary_.before[static_cast<std::size_t>(group.columns.front())].n < summary_.n_vertices)
            leave_out_faces_without_data(comm, group.lacks, slice);
        values_ = before_(Eigen::all, group.columns);
        cut(comm, slice);
        about_file(command_.input, [&] { part_ = deal(comm, slice); });
        std::vector<std::int64_t> fixed = fixed_;
        hold_in_part(seams_, fixed, part_);
        about_file(command_.input, [&] { join_fields(comm, seams_, bounds_, values_); });
        of_part_ = fetch_fields(comm, values_, part_.vertex_numbers, bounds_);
        of_group_.seconds.cut = cutting.seconds();
    }

    void diffuse_group()
    {
        FlowOptions options = command_.options;
        options.cut = {};
        options.motion.weld.reset();
        FieldOptions of_fields = command_.fields.options;
        // It is the same, from steps that are told.
        of_fields.fwhm.reset();
        const FieldReport report = diffuse_on_ranks(ranks_, part_, of_part_, options, of_fields);
        std::vector<std::string>& remarks = remarks_of_groups_.back();
        remarks.insert(remarks.end(), report.remarks.begin(), report.remarks.end());
        of_group_.convergence = report.flow.convergence;
        of_group_.seconds.analyse = report.flow.seconds.analyse;
        of_group_.seconds.step = report.flow.seconds.step;
        add_up(summary_.report.flow, of_group_);
        summary_.report.flow = of_group_;
    }

    void collect_group(Communicator& comm, const FieldGroup& group)
    {
        collect_fields(comm, part_.vertex_numbers, of_part_, values_);
        bring_back_fields(comm, seams_, bounds_, values_);
        fields_.values(Eigen::all, group.columns) = values_;
    }

    /// Whether OUTPUT can hold the fields, and what of the input it will lack. On rank 0.
    void look_at_result()
    {
        file_->require_writable_as(command_.output);
        const MeshFile* const whole = file_->whole();
        if (whole != nullptr) {
            require_place(command_, *whole);
            remarks_ = remarks_on_losses(command_.output, true, *whole);
        }
        if (file_->faults().count > 0)
            remarks_.push_back(remark_on_faces(file_->faults(), command_.output, true,
                                               whole != nullptr ? whole->kind : FileKind{*format_of(command_.input)}));
    }

    void settle_amount(const SharedMeshSize& size)
    {
        run_.scale = {size.mean_edge, size.diagonal};
        about_file(command_.input, [&] { resolve_field_amount(command_, run_); });
        if (command_.options.laplacian == Laplacian::Uniform && std::isnormal(size.mean_edge))
            command_.options.uniform_edge = size.mean_edge;
    }

    void cut(Communicator& comm, RankSlice& slice)
    {
        DistributedCut found = command_.labels.empty() ? cut_together(comm, slice, command_.options)
                                                       : cut_together_by_labels(comm, slice, command_.options);
        of_group_ = {};
        if (!found.choice.empty())
            of_group_.choices.push_back(found.choice);
        remarks_of_groups_.push_back(std::move(found.remarks));
        seams_ = std::move(found.seams);
    }

    /// Writes, and reports what was done.
    void end(Communicator& comm, const Stopwatch& whole)
    {
        const Stopwatch writing;
        renormalise(fields_, before_);
        const std::vector<std::string> of_writing = file_->write_fields(comm, command_.output, fields_);
        summary_.after = ranges_of_all(comm, fields_.values);
        const Index without_data = static_cast<Index>(before_.array().isNaN().rowwise().any().count());
        for (const Index n : comm.gather_all(std::vector{without_data}))
            summary_.report.without_data += n;
        std::vector<std::string>& remarks = summary_.report.remarks;
        remarks = remarks_on(groups_, remarks_of_groups_, fields_.names);
        for (const auto& more : {remarks_, of_writing})
            remarks.insert(remarks.end(), more.begin(), more.end());
        run_.write_seconds = writing.seconds();
        run_.seconds = whole.seconds();
        comm.at_first_rank([&] {
            if (!command_.report.empty())
                write_text(command_.report, field_report_json(run_, command_.options, summary_));
        });
        print_fields(out_, run_, summary_);
    }

    Transport& ranks_;
    SmoothCommand& command_;
    FileSharing sharing_;
    RunRecord& run_;
    std::ostream& out_;
    std::optional<Workers> workers_;
    std::unique_ptr<SharedMeshFile> file_;
    /// As it was read; moved on to the last group.
    RankSlice slice_;
    std::vector<std::int64_t> fixed_;
    /// Of the vertices of this rank's range, now and before; and those bounds.
    FileFields fields_;
    Eigen::MatrixXd before_;
    std::vector<std::int64_t> bounds_;
    std::vector<FieldGroup> groups_;
    /// Of the group that diffuses: its fields in the range and in the part, the part, and what is reported.
    Eigen::MatrixXd values_;
    Eigen::MatrixXd of_part_;
    MeshPart part_;
    JoinedSeams seams_;
    FlowReport of_group_;
    std::vector<std::vector<std::string>> remarks_of_groups_;
    FieldSummary summary_;
    /// Of files.
    std::vector<std::string> remarks_;
};

}  // namespace

ExitStatus run_fields_on_ranks(Transport& ranks, DistributedCommand& command, RunRecord& run, std::ostream& out)
{
    return RankFieldRun(ranks, command, run, out).run();
}

}  // namespace seamflow
