#include "samples/benchmark/benchmark_case.h"

#include <algorithm>
#include <map>
#include <utility>

#include "samples/benchmark/loosest_tolerance.h"

namespace seamflow {

namespace {

constexpr double tight_tolerance = 1e-8;
constexpr double loose_tolerance = 1e-4;

class Case {
  public:
    Case(const PolygonMesh& mesh, const CaseOptions& options, const std::function<void(const Row&)>& on_row)
        : rows_(mesh)
        , options_(options)
        , on_row_(on_row)
    {
    }

    CaseResult all()
    {
        result_.vertices = rows_.mesh().n_vertices();
        result_.faces = rows_.mesh().n_faces();
        MethodTask task = task_of(Method::Ours);
        task.simulated_threads = options_.simulated_threads;
        Row ours = rows_.run(task);
        require_success(ours);
        rows_.find_reference(options_.reference, options_.flow);
        if (rows_.reference())
            result_.reference = rows_.reference()->name;
        rows_.measure(ours);
        result_.ours = ours;
        on_row_(ours);
        run_ours_in_one_thread();
        for (const Method peer : options_.peers)
            run_peer(peer);
        return std::move(result_);
    }

  private:
    [[nodiscard]] MethodTask task_of(Method method, double tolerance = 0.0) const
    {
        return MethodRows::task_of(method, options_.flow, tolerance);
    }

    [[nodiscard]] Row run(const MethodTask& task) const
    {
        Row row = rows_.run(task);
        rows_.measure(row);
        return row;
    }

    void run_ours_in_one_thread()
    {
        const bool wanted =
            std::find(options_.peers.begin(), options_.peers.end(), Method::Amg) != options_.peers.end();
        if (!wanted || options_.flow.resources.threads == 1)
            return;
        MethodTask task = task_of(Method::Ours);
        task.options.resources.threads = 1;
        Row row = run(task);
        row.name = "ours-one-thread";
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
        const std::optional<Row>& reference = rows_.reference();
        if (reference && !is_iterative(peer) && reference->task.method == peer) {
            Row row = *reference;
            row.v_mean = row.v_max = 0.0;
            keep(std::move(row));
        } else if (is_iterative(peer)) {
            run_iterative(peer);
        } else {
            keep(run(task_of(peer)));
        }
    }

    /// The row of a tolerance, run once.
    const Row& row_for(Method peer, double tolerance, std::map<double, Row>& rows) const
    {
        const auto [found, is_new] = rows.try_emplace(tolerance);
        if (is_new)
            found->second = run(task_of(peer, tolerance));
        return found->second;
    }

    void run_iterative(Method peer)
    {
        std::map<double, Row> rows;
        keep(row_for(peer, tight_tolerance, rows));
        if (!rows.at(tight_tolerance).succeeded())
            return;
        keep(row_for(peer, loose_tolerance, rows));
        if (!rows_.reference())
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

    MethodRows rows_;
    const CaseOptions& options_;
    const std::function<void(const Row&)>& on_row_;
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
