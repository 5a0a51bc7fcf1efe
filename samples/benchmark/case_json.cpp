#include "samples/benchmark/case_json.h"

namespace seamflow {

namespace {

using Json = nlohmann::ordered_json;

Json simulation_json(const Simulation& simulation)
{
    return {{"threads", simulation.workers},
            {"makespan_s", simulation.makespan},
            {"work_s", simulation.work},
            {"speed_up", simulation.speed_up()},
            {"efficiency", simulation.efficiency()},
            {"critical_path_s", simulation.critical_path_seconds},
            {"critical_path_tasks", simulation.critical_path.size()}};
}

}  // namespace

Json row_json(const Row& row)
{
    if (!row.succeeded())
        return {{"error", row.result.error}};
    const StepSeconds& phases = row.result.phases;
    Json json{{"setup_s", row.result.setup_seconds},
              {"step_s", row.result.step_seconds()},
              {"all_s", row.result.total_seconds()},
              {"phases", {{"assemble", phases.assemble}, {"prepare", phases.prepare}, {"solve", phases.solve}}},
              {"peak_memory_bytes", row.result.peak_memory_bytes},
              {"threads", row.task.options.resources.threads}};
    if (row.v_mean && row.v_max) {
        json["v_mean"] = *row.v_mean;
        json["v_max"] = *row.v_max;
    }
    if (is_iterative(row.task.method))
        json["tolerance"] = row.task.tolerance;
    if (row.result.iterations > 0)
        json["iterations"] = row.result.iterations;
    if (is_ours(row.task.method)) {
        json["approach"] = row.result.approach;
        json["subdomains"] = row.result.subdomains;
        json["remarks"] = row.result.remarks;
    }
    return json;
}

Json case_json(const std::string& mesh, double dt_over_h2, const CaseOptions& options, const CaseResult& result)
{
    Json json{{"mesh", mesh},
              {"vertices", result.vertices},
              {"faces", result.faces},
              {"laplacian", name_of(options.flow.laplacian)},
              {"time_step", options.flow.time_step},
              {"dt_over_h2", dt_over_h2},
              {"steps", options.flow.steps},
              {"threads", options.flow.resources.threads},
              {"reference", result.reference},
              {"ours", row_json(result.ours)}};
    if (result.ours_one_thread)
        json["ours_one_thread"] = row_json(*result.ours_one_thread);
    json["peers"] = json["ratios"] = json["ratios_one_thread"] = Json::object();
    for (const Row& peer : result.peers) {
        json["peers"][peer.name] = row_json(peer);
        if (!peer.succeeded())
            continue;
        json["ratios"][peer.name] = ratio(result, peer);
        if (const auto one_thread = ratio_one_thread(result, peer))
            json["ratios_one_thread"][peer.name] = *one_thread;
    }
    if (!result.ours.result.simulations.empty()) {
        Json& list = json["simulated_threads"] = Json::array();
        for (const Simulation& simulation : result.ours.result.simulations)
            list.push_back(simulation_json(simulation));
    }
    return json;
}

}  // namespace seamflow
