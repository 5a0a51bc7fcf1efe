#include "samples/benchmark/method_process.h"

#include <csignal>
#include <cstddef>
#include <exception>
#include <fstream>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>
#include <sys/prctl.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "samples/benchmark/process.h"
#include "samples/benchmark/run_method.h"
#include "samples/files/output_files.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;
using TaskJson = nlohmann::json;

constexpr const char* task_file = "task.json";
constexpr const char* result_file = "result.json";
constexpr const char* this_program = "/proc/self/exe";

/// The high-water mark of this process alone, in bytes. That of getrusage includes the parent's.
std::int64_t high_water_mark()
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (std::int64_t kilobytes = 0; word == "VmHWM:" && status >> kilobytes)
            return kilobytes * 1024;
    return 0;
}

TaskJson read_json(const fs::path& path)
{
    std::ifstream file(path);
    TaskJson json = TaskJson::parse(file, nullptr, false);
    if (json.is_discarded())
        throw InputError(path.string() + ": cannot be read");
    return json;
}

void write_result(const fs::path& folder, const MethodResult& result)
{
    write_text(folder / result_file, TaskJson{{"error", result.error},
                                              {"setup_seconds", result.setup_seconds},
                                              {"steps", result.steps},
                                              {"iterations", result.iterations},
                                              {"approach", result.approach},
                                              {"peak_memory_bytes", result.peak_memory_bytes}}
                                         .dump());
}

/// @returns without positions, which are in the file of the task.
MethodResult read_result(const fs::path& folder)
{
    const TaskJson json = read_json(folder / result_file);
    MethodResult result;
    json.at("error").get_to(result.error);
    json.at("setup_seconds").get_to(result.setup_seconds);
    json.at("steps").get_to(result.steps);
    json.at("iterations").get_to(result.iterations);
    json.at("approach").get_to(result.approach);
    json.at("peak_memory_bytes").get_to(result.peak_memory_bytes);
    return result;
}

MethodResult run_from_file_to_file(const MethodTask& task)
{
    MeshFile file = read_mesh(task.input);
    MethodResult result = run_method(file.mesh, task);
    file.mesh.vertices = std::exchange(result.positions, Points(0, 3));
    write_mesh_like(*file.source, task.output, file.mesh);
    return result;
}

MethodResult result_or_error(const fs::path& folder)
{
    try {
        return run_from_file_to_file(read_task(folder));
    } catch (const std::bad_alloc&) {
        return failed("out of memory");
    } catch (const std::exception& error) {
        return failed(error.what());
    }
}

}  // namespace

MethodResult run_in_process(const fs::path& folder, const MethodTask& task)
{
    write_task(folder, task);
    const ProcessEnd end =
        run_process(this_program, {"benchmark", run_method_word, folder.string()}, task.options.resources.threads);
    if (!end.failure.empty())
        return failed(end.failure);
    MethodResult result = read_result(folder);
    result.process_seconds = end.seconds;
    return result;
}

void serve_method(const fs::path& folder)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // not to outlive a benchmark that was stopped
    MethodResult result = result_or_error(folder);
    result.peak_memory_bytes = high_water_mark();
    write_result(folder, result);
}

void write_task(const fs::path& folder, const MethodTask& task)
{
    const FlowOptions& options = task.options;
    const auto optional = [](const auto& value) { return value ? TaskJson(*value) : TaskJson(nullptr); };
    write_text(folder / task_file, TaskJson{{"method", task.method},
                                            {"laplacian", options.laplacian},
                                            {"time_step", options.time_step},
                                            {"steps", options.steps},
                                            {"subdomains", options.cut.subdomains},
                                            {"converge", optional(options.accuracy.tolerance)},
                                            {"approach", options.accuracy.approach},
                                            {"memory_limit", optional(options.resources.memory_limit)},
                                            {"threads", options.resources.threads},
                                            {"tune_for", options.resources.tune_for},
                                            {"tolerance", task.tolerance},
                                            {"input", task.input.string()},
                                            {"output", task.output.string()}}
                                       .dump());
}

MethodTask read_task(const fs::path& folder)
{
    const TaskJson json = read_json(folder / task_file);
    MethodTask task;
    FlowOptions& options = task.options;
    json.at("method").get_to(task.method);
    json.at("laplacian").get_to(options.laplacian);
    json.at("time_step").get_to(options.time_step);
    json.at("steps").get_to(options.steps);
    json.at("subdomains").get_to(options.cut.subdomains);
    if (const TaskJson& tolerance = json.at("converge"); !tolerance.is_null())
        options.accuracy.tolerance = tolerance.get<double>();
    json.at("approach").get_to(options.accuracy.approach);
    if (const TaskJson& limit = json.at("memory_limit"); !limit.is_null())
        options.resources.memory_limit = limit.get<std::size_t>();
    json.at("threads").get_to(options.resources.threads);
    json.at("tune_for").get_to(options.resources.tune_for);
    json.at("tolerance").get_to(task.tolerance);
    task.input = json.at("input").get<std::string>();
    task.output = json.at("output").get<std::string>();
    return task;
}

}  // namespace seamflow
