#include "samples/benchmark/method_rows.h"

#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/benchmark/method_process.h"
#include "samples/benchmark/methods/median.h"

namespace seamflow {

namespace {

constexpr double reference_tolerance = 1e-12;
constexpr Index most_vertices_to_factorise = 2'000'000;

}  // namespace

double Row::seconds() const
{
    return median(turns);
}

std::string Row::name() const
{
    if (is_iterative(task.method))
        return fmt::format("{} to {:.0e}", name_of(task.method), task.tolerance);
    return result.approach.empty() ? std::string(name_of(task.method))
                                   : fmt::format("{} by {}", name_of(task.method), result.approach);
}

nlohmann::ordered_json Row::json() const
{
    nlohmann::ordered_json json{{"method", name_of(task.method)}};
    if (!succeeded()) {
        json["error"] = result.error;
        return json;
    }
    if (is_iterative(task.method))
        json["tolerance"] = task.tolerance;
    if (task.method == Method::Ours)
        json["approach"] = result.approach;
    json.update(nlohmann::ordered_json{{"setup_s", result.setup_seconds},
                                       {"step_s", result.step_seconds()},
                                       {"all_s", seconds()},
                                       {"turns_s", turns},
                                       {"peak_memory_mb", 1e-6 * static_cast<double>(result.peak_memory_bytes)},
                                       {"threads", task.options.resources.threads}});
    if (result.iterations > 0)
        json["iterations"] = result.iterations;
    if (v_max) {
        json["v_mean"] = *v_mean;
        json["v_max"] = *v_max;
    }
    return json;
}

MethodRows::MethodRows(const PolygonMesh& mesh)
    : mesh_(mesh)
    , input_(scratch_.path() / "input.ply")
    , output_(scratch_.path() / "output.ply")
{
    write_mesh(input_, mesh, kind_for_writing(input_, FileKind{}));
}

MethodTask MethodRows::task_of(Method method, const FlowOptions& flow, double tolerance)
{
    MethodTask task{method, flow, tolerance};
    if (method == Method::Amg)
        task.options.resources.threads = 1;
    return task;
}

Row MethodRows::run_task(MethodTask task) const
{
    if (task.input.empty()) {
        task.input = input_;
        task.output = output_;
    }
    Row row{task, run_in_process(scratch_.path(), task), {}, {}, {}};
    row.turns = {row.result.total_seconds()};
    return row;
}

Row MethodRows::run(const MethodTask& task) const
{
    Row row = run_task(task);
    if (row.succeeded() && reference_row_)
        measure(row, row.task.output);
    return row;
}

void MethodRows::find_reference(const FlowOptions& flow)
{
    reference_row_.reset();
    if (mesh_.n_vertices() <= most_vertices_to_factorise)
        reference_row_ = run_task(task_of(Method::Cholmod, flow));
    if (!reference_row_ || !reference_row_->succeeded())
        reference_row_ = run_task(task_of(Method::Gradients, flow, reference_tolerance));
    require_success(*reference_row_);
    reference_row_->v_mean = reference_row_->v_max = 0.0;
    reference_ = read_mesh(output_).mesh.vertices;
}

void MethodRows::measure(Row& row, const std::filesystem::path& output) const
{
    if (!reference_row_)
        return;
    const VertexDistance distance = vertex_distance(mesh_, reference_, read_mesh(output).mesh.vertices);
    row.v_mean = distance.mean / distance.mean_edge;
    row.v_max = distance.max / distance.mean_edge;
}

void require_success(const Row& row)
{
    if (!row.succeeded())
        throw ComputationError(row.name() + ": " + row.result.error);
}

}  // namespace seamflow
