#include "samples/process/launched_processes.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "samples/process/exit_status.h"

namespace seamflow {

namespace {

/// Variables with the number of processes, and which of them this is.
struct Launcher {
    const char* size;
    const char* rank;
};

/// Open MPI; MPICH and Intel MPI; MVAPICH; tasks of a step of Slurm.
constexpr std::array launchers{Launcher{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                               Launcher{"PMI_SIZE", "PMI_RANK"}, Launcher{"MV2_COMM_WORLD_SIZE", "MV2_COMM_WORLD_RANK"},
                               Launcher{"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}};

/// @returns -1 if the variable is not set, or is not a number.
int number_in(const char* variable)
{
    const char* const value = std::getenv(variable);
    const std::string_view text = value != nullptr ? value : "";
    int number = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? number : -1;
}

}  // namespace

std::optional<ExitStatus> refuse_several_processes(const char* program)
{
    for (const Launcher& launcher : launchers) {
        const int size = number_in(launcher.size);
        if (size <= 1)
            continue;
        if (number_in(launcher.rank) <= 0)
            say_error(program, fmt::format("{0} processes were started ({1} is {0}), each of which would write the "
                                           "same file. One process uses all cores of a machine: start {2} alone, "
                                           "without mpirun or srun, or with -n 1",
                                           size, launcher.size, program));
        return ExitStatus::WrongUsage;
    }
    return std::nullopt;
}

}  // namespace seamflow
