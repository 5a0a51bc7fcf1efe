#include "samples/benchmark/method_rows.h"

#include <cmath>
#include <utility>

#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/benchmark/method_process.h"

namespace seamflow {

namespace {

constexpr double reference_tolerance = 1e-12;

/// @param tolerance a power of ten, as everywhere except at equal accuracy.
std::string with_tolerance(std::string_view title, double tolerance)
{
    const int exponent = static_cast<int>(std::lround(std::log10(tolerance)));
    return std::string(title) + "-1e" + std::to_string(exponent);
}

std::string name_of(const MethodTask& task)
{
    const std::string_view title = title_of(task.method, task.options.laplacian);
    return is_iterative(task.method) ? with_tolerance(title, task.tolerance) : std::string(title);
}

}  // namespace

MethodRows::MethodRows(const PolygonMesh& mesh)
    : mesh_(mesh)
{
    write_mesh_for_methods(scratch_.path(), mesh);
}

MethodTask MethodRows::task_of(Method method, const FlowOptions& flow, double tolerance)
{
    MethodTask task{method, flow, tolerance, {}};
    if (method == Method::Amg)
        task.options.resources.threads = 1;
    return task;
}

Row MethodRows::run(const MethodTask& task) const
{
    const std::string obstacle = why_not(task.method, task.options.laplacian);
    return {
        name_of(task), task, obstacle.empty() ? run_in_process(scratch_.path(), task) : failed(obstacle), {}, {}, {}};
}

bool MethodRows::is_small_enough_to_factorise(Laplacian laplacian) const
{
    return mesh_.n_vertices() <= (is_symmetric(laplacian) ? 2'000'000 : 300'000);
}

void MethodRows::find_reference(Reference wanted, const FlowOptions& flow)
{
    reference_row_.reset();
    if (wanted == Reference::None)
        return;
    const bool is_direct =
        wanted == Reference::Direct || (wanted == Reference::Automatic && is_small_enough_to_factorise(flow.laplacian));
    if (is_direct)
        reference_row_ = run(task_of(is_symmetric(flow.laplacian) ? Method::Cholmod : Method::Umfpack, flow));
    if (!is_direct || (wanted == Reference::Automatic && !reference_row_->succeeded()))
        reference_row_ = run(task_of(Method::Krylov, flow, reference_tolerance));
    require_success(*reference_row_);
    reference_ = std::exchange(reference_row_->result.positions, Points(0, 3));
}

void MethodRows::measure(Row& row) const
{
    const Points positions = std::exchange(row.result.positions, Points(0, 3));
    if (!row.succeeded() || !reference_row_ || positions.rows() == 0)
        return;
    const VertexDistance distance = vertex_distance(mesh_, reference_, positions);
    row.v_mean = distance.mean / distance.mean_edge;
    row.v_max = distance.max / distance.mean_edge;
}

void require_success(const Row& row)
{
    if (!row.succeeded())
        throw ComputationError(row.name + ": " + row.result.error);
}

}  // namespace seamflow
