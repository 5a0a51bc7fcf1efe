#include "samples/benchmark/method_json.h"

#include <cstddef>
#include <optional>

namespace seamflow {

namespace {

using Json = nlohmann::json;

Json seconds_json(const StepSeconds& seconds)
{
    return Json::array({seconds.assemble, seconds.prepare, seconds.solve, seconds.total});
}

StepSeconds seconds_of(const Json& json)
{
    return {.assemble = json.at(0), .prepare = json.at(1), .solve = json.at(2), .total = json.at(3)};
}

Json optional_json(const auto& value)
{
    return value ? Json(*value) : Json(nullptr);
}

template <class Value>
std::optional<Value> optional_of(const Json& json)
{
    return json.is_null() ? std::nullopt : std::optional(json.get<Value>());
}

Json simulation_json(const Simulation& simulation)
{
    return Json::array({simulation.workers, simulation.work, simulation.makespan, simulation.critical_path_seconds,
                        simulation.critical_path});
}

Simulation simulation_of(const Json& json)
{
    return {.workers = json.at(0),
            .work = json.at(1),
            .makespan = json.at(2),
            .critical_path_seconds = json.at(3),
            .critical_path = json.at(4)};
}

}  // namespace

Json task_json(const MethodTask& task)
{
    const FlowOptions& options = task.options;
    return {{"method", task.method},
            {"laplacian", options.laplacian},
            {"time_step", options.time_step},
            {"steps", options.steps},
            {"subdomains", options.subdomains},
            {"conditions", options.conditions},
            {"q", optional_json(options.q)},
            {"converge", optional_json(options.tolerance)},
            {"approach", options.approach},
            {"memory_limit", optional_json(options.memory_limit)},
            {"threads", options.threads},
            {"tolerance", task.tolerance},
            {"simulated_threads", task.simulated_threads}};
}

MethodTask task_of(const Json& json)
{
    MethodTask task;
    json.at("method").get_to(task.method);
    json.at("laplacian").get_to(task.options.laplacian);
    json.at("time_step").get_to(task.options.time_step);
    json.at("steps").get_to(task.options.steps);
    json.at("subdomains").get_to(task.options.subdomains);
    json.at("conditions").get_to(task.options.conditions);
    task.options.q = optional_of<double>(json.at("q"));
    task.options.tolerance = optional_of<double>(json.at("converge"));
    json.at("approach").get_to(task.options.approach);
    task.options.memory_limit = optional_of<std::size_t>(json.at("memory_limit"));
    json.at("threads").get_to(task.options.threads);
    json.at("tolerance").get_to(task.tolerance);
    json.at("simulated_threads").get_to(task.simulated_threads);
    return task;
}

Json result_json(const MethodResult& result)
{
    Json steps = Json::array();
    for (const StepSeconds& step : result.steps)
        steps.push_back(seconds_json(step));
    Json simulations = Json::array();
    for (const Simulation& simulation : result.simulations)
        simulations.push_back(simulation_json(simulation));
    return {{"error", result.error},
            {"setup_seconds", result.setup_seconds},
            {"steps", steps},
            {"phases", seconds_json(result.phases)},
            {"iterations", result.iterations},
            {"subdomains", result.subdomains},
            {"simulations", simulations},
            {"peak_memory_bytes", result.peak_memory_bytes},
            {"remarks", result.remarks}};
}

MethodResult result_of(const Json& json)
{
    MethodResult result;
    json.at("error").get_to(result.error);
    json.at("setup_seconds").get_to(result.setup_seconds);
    for (const Json& step : json.at("steps"))
        result.steps.push_back(seconds_of(step));
    result.phases = seconds_of(json.at("phases"));
    json.at("iterations").get_to(result.iterations);
    json.at("subdomains").get_to(result.subdomains);
    for (const Json& simulation : json.at("simulations"))
        result.simulations.push_back(simulation_of(simulation));
    json.at("peak_memory_bytes").get_to(result.peak_memory_bytes);
    json.at("remarks").get_to(result.remarks);
    return result;
}

}  // namespace seamflow
