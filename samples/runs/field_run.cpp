#include "samples/runs/field_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "engine/diffuse.h"
#include "engine/geodesic_distance.h"
#include "engine/ranks/rank_group.h"
#include "engine/setup/resolved_options.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/formats/file_fields.h"
#include "partition/formats/index_files.h"
#include "partition/formats/mesh_io.h"
#include "partition/formats/ply.h"
#include "partition/formats/ply_data.h"
#include "partition/io/input_file.h"
#include "partition/io/input_position.h"
#include "partition/metrics/bounding_box.h"
#include "partition/text.h"
#include "samples/files/about_file.h"
#include "samples/files/mesh_input.h"
#include "samples/files/mesh_results.h"
#include "samples/files/output_files.h"
#include "samples/page/page_html.h"
#include "samples/page/read_file_colours.h"
#include "samples/page/shown_steps.h"
#include "samples/process/exit_status.h"
#include "samples/process/interruption.h"
#include "samples/report/field_report.h"
#include "samples/report/report_text.h"
#include "samples/runs/command_run.h"
#include "samples/runs/named_files.h"

namespace seamflow {

namespace {

constexpr const char* name_of_distance = "distance";

/// Columns nx, ny and nz are normals: as long as they were, unless nothing is left of them.
/// @param before #V by n: the fields before.
void renormalise(FileFields& fields, const Eigen::MatrixXd& before)
{
    const Index x = fields.column("nx");
    const Index y = fields.column("ny");
    const Index z = fields.column("nz");
    if (x < 0 || y < 0 || z < 0)
        return;
    for (Eigen::Index v = 0; v < fields.values.rows(); ++v) {
        const double length = std::hypot(fields.values(v, x), fields.values(v, y), fields.values(v, z));
        const double wanted = std::hypot(before(v, x), before(v, y), before(v, z));
        if (length > 0.0 && wanted > 0.0)
            for (const Index column : {x, y, z})
                fields.values(v, column) *= wanted / length;
    }
}

/// Checks that OUTPUT has a place for fields, so that nothing is computed in vain.
void require_place(const SmoothCommand& command, const MeshOutput& output)
{
    if (output.kind().format != FileFormat::Ply && (!output.is_like_input() || command.fields.names.empty()))
        throw OutputError(
            fmt::format("{}: cannot be written: only .ply files hold such fields; write one", output.path().string()));
}

/// Completes the amount and the lengths of `command` for fields on a mesh, and records its sizes.
void resolve_field_amount(SmoothCommand& command, const PolygonMesh& mesh, const Executor& exec, RunRecord& run)
{
    run.scale = measure_scale(mesh, exec);
    LengthScale scale = run.scale.lengths();
    FlowOptions& of_flow = command.options;
    of_flow = resolved(std::move(of_flow), mesh, scale, exec, run.remarks);
    FieldOptions& options = command.fields.options;
    options = resolved(std::move(options), scale);
    if (options.fwhm)
        of_flow.time_step = time_for_fwhm(options.fwhm->value, of_flow) / std::max(of_flow.steps, 1);
}

/// A sentence on numbers that may be names of things: few different whole ones, whatever their type. Of two neighbours
/// rounding makes no third, and 0 and 1 may be shares.
void remark_on_labels(const FileFields& fields, std::vector<Remark>& remarks)
{
    constexpr std::size_t most_labels = 32;
    constexpr Eigen::Index least_vertices_of_each = 10;
    constexpr std::array colours{"red", "green", "blue", "alpha"};
    for (Eigen::Index c = 0; c < fields.values.cols(); ++c) {
        const std::string& name = fields.names[static_cast<std::size_t>(c)];
        if (std::ranges::find(colours, name) != colours.end())
            continue;
        const auto is_fraction = [](double value) { return std::isfinite(value) && value != std::floor(value); };
        if (std::ranges::any_of(fields.values.col(c), is_fraction))
            continue;
        std::set<double> labels;
        for (Eigen::Index v = 0; v < fields.values.rows() && labels.size() <= most_labels; ++v)
            if (std::isfinite(fields.values(v, c)))
                labels.insert(fields.values(v, c));
        const auto n = static_cast<Eigen::Index>(labels.size());
        if (labels.size() <= most_labels && n * least_vertices_of_each <= fields.values.rows() && !labels.empty() &&
            *labels.rbegin() - *labels.begin() > 1.0)
            remarks.push_back(
                fmt::format("{} has {} different whole numbers: if they are labels, they are averaged like "
                            "measurements, which makes numbers between them; smooth a property of each "
                            "label, 1 on it and 0 elsewhere.",
                            in_quotes(name), n));
    }
}

/// @returns the fields after all steps.
FileFields diffused(SmoothCommand& command, const MeshFile& file, const FileFields& before, const FlowControl& control,
                    FieldSummary& summary)
{
    FileFields fields = before;
    summary.names = fields.names;
    summary.before = ranges_of_columns(before.values);
    FlowOptions options = command.options;
    FieldOptions of_fields = command.fields.options;
    // It is the same, from steps that are told.
    if (of_fields.fwhm)
        options.time_step = 0.0;
    of_fields.names = fields.names;
    summary.report = diffuse(file.mesh, fields.values, options, of_fields, control);
    renormalise(fields, before.values);
    remark_on_labels(before, summary.report.remarks);
    return fields;
}

FileFields distances(const SmoothCommand& command, const MeshFile& file, const std::vector<Index>& from,
                     const FlowControl& control, FieldSummary& summary)
{
    const Stopwatch watch;
    FileFields fields{.names = {name_of_distance},
                      .values = geodesic_distance(file.mesh, from, command.options.resources, control)};
    summary.report.flow.seconds.step = watch.seconds();
    for (double& one : fields.values.reshaped())
        if (std::isinf(one)) {
            one = std::numeric_limits<double>::quiet_NaN();
            ++summary.report.without_data;
        }
    if (summary.report.without_data > 0)
        summary.report.remarks.push_back(
            fmt::format("The surface leads from none of them to {}: the distance there is NaN.",
                        counted(static_cast<std::uint64_t>(summary.report.without_data), "vertex", "vertices")));
    summary.names = fields.names;
    return fields;
}

/// How the result will hold distances.
/// @throws OutputError where that is in whole numbers, to which they would be rounded.
Decimals decimals_of_distances(const MeshFile& file, const std::filesystem::path& input)
{
    if (file.kind.format != FileFormat::Ply || is_input_stream(input))
        return Decimals::Double;
    const InputFile read{OpenFile(input)};
    const PlyHeader header = ply_data_of(input, read.content()).header;
    const PlyProperty* const property = header.element("vertex")->property(name_of_distance);
    if (property == nullptr)
        return Decimals::Double;
    if (property->length_type || is_integer(property->type))
        throw OutputError(fmt::format("{}: has whole numbers or lists named distance, which cannot hold distances: "
                                      "rename that property",
                                      input.string()));
    return decimals_of(property->type, header.encoding);
}

/// The vertices of --from. @throws InputError
std::vector<Index> read_sources(const SmoothCommand& command, Index n_vertices)
{
    std::vector<Index> from = read_vertex_set(command.fields.from, n_vertices, command.fix_property);
    if (from.empty())
        throw InputError(command.fields.from.path().string() + ": names no vertex: write one number at least");
    return from;
}

/// In the form of the input where the format stays.
/// @param fields are rounded to what was written.
std::vector<std::string> write_fields(const MeshOutput& output, const MeshFile& file, FileFields& fields,
                                      const Executor& exec)
{
    if (!output.is_like_input())
        return write_mesh(output.path(), file.mesh, output.kind(), fields, exec);
    std::vector<std::string> remarks = write_mesh_like(*file.source, output.path(), file.mesh, fields, exec);
    const Eigen::MatrixXd& all = fields.values;
    round_as_written(fields, all, exec);
    return remarks;
}

/// @param colours of INPUT, read before OUTPUT may have replaced it. @param before without distances.
void write_page(const SmoothCommand& command, const PolygonMesh& mesh, FileColours colours,
                const Eigen::MatrixXd& before, const FileFields& after, const std::string& report)
{
    const bool are_distances = command.fields.names.empty();
    const PageFields fields{.fields = pack_fields(after.names, before, after.values),
                            .are_distances = are_distances,
                            .steps = are_distances ? 0 : command.options.steps,
                            .report_json = report};
    write_text(command.html, page_html(command.input.filename().string(), PageMesh(mesh, std::move(colours)), fields));
}

/// Writes the mesh with its fields, and remarks on what it lacks.
void write_result(const MeshOutput& output, const MeshFile& file, FileFields& fields, const FaultLog& left_out,
                  const Executor& exec, RunRecord& run, FieldSummary& summary)
{
    const Stopwatch writing;
    for (const auto& remarks : {output.remarks_on_losses(true, exec), write_fields(output, file, fields, exec)})
        summary.report.remarks.insert(summary.report.remarks.end(), remarks.begin(), remarks.end());
    if (!run.scale.far_vertices.empty())
        summary.report.remarks.push_back(remark_on_far_vertices(run.scale.far_vertices));
    summary.after = ranges_of_columns(fields.values);
    if (left_out.count > 0)
        summary.report.remarks.push_back(output.remark_on_faces(left_out, true));
    run.write_seconds = writing.seconds();
}

}  // namespace

ExitStatus run_fields(SmoothCommand& command, RunRecord& run, RankGroup* ranks)
{
    Interruption interruption(command.program);
    std::ostream& out = *command.messages;
    const Stopwatch whole;
    Workers workers(command.options.resources.threads);
    const Executor exec = workers.exec();
    FaultLog left_out{.of_faces_alone = true};
    MeshFile file = read_surface(command.input, &left_out, exec);
    const MeshOutput output(command.output, file);
    require_place(command, output);
    FileColours colours;
    if (!command.html.empty()) {
        require_showable(file.mesh, command.html);
        colours = read_file_colours(command.input, file, left_out.faces_left_out);
    }
    FieldSummary summary{.n_vertices = file.mesh.n_vertices()};
    read_named_files(command, file.mesh, left_out.faces_left_out);
    about_file(command.input, [&] { resolve_field_amount(command, file.mesh, exec, run); });
    run.read_seconds = whole.seconds();
    print_input(out, run, file.mesh.n_vertices(), file.mesh.n_faces());
    if (!command.fields.names.empty())
        print_field_amount(out, run.scale, command.options, command.fields.options);
    FileFields before;
    FileFields fields;
    std::vector<Index> from;
    if (!command.fields.names.empty())
        before = read_fields(*file.source, command.fields.names, exec);
    else
        from = read_sources(command, file.mesh.n_vertices());
    const Decimals of_distances = from.empty() ? Decimals::Double : decimals_of_distances(file, command.input);
    try {
        interruption.begin_work();
        const FlowControl control{.stop = interruption.token(), .ranks = ranks};
        fields = about_file(command.input, [&] {
            return command.fields.names.empty() ? distances(command, file, from, control, summary)
                                                : diffused(command, file, before, control, summary);
        });
    } catch (const Cancelled&) {
        say_error(command.program, "interrupted; no mesh was written");
        return interruption.status();
    }
    if (!from.empty())
        fields.decimals = {of_distances};
    write_result(output, file, fields, left_out, exec, run, summary);
    run.ranks = summary.report.flow.ranks;
    run.choices_in_words = in_words_of_program(summary.report.flow.choices);
    run.remarks_in_words = in_words_of_program(summary.report.remarks);
    run.seconds = whole.seconds();
    const std::string report = field_report_json(run, command.options, summary);
    if (!command.report.empty())
        write_text(command.report, report);
    if (!command.html.empty())
        workers.execute([&] { write_page(command, file.mesh, std::move(colours), before.values, fields, report); });
    if (ranks != nullptr)
        print_ranks(out, run, ranks->size());
    print_fields(out, run, summary);
    command.options.accuracy.tolerance = summary.report.flow.convergence.tolerance;
    return require_converged(command, summary.report.flow.convergence);
}

}  // namespace seamflow
