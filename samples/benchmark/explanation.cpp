#include "samples/benchmark/explanation.h"

#include <array>
#include <ostream>
#include <utility>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "engine/setup/cost_model.h"
#include "samples/benchmark/case_json.h"

namespace seamflow {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array approaches{
    std::pair{Approach::Sweep, Method::OurSweep}, std::pair{Approach::Converged, Method::OurConverged},
    std::pair{Approach::ConjugateGradients, Method::OurCg}, std::pair{Approach::Undecomposed, Method::Undecomposed}};

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
                                     .steps = flow.steps},
                            .chosen = choose_approach(mesh, topology, size, flow).approach,
                            .entries = {}};
    MethodRows rows(mesh);
    rows.find_reference(reference, flow);
    for (const auto& [approach, method] : approaches) {
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
    out << "the model, in nanoseconds for each vertex, and for each coefficient of its row besides:\n";
    for (const CostConstant& constant : cost_constants())
        out << fmt::format("  {:<36} {:>7.1f} {:>7.1f}\n", constant.name, constant.per_vertex,
                           constant.per_coefficient);
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
              {"chosen", option_name(explanation.chosen)}};
    for (const CostConstant& constant : cost_constants())
        json["constants"][std::string(constant.name)] = {constant.per_vertex, constant.per_coefficient};
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
