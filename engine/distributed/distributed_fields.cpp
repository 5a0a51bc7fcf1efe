#include "engine/distributed/distributed_fields.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/distributed/rank_options.h"
#include "engine/distributed/rank_setup.h"
#include "engine/distributed/ranks/communicator.h"
#include "engine/distributed/rows_of_others.h"
#include "engine/fields/field_columns.h"
#include "engine/measure/origin_offset.h"
#include "engine/options/flow_control.h"
#include "engine/options/valid_options.h"
#include "engine/steppers/schur_stepper.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/executor.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// @throws OptionError for what needs the whole mesh.
void require_for_fields_on_ranks(const FieldOptions& of_fields)
{
    if (of_fields.fill)
        throw OptionError("ranks do not fill vertices without data: leave fill out, or use a single process");
    if (of_fields.keep_edges)
        throw OptionError("ranks do not keep edges of fields: leave keep_edges out, or use a single process");
}

/// Those of the flow that is applied to fields.
FlowOptions flow_on_ranks(const FlowOptions& options, const FieldOptions& of_fields)
{
    require_for_fields(options, of_fields);
    require_for_fields_on_ranks(of_fields);
    FlowOptions own = flow_for_fields(options, of_fields);
    Approach& approach = own.accuracy.approach;
    if (approach != Approach::Automatic && approach != Approach::Decomposed && approach != Approach::Converged)
        throw OptionError(
            "ranks let fields diffuse in converged steps: leave the approach out, or use a single process");
    approach = Approach::Converged;
    require_valid(own);
    require_for_ranks(own);
    return own;
}

/// Those of the whole mesh.
std::vector<ValueRange> ranges_of_all(Communicator& comm, const Eigen::MatrixXd& fields, const FieldGroup& group)
{
    const std::vector<ValueRange> of_ranks = comm.gather_all(ranges_of(fields, group));
    std::vector<ValueRange> ranges(group.columns.size());
    for (std::size_t i = 0; i < of_ranks.size(); ++i) {
        ValueRange& range = ranges[i % ranges.size()];
        range.least = std::min(range.least, of_ranks[i].least);
        range.most = std::max(range.most, of_ranks[i].most);
    }
    return ranges;
}

/// Converged steps of the surface of a group, on one rank.
class FieldFlow {
  public:
    /// All ranks construct it together. @param surface must outlive the flow.
    /// @param others numbers of vertices of this rank that have no faces of its surface, ascending.
    FieldFlow(Communicator& comm, const MeshPart& surface, const std::vector<std::int64_t>& others,
              const FlowOptions& options)
        : comm_(comm)
        , surface_(surface)
        , progress_(control_)
        , mesh_(make_rank_mesh(comm, surface, origin_offset(gather_box(comm, surface.mesh)), options,
                               SoundCut::NotNeeded))
        , stepper_(mesh_.part.mesh, make_peer_sub_meshes(comm, mesh_, decompose_rank_mesh(mesh_)), options, progress_)
        , others_(comm, mesh_, others)
        , is_elsewhere_(others_.fetch(Points::Ones(mesh_.part.mesh.n_vertices(), 3)))
    {
    }

    /// All ranks call this together.
    /// @param rows #V of the surface by 3. @param of_others correspond to `others`: those that other ranks have change.
    /// @param n how many steps.
    void diffuse(Points& rows, Points& of_others, int n, DataSteps steps)
    {
        // What other sub-meshes have does not matter.
        Points data = Points::Zero(mesh_.part.mesh.n_vertices(), 3);
        for (Index v = 0; v < data.rows(); ++v)
            if (const Index row = position_in(surface_.vertex_numbers, mesh_.part.vertex_numbers[v]); row >= 0)
                data.row(v) = rows.row(row);
        stepper_.begin(data, steps);
        for (int step = 1; step <= n; ++step)
            try {
                stepper_.step(data);
                data = stepper_.positions();
            } catch (const ComputationError& error) {
                throw ComputationError(fmt::format("step {}, {}", step, error.what()));
            }
        rows = rows_of_part(comm_, surface_, mesh_, data, std::move(rows));
        const Points elsewhere = others_.fetch(data);
        for (Index i = 0; i < of_others.rows(); ++i)
            if (is_elsewhere_(i, 0) > 0.0)
                of_others.row(i) = elsewhere.row(i);
    }

    void describe(FlowReport& report) const
    {
        report.remarks = mesh_.remarks;
        stepper_.describe(report);
    }

  private:
    Communicator& comm_;
    const MeshPart& surface_;
    FlowControl control_;
    Progress progress_;
    RankMesh mesh_;
    SchurStepper stepper_;
    RowsOfOthers others_;
    /// #others by 3: 1 where another rank has them, else 0.
    Points is_elsewhere_;
};

