#include "samples/programs.h"

#include <string>

#include "samples/process/launched_processes.h"
#include "samples/smooth_program.h"
#include "solvers/platform/library_threads.h"

namespace seamflow {

int run_program(std::string_view program, int argc, char** argv)
{
    // The threads that BLAS started when the program was loaded would wait by spinning. None of these programs needs
    // them: the setting stays until the process ends.
    [[maybe_unused]] static const auto* const single_threaded = new SingleThreadedBlas;
    end_threads_of_blas();
    return run_program(std::string(program).c_str(), [&] {
        if (program == "generate")
            return run_generate_program(argc, argv);
        if (program == "compare")
            return run_compare_program(argc, argv);
        if (program == "inspect")
            return run_inspect_program(argc, argv);
        const auto end = refuse_several_processes("smooth");
        return end ? *end : run_smooth_program(argc, argv);
    });
}

}  // namespace seamflow
