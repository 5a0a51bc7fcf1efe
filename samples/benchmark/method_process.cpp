#include "samples/benchmark/method_process.h"

#include <csignal>
#include <exception>
#include <fstream>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include <sys/prctl.h>

#include "engine/state/archive.h"
#include "partition/formats/mesh_io.h"
#include "samples/benchmark/run_method.h"
#include "samples/process/process.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;

constexpr const char* this_program = "/proc/self/exe";
constexpr std::string_view line_of_task = "seamflow task of a benchmark\n";
constexpr std::string_view line_of_result = "seamflow result of a benchmark\n";

/// The high-water mark of this process alone, in bytes. That of getrusage includes the parent's.
std::int64_t high_water_mark()
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (std::int64_t kilobytes = 0; word == "VmHWM:" && status >> kilobytes)
            return kilobytes * 1024;
    return 0;
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
        return run_from_file_to_file(read_archive<MethodTask>(folder / "task", line_of_task));
    } catch (const std::bad_alloc&) {
        return failed("out of memory");
    } catch (const std::exception& error) {
        return failed(error.what());
    }
}

}  // namespace

MethodResult run_in_process(const fs::path& folder, const MethodTask& task)
{
    write_archive(folder / "task", line_of_task, task);
    const ProcessEnd end =
        run_process(this_program, {"benchmark", run_method_word, folder.string()}, task.options.resources.threads);
    if (!end.failure.empty())
        return failed(end.failure);
    auto result = read_archive<MethodResult>(folder / "result", line_of_result);
    result.process_seconds = end.seconds;
    return result;
}

void serve_method(const fs::path& folder)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // not to outlive a benchmark that was stopped
    MethodResult result = result_or_error(folder);
    result.peak_memory_bytes = high_water_mark();
    write_archive(folder / "result", line_of_result, result);
}

}  // namespace seamflow