/// Lets the columns of a group diffuse. All ranks call this together.
FlowReport diffuse_group(Communicator& comm, const MeshPart& part, const FieldGroup& group, FlowOptions options,
                         Eigen::MatrixXd& fields)
{
    Stopwatch watch;
    const int n_steps = options.steps;
    options.steps *= n_blocks(std::ssize(group.columns));
    const std::vector<Index> faces = select(run_in_parallel, part.mesh.n_faces(),
                                            [&](Index f) { return has_data(part.mesh, f, group, options.laplacian); });
    const std::vector<std::size_t> n_faces = comm.gather_all(std::vector{faces.size()});
    FlowReport report;
    report.convergence = {.approach = options.accuracy.approach, .tolerance = options.accuracy.tolerance};
    if (std::ranges::all_of(n_faces, [](std::size_t n) { return n == 0; }))
        return report;
    const MeshPart surface = some_faces(part, faces);
    ScaledFields scaled(fields, group, ranges_of_all(comm, fields, group), options.time_step);
    const auto is_own = [&](Index v) { return position_in(surface.vertex_numbers, part.vertex_numbers[v]) >= 0; };
    const std::vector<Index> own = select(run_in_parallel, part.mesh.n_vertices(), is_own);
    const std::vector<Index> others =
        select(run_in_parallel, part.mesh.n_vertices(), [&](Index v) { return group.lacks[v] == 0 && !is_own(v); });
    std::vector<std::int64_t> numbers;
    for (const Index v : others)
        numbers.push_back(part.vertex_numbers[v]);
    FieldFlow flow(comm, surface, numbers, options);
    const double set_up = watch.lap();
    constexpr Eigen::Index width = 3;
    for (Eigen::Index c = 0; c < scaled.values().cols(); c += width) {
        auto columns = scaled.values().middleCols(c, std::min(width, scaled.values().cols() - c));
        const auto rows_of = [&](const std::vector<Index>& vertices) {
            Points rows = Points::Zero(std::ssize(vertices), width);
            rows.leftCols(columns.cols()) = columns(vertices, Eigen::all);
            return rows;
        };
        Points of_own = rows_of(own);
        Points of_others = rows_of(others);
        flow.diffuse(of_own, of_others, n_steps, c == 0 ? DataSteps::Further : DataSteps::Again);
        columns(own, Eigen::all) = of_own.leftCols(columns.cols());
        columns(others, Eigen::all) = of_others.leftCols(columns.cols());
    }
    scaled.write(group, fields);
    flow.describe(report);
    report.seconds.analyse = set_up;
    report.seconds.step = watch.lap();
    return report;
}

}  // namespace

std::vector<FieldGroup> groups_of_all(Communicator& comm, const Eigen::MatrixXd& fields)
{
    const std::vector<FieldGroup> own = group_columns(fields);
    const auto n = static_cast<std::size_t>(fields.cols());
    // For each column, the first one like it here, and its group.
    std::vector<std::size_t> like(n);
    std::vector<const FieldGroup*> group_of(n);
    for (const FieldGroup& group : own)
        for (const Eigen::Index c : group.columns) {
            like[static_cast<std::size_t>(c)] = static_cast<std::size_t>(group.columns.front());
            group_of[static_cast<std::size_t>(c)] = &group;
        }
    for (const std::size_t other : comm.gather_all(std::vector{n}))
        if (other != n)
            throw InputError(fmt::format("some ranks have {} fields and others {}: give all the same", n, other));
    const std::vector<std::size_t> of_all = comm.gather_all(like);
    std::vector<FieldGroup> groups;
    for (std::size_t c = 0; c < n; ++c) {
        const auto is_alike = [&](const FieldGroup& group) {
            const auto first = static_cast<std::size_t>(group.columns.front());
            for (std::size_t i = 0; i < of_all.size(); i += n)
                if (of_all[i + c] != of_all[i + first])
                    return false;
            return true;
        };
        auto group = std::ranges::find_if(groups, is_alike);
        if (group == groups.end())
            group = groups.insert(group, {{}, group_of[c]->lacks, group_of[c]->n_lacking});
        group->columns.push_back(static_cast<Eigen::Index>(c));
    }
    return groups;
}

FieldReport diffuse_on_ranks(Transport& transport, const MeshPart& part, Eigen::MatrixXd& fields,
                             const FlowOptions& options, const FieldOptions& field_options)
{
    FieldReport report;
    Eigen::MatrixXd results = fields;
    run_together(transport, [&](Communicator& comm) {
        const FlowOptions of_flow = completed(flow_on_ranks(options, field_options), part);
        require_valid(part);
        comm.look_together([&] { require_fields_of(part.mesh.n_vertices(), fields, part.vertex_numbers); });
        Workers workers(options.resources.threads);
        workers.execute([&] {
            const std::vector<FieldGroup> groups = groups_of_all(comm, fields);
            std::vector<std::vector<std::string>> remarks;
            for (const FieldGroup& group : groups) {
                FlowReport of_group = diffuse_group(comm, part, group, of_flow, results);
                remarks.push_back(of_group.remarks);
                add_up(report.flow, of_group);
                report.flow = std::move(of_group);
            }
            report.remarks = remarks_on(groups, remarks, field_options.names);
        });
    });
    fields = std::move(results);
    report.flow.remarks = report.remarks;
    return report;
}

}  // namespace seamflow
