#include "samples/benchmark/benchmark_case.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/benchmark/loosest_tolerance.h"
#include "samples/benchmark/method_process.h"
#include "samples/benchmark/scratch_folder.h"

namespace seamflow {

namespace {

constexpr double reference_tolerance = 1e-12;
constexpr double tight_tolerance = 1e-8;
constexpr double loose_tolerance = 1e-4;

/// @param tolerance a power of ten, as everywhere but at equal accuracy.
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

class Case {
  public:
    Case(const PolygonMesh& mesh, const CaseOptions& options, const std::function<void(const Row&)>& on_row)
        : mesh_(mesh)
        , options_(options)
        , on_row_(on_row)
    {
        write_mesh_for_methods(scratch_.path(), mesh);
    }

    CaseResult all()
    {
        result_.vertices = mesh_.n_vertices();
        result_.faces = mesh_.n_faces();
        MethodTask task = task_of(Method::Ours, 0.0);
        task.simulated_threads = options_.simulated_threads;
        Row ours = run(task);
        require_success(ours);
        find_reference();
        measure(ours);
        result_.ours = ours;
        on_row_(ours);
        run_ours_in_one_thread();
        for (const Method peer : options_.peers)
            run_peer(peer);
        return std::move(result_);
    }

  private:
    [[nodiscard]] MethodTask task_of(Method method, double tolerance) const
    {
        MethodTask task{method, options_.flow, tolerance, {}};
        if (method == Method::Amg)
            task.options.resources.threads = 1;
        return task;
    }

    Row run(const MethodTask& task) const
    {
        const std::string obstacle = why_not(task.method, task.options.laplacian);
        return {
            name_of(task), task, obstacle.empty() ? run_in_process(scratch_.path(), task) : failed(obstacle), {}, {}};
    }

    static void require_success(const Row& row)
    {
        if (!row.succeeded())
            throw ComputationError(row.name + ": " + row.result.error);
    }

    [[nodiscard]] bool is_small_enough_to_factorise() const
    {
        const bool two_rings = options_.flow.laplacian == Laplacian::PtackovaVelho;
        return mesh_.n_vertices() <= (two_rings ? 300'000 : 2'000'000);
    }

    [[nodiscard]] Row run_direct_reference() const
    {
        const bool symmetric = options_.flow.laplacian != Laplacian::PtackovaVelho;
        return run(task_of(symmetric ? Method::Cholmod : Method::Umfpack, 0.0));
    }

    void find_reference()
    {
        const Reference wanted = options_.reference;
        if (wanted == Reference::None)
            return;
        if (wanted == Reference::Direct || (wanted == Reference::Automatic && is_small_enough_to_factorise()))
            reference_row_ = run_direct_reference();
        if (!reference_row_ || (wanted == Reference::Automatic && !reference_row_->succeeded()))
            reference_row_ = run(task_of(Method::Krylov, reference_tolerance));
        require_success(*reference_row_);
        reference_ = std::exchange(reference_row_->result.positions, Points(0, 3));
        result_.reference = reference_row_->name;
    }

    /// Distances take the place of the positions.
    void measure(Row& row) const
    {
        const Points positions = std::exchange(row.result.positions, Points(0, 3));
        if (!row.succeeded() || !reference_row_ || positions.rows() == 0)
            return;
        const VertexDistance distance = vertex_distance(mesh_, reference_, positions);
        row.v_mean = distance.mean / distance.mean_edge;
        row.v_max = distance.max / distance.mean_edge;
    }

    void run_ours_in_one_thread()
    {
        const bool wanted =
            std::find(options_.peers.begin(), options_.peers.end(), Method::Amg) != options_.peers.end();
        if (!wanted || options_.flow.resources.threads == 1)
            return;
        MethodTask task = task_of(Method::Ours, 0.0);
        task.options.resources.threads = 1;
        Row row = run(task);
        row.name = "ours-one-thread";
        measure(row);
        on_row_(row);
        result_.ours_one_thread = std::move(row);
    }

    void keep(Row row)
    {
        on_row_(row);
        result_.peers.push_back(std::move(row));
    }

    void run_peer(Method peer)
    {
        if (reference_row_ && !is_iterative(peer) && reference_row_->task.method == peer) {
            reference_row_->v_mean = reference_row_->v_max = 0.0;
            keep(*reference_row_);
        } else if (is_iterative(peer)) {
            run_iterative(peer);
        } else {
            Row row = run(task_of(peer, 0.0));
            measure(row);
            keep(std::move(row));
        }
    }

    /// The row of a tolerance, run once.
    const Row& row_for(Method peer, double tolerance, std::map<double, Row>& rows) const
    {
        const auto [found, is_new] = rows.try_emplace(tolerance);
        if (is_new) {
            found->second = run(task_of(peer, tolerance));
            measure(found->second);
        }
        return found->second;
    }

    void run_iterative(Method peer)
    {
        std::map<double, Row> rows;
        keep(row_for(peer, tight_tolerance, rows));
        if (!rows.at(tight_tolerance).succeeded())
            return;
        keep(row_for(peer, loose_tolerance, rows));
        if (!reference_row_)
            return;
        const Row& ours = result_.ours;
        keep_loosest(peer, "-equal-accuracy", rows, [&](const Row& row) { return *row.v_max <= *ours.v_max; });
        keep_loosest(peer, "-equal-both", rows,
                     [&](const Row& row) { return *row.v_max <= *ours.v_max && *row.v_mean <= *ours.v_mean; });
    }

    /// The row of the loosest tolerance with which a peer is as near to the undecomposed flow as asked for.
    void keep_loosest(Method peer, const char* suffix, std::map<double, Row>& rows,
                      const std::function<bool(const Row&)>& is_near)
    {
        const auto found = loosest_tolerance([&](double tolerance) {
            const Row& row = row_for(peer, tolerance, rows);
            return row.v_max && is_near(row);
        });
        Row equal = row_for(peer, found.value_or(tight_tolerance), rows);
        equal.name = std::string(title_of(peer, options_.flow.laplacian)) + suffix;
        if (!found)
            equal.result = failed("not reached with 1e-8");
        keep(std::move(equal));
    }

    const PolygonMesh& mesh_;
    const CaseOptions& options_;
    const std::function<void(const Row&)>& on_row_;
    ScratchFolder scratch_;
    std::optional<Row> reference_row_;
    Points reference_ = Points(0, 3);
    CaseResult result_;
};

}  // namespace

double ratio(const CaseResult& result, const Row& peer)
{
    return peer.result.step_seconds() / result.ours.result.step_seconds();
}

std::optional<double> ratio_one_thread(const CaseResult& result, const Row& peer)
{
    if (peer.task.method != Method::Amg)
        return std::nullopt;
    const Row& ours = result.ours_one_thread ? *result.ours_one_thread : result.ours;
    return peer.result.step_seconds() / ours.result.step_seconds();
}

CaseResult run_case(const PolygonMesh& mesh, const CaseOptions& options, const std::function<void(const Row&)>& on_row)
{
    return Case(mesh, options, on_row).all();
}

}  // namespace seamflow
