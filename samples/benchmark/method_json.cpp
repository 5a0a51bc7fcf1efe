#include "samples/benchmark/method_json.h"

#include <cstddef>
#include <optional>

namespace seamflow {

namespace {

using MethodJson = nlohmann::json;

MethodJson seconds_json(const StepSeconds& seconds)
{
    return MethodJson::array({seconds.assemble, seconds.prepare, seconds.solve, seconds.total});
}

StepSeconds seconds_of(const MethodJson& json)
{
    return {.assemble = json.at(0), .prepare = json.at(1), .solve = json.at(2), .total = json.at(3)};
}

MethodJson optional_json(const auto& value)
{
    return value ? MethodJson(*value) : MethodJson(nullptr);
}

template <class Value>
std::optional<Value> optional_of(const MethodJson& json)
{
    return json.is_null() ? std::nullopt : std::optional(json.get<Value>());
}

MethodJson simulation_to_json(const Simulation& simulation)
{
    return MethodJson::array({simulation.workers, simulation.work, simulation.makespan,
                              simulation.critical_path_seconds, simulation.critical_path});
}

Simulation simulation_of(const MethodJson& json)
{
    return {.workers = json.at(0),
            .work = json.at(1),
            .makespan = json.at(2),
            .critical_path_seconds = json.at(3),
            .critical_path = json.at(4)};
}

}  // namespace

MethodJson task_json(const MethodTask& task)
{
    const FlowOptions& options = task.options;
    return {{"method", task.method},
            {"laplacian", options.laplacian},
            {"time_step", options.time_step},
            {"steps", options.steps},
            {"subdomains", options.cut.subdomains},
            {"conditions", options.interface.conditions},
            {"q", optional_json(options.interface.q)},
            {"converge", optional_json(options.accuracy.tolerance)},
            {"approach", options.accuracy.approach},
            {"memory_limit", optional_json(options.resources.memory_limit)},
            {"threads", options.resources.threads},
            {"tune_for", options.resources.tune_for},
            {"tolerance", task.tolerance},
            {"simulated_threads", task.simulated_threads},
            {"input", task.input.string()},
            {"output", task.output.string()}};
}

MethodTask task_of(const MethodJson& json)
{
    MethodTask task;
    json.at("method").get_to(task.method);
    json.at("laplacian").get_to(task.options.laplacian);
    json.at("time_step").get_to(task.options.time_step);
    json.at("steps").get_to(task.options.steps);
    json.at("subdomains").get_to(task.options.cut.subdomains);
    json.at("conditions").get_to(task.options.interface.conditions);
    task.options.interface.q = optional_of<double>(json.at("q"));
    task.options.accuracy.tolerance = optional_of<double>(json.at("converge"));
    json.at("approach").get_to(task.options.accuracy.approach);
    task.options.resources.memory_limit = optional_of<std::size_t>(json.at("memory_limit"));
    json.at("threads").get_to(task.options.resources.threads);
    json.at("tune_for").get_to(task.options.resources.tune_for);
    json.at("tolerance").get_to(task.tolerance);
    json.at("simulated_threads").get_to(task.simulated_threads);
    task.input = json.at("input").get<std::string>();
    task.output = json.at("output").get<std::string>();
    return task;
}

MethodJson result_json(const MethodResult& result)
{
    MethodJson steps = MethodJson::array();
    for (const StepSeconds& step : result.steps)
        steps.push_back(seconds_json(step));
    MethodJson simulations = MethodJson::array();
    for (const Simulation& simulation : result.simulations)
        simulations.push_back(simulation_to_json(simulation));
    return {{"error", result.error},
            {"setup_seconds", result.setup_seconds},
            {"steps", steps},
            {"phases", seconds_json(result.phases)},
            {"iterations", result.iterations},
            {"subdomains", result.subdomains},
            {"approach", result.approach},
            {"simulations", simulations},
            {"peak_memory_bytes", result.peak_memory_bytes},
            {"remarks", result.remarks}};
}

MethodResult result_of(const MethodJson& json)
{
    MethodResult result;
    json.at("error").get_to(result.error);
    json.at("setup_seconds").get_to(result.setup_seconds);
    for (const MethodJson& step : json.at("steps"))
        result.steps.push_back(seconds_of(step));
    result.phases = seconds_of(json.at("phases"));
    json.at("iterations").get_to(result.iterations);
    json.at("subdomains").get_to(result.subdomains);
    json.at("approach").get_to(result.approach);
    for (const MethodJson& simulation : json.at("simulations"))
        result.simulations.push_back(simulation_of(simulation));
    json.at("peak_memory_bytes").get_to(result.peak_memory_bytes);
    json.at("remarks").get_to(result.remarks);
    return result;
}

}  // namespace seamflow
