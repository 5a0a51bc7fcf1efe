#include "samples/benchmark/many_cores.h"

#include <algorithm>
#include <ostream>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "engine/setup/cost_model.h"
#include "samples/benchmark/memory_bandwidth.h"
#include "solvers/systems/block_row_matrix.h"

namespace seamflow {

namespace {

using Json = nlohmann::ordered_json;

/// The cost of an approach with so many cores, of one that was measured.
class Extrapolation {
  public:
    /// @param measured of a method of ours that succeeded.
    Extrapolation(Approach approach, const MethodResult& measured, FlowSize size, int threads, double bandwidth)
        : approach_(approach)
        , measured_(measured)
        , size_(std::move(size))
        , threads_(threads)
        , bandwidth_(bandwidth)
    {
    }

    [[nodiscard]] ManyCores::Cost with(int cores) const
    {
        return {cores, measured_.setup_seconds * predicted_setup(cores) / predicted_setup(threads_), step(cores)};
    }

  private:
    [[nodiscard]] double predicted_setup(int cores) const
    {
        FlowSize size = size_;
        size.cores = cores;
        return predict_cost(approach_, size, 1e-2).setup;
    }

    [[nodiscard]] double makespan(int cores) const
    {
        return std::ranges::find(measured_.simulations, cores, &Simulation::workers)->makespan;
    }

    [[nodiscard]] double step(int cores) const
    {
        const double step = measured_.step_seconds();
        if (approach_ == Approach::Undecomposed)
            return step;
        if (approach_ == Approach::ConjugateGradients) {
            const double bytes = BlockRowMatrix::bytes_of_iteration(size_.rows.length) * size_.vertices *
                                 measured_.iterations / static_cast<double>(measured_.steps.size());
            return std::max(step * threads_ / cores, bytes / bandwidth_);
        }
        const double besides = std::max(step - makespan(threads_), 0.0);
        return makespan(cores) + besides * threads_ / cores;
    }

    Approach approach_;
    const MethodResult& measured_;
    FlowSize size_;
    int threads_;
    double bandwidth_;
};

}  // namespace

ManyCores measure_for_many_cores(const PolygonMesh& mesh, const FlowOptions& flow, const std::vector<int>& cores,
                                 double bandwidth)
{
    const FlowSize size{.vertices = mesh.n_vertices(),
                        .rows = average_rows(mesh, make_topology(mesh), flow.laplacian),
                        .time_step = flow.time_step,
                        .steps = flow.steps};
    const int here = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    ManyCores many{
        .steps = flow.steps, .bandwidth = bandwidth > 0.0 ? bandwidth : triad_bandwidth(here), .entries = {}};
    const MethodRows rows(mesh);
    for (const auto& [approach, method] : our_approaches) {
        MethodTask task = MethodRows::task_of(method, flow);
        task.simulated_threads = cores;
        task.simulated_threads.push_back(flow.resources.threads);
        // Options of sub-meshes mean nothing to the others, which refuse them.
        if (takes_whole_mesh(approach)) {
            task.options.cut = {};
            task.options.resources.memory_limit.reset();
        }
        ManyCores::Entry entry{.approach = approach, .measured = rows.run(task), .costs = {}};
        const Extrapolation extrapolation(approach, entry.measured.result, size, flow.resources.threads,
                                          many.bandwidth);
        if (entry.measured.succeeded())
            for (const int n : cores)
                entry.costs.push_back(extrapolation.with(n));
        many.entries.push_back(std::move(entry));
    }
    return many;
}

void print_many_cores(std::ostream& out, const ManyCores& many)
{
    out << fmt::format(
        "what each approach takes as measured, and would take with more cores and {:.3g} GB/s of memory, "
        "in seconds:\n{:<14} {:>7} {:>9} {:>9} {:>9} {:>9}\n",
        1e-9 * many.bandwidth, "", "cores", "setup", "step", "all", "speed-up");
    for (const ManyCores::Entry& entry : many.entries) {
        const std::string name(option_name(entry.approach));
        const MethodResult& measured = entry.measured.result;
        if (!entry.measured.succeeded()) {
            out << fmt::format("{:<14} {}\n", name, measured.error);
            continue;
        }
        const auto print = [&](std::string_view cores, double setup, double step) {
            const double all = setup + many.steps * step;
            out << fmt::format("{:<14} {:>7} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.2f}\n", name, cores, setup, step, all,
                               (measured.setup_seconds + many.steps * measured.step_seconds()) / all);
        };
        print("here", measured.setup_seconds, measured.step_seconds());
        for (const ManyCores::Cost& cost : entry.costs)
            print(std::to_string(cost.cores), cost.setup, cost.step);
    }
    out << std::flush;
}

Json many_cores_json(const ManyCores& many)
{
    Json json;
    for (const ManyCores::Entry& entry : many.entries) {
        Json& of_approach = json[std::string(option_name(entry.approach))] = Json::array();
        for (const ManyCores::Cost& cost : entry.costs)
            of_approach.push_back({{"cores", cost.cores},
                                   {"setup_s", cost.setup},
                                   {"step_s", cost.step},
                                   {"all_s", cost.setup + many.steps * cost.step}});
    }
    return {{"memory_bytes_per_second", many.bandwidth}, {"entries", json}};
}

}  // namespace seamflow
