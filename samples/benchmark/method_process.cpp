#include "samples/benchmark/method_process.h"

#include <csignal>
#include <cstddef>
#include <exception>
#include <fstream>
#include <new>
#include <string>
#include <utility>

#include <sys/prctl.h>
#include <sys/resource.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "samples/benchmark/process.h"
#include "samples/benchmark/run_method.h"
#include "samples/benchmark/scratch_folder.h"
#include "solvers/platform/blas_work_area.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;

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

/// OpenBLAS never stops asking for the work area of its first call (128 MiB a thread) if the address space is limited
/// and full. Here there is still room, or it is known that there is none.
/// @throws std::bad_alloc if there is no room.
void take_blas_work_areas_within_limit(int threads)
{
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return;
    constexpr std::size_t one_area = std::size_t{130} << 20;
    ::operator delete(::operator new(one_area* static_cast<std::size_t>(threads)));
    take_blas_work_areas();
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
        const MethodTask task = read_task(folder);
        take_blas_work_areas_within_limit(task.options.resources.threads);
        return task.input.empty() ? run_method(read_mesh_for_methods(folder), task) : run_from_file_to_file(task);
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

}  // namespace seamflow
