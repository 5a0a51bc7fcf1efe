#include "samples/benchmark/explanation.h"

#include <ostream>
#include <utility>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "engine/setup/automatic_choices.h"
#include "engine/setup/cost_model.h"

namespace seamflow {

Table explanation_table(std::ostream& out)
{
    out << "the model on two cores, in nanoseconds for each vertex, and for each coefficient of its row besides; and "
           "the part that one core works alone:\n";
    for (const CostConstant& constant : cost_constants())
        out << fmt::format("  {:<36} {:>7.1f} {:>7.1f} {:>7.2f}\n", constant.name, constant.per_vertex,
                           constant.per_coefficient, constant.serial);
    out << "seconds as predicted, and as measured; *: chosen by default; row: coefficients beside the diagonal\n\n";
    return {out,
            {{"mesh", "mesh", 20},
             {"vertices", "vertices", 9},
             {"coefficients", "row", 5},
             {"dt_times_stiffness", "dt K/M", 6},
             {"steps", "steps", 5},
             {"approach", "approach", 12},
             {"chosen", "", 1},
             {"predicted_setup_s", "set-up", 8},
             {"predicted_step_s", "step", 8},
             {"predicted_all_s", "all", 8},
             {"predicted_iterations", "iter.", 6},
             {"setup_s", "measured", 8},
             {"step_s", "step", 8},
             {"all_s", "all", 8},
             {"iterations", "iter.", 6},
             {"v_mean", "V_mean", 9},
             {"v_max", "V_max", 9}}};
}

void add_explanation(Table& table, const std::string& name, const PolygonMesh& mesh, const FlowOptions& flow)
{
    const Topology topology = make_topology(mesh);
    const MeshSize size = size_of(mesh);
    const FlowSize flow_size{.vertices = mesh.n_vertices(),
                             .rows = average_rows(mesh, topology, flow.laplacian),
                             .time_step = flow.time_step,
                             .steps = flow.steps,
                             .cores = flow.resources.tune_for};
    const Approach chosen = choose_approach(mesh, topology, size, flow).approach;
    MethodRows rows(mesh);
    rows.find_reference(flow);
    for (const Approach approach :
         {Approach::Sweep, Approach::Converged, Approach::ConjugateGradients, Approach::Undecomposed}) {
        FlowOptions options = flow;
        options.accuracy.approach = approach;
        const auto tolerance = choose_tolerance(mesh, size, options).tolerance;
        const PredictedCost predicted = predict_cost(approach, flow_size, tolerance);
        nlohmann::ordered_json json{{"mesh", name},
                                    {"vertices", mesh.n_vertices()},
                                    {"coefficients", flow_size.rows.length},
                                    {"dt_times_stiffness", flow.time_step * flow_size.rows.stiffness},
                                    {"steps", flow.steps},
                                    {"predicted_setup_s", predicted.setup},
                                    {"predicted_step_s", predicted.step},
                                    {"predicted_all_s", predicted.of(flow.steps)}};
        if (approach == Approach::ConjugateGradients)
            json["predicted_iterations"] = flow.steps * predicted_iterations(flow_size, *predicted.tolerance);
        if (approach == Approach::Sweep)
            options.accuracy.tolerance.reset();
        // Options of sub-meshes mean nothing to the others, which refuse them.
        if (takes_whole_mesh(approach)) {
            options.cut = {};
            options.resources.memory_limit.reset();
        }
        json.update(rows.run(MethodRows::task_of(Method::Ours, options)).json());
        json["approach"] = option_name(approach);
        json["chosen"] = approach == chosen;
        table.add(std::move(json));
    }
}

}  // namespace seamflow
