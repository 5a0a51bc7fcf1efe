#include "samples/benchmark/explanation.h"

#include <ostream>
#include <utility>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "engine/setup/cost_model.h"
#include "samples/benchmark/case_json.h"
#include "samples/benchmark/memory_bandwidth.h"

namespace seamflow {

namespace {

using Json = nlohmann::ordered_json;

std::string distance_text(const std::optional<double>& distance)
{
    return distance ? fmt::format("{:.1e}", *distance) : "";
}

}  // namespace

Explanation explain(const PolygonMesh& mesh, const FlowOptions& flow, Reference reference)
{
    const Topology topology = make_topology(mesh);
    const MeshSize size = size_of(mesh);
    Explanation explanation{.size = {.vertices = mesh.n_vertices(),
                                     .rows = average_rows(mesh, topology, flow.laplacian),
                                     .time_step = flow.time_step,
                                     .steps = flow.steps,
                                     .cores = flow.resources.tune_for},
                            .threads = flow.resources.threads,
                            .bandwidth_of_one = triad_bandwidth(1),
                            .bandwidth = triad_bandwidth(flow.resources.threads),
                            .chosen = choose_approach(mesh, topology, size, flow).approach,
                            .entries = {}};
    MethodRows rows(mesh);
    rows.find_reference(reference, flow);
    for (const auto& [approach, method] : our_approaches) {
        FlowOptions options = flow;
        options.accuracy.approach = approach;
        const auto tolerance = choose_tolerance(mesh, size, options).tolerance;
        Row row = rows.run(MethodRows::task_of(method, flow));
        rows.measure(row);
        explanation.entries.push_back({predict_cost(approach, explanation.size, tolerance), std::move(row)});
    }
    return explanation;
}

void print_explanation(std::ostream& out, const Explanation& explanation)
{
    const FlowSize& size = explanation.size;
    out << "the model on two cores, in nanoseconds for each vertex, and for each coefficient of its row besides; and "
           "the "
           "part that one core works alone:\n";
    for (const CostConstant& constant : cost_constants())
        out << fmt::format("  {:<36} {:>7.1f} {:>7.1f} {:>7.2f}\n", constant.name, constant.per_vertex,
                           constant.per_coefficient, constant.serial);
    out << fmt::format("memory: {:.3g} GB/s with {} of the flow, {:.3g} GB/s with one (triad)\n",
                       1e-9 * explanation.bandwidth,
                       explanation.threads == 1 ? "the thread" : fmt::format("the {} threads", explanation.threads),
                       1e-9 * explanation.bandwidth_of_one);
    out << fmt::format("{} vertices, {:.2f} coefficients a row beside the diagonal, dt times K/M {:.1f}, {} steps\n"
                       "{:<14} {:>9} {:>9} {:>9}  {:>9} {:>9} {:>9} {:>6} {:>6} {:>9} {:>9}\n"
                       "{:<14} {:>9} {:>9} {:>9}  {:>9} {:>9} {:>9}\n",
                       size.vertices, size.rows.length, size.time_step * size.rows.stiffness, size.steps, "seconds",
                       "predicted", "", "", "measured", "", "", "iter.", "pred.", "V_mean", "V_max", "", "setup",
                       "step", "all", "setup", "step", "all");
    for (const auto& [predicted, row] : explanation.entries) {
        const bool is_chosen = predicted.approach == explanation.chosen;
        out << fmt::format("{:<14} {:>9.4f} {:>9.4f} {:>9.4f}  ",
                           std::string(option_name(predicted.approach)) + (is_chosen ? " *" : ""), predicted.setup,
                           predicted.step, predicted.of(size.steps));
        if (!row.succeeded()) {
            out << row.result.error << '\n';
            continue;
        }
        const bool is_cg = predicted.approach == Approach::ConjugateGradients;
        out << fmt::format("{:>9.4f} {:>9.4f} {:>9.4f} {:>6} {:>6} {:>9} {:>9}\n", row.result.setup_seconds,
                           row.result.step_seconds(), row.result.total_seconds(), row.result.iterations,
                           is_cg ? fmt::format("{:.0f}", size.steps * predicted_iterations(size, *predicted.tolerance))
                                 : "",
                           distance_text(row.v_mean), distance_text(row.v_max));
    }
    out << "*: chosen by default\n" << std::flush;
}

Json explanation_json(const Explanation& explanation)
{
    Json json{{"vertices", explanation.size.vertices},
              {"coefficients", explanation.size.rows.length},
              {"stiffness", explanation.size.rows.stiffness},
              {"time_step", explanation.size.time_step},
              {"steps", explanation.size.steps},
              {"threads", explanation.threads},
              {"triad_bytes_per_second", explanation.bandwidth},
              {"triad_bytes_per_second_one_thread", explanation.bandwidth_of_one},
              {"chosen", option_name(explanation.chosen)}};
    for (const CostConstant& constant : cost_constants())
        json["constants"][std::string(constant.name)] = {constant.per_vertex, constant.per_coefficient,
                                                         constant.serial};
    for (const auto& [predicted, row] : explanation.entries)
        json["approaches"][std::string(option_name(predicted.approach))] = {
            {"predicted",
             {{"setup_s", predicted.setup},
              {"step_s", predicted.step},
              {"all_s", predicted.of(explanation.size.steps)}}},
            {"measured", row_json(row)}};
    return json;
}

}  // namespace seamflow
