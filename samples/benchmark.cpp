// Compares one implicit step of ours with the alternatives of a user.
//
//     mesh ──► file ──► a process for each method ──► file, times, memory ──► rows of one table, or of JSON
//                       (ours, CHOLMOD, conjugate
//                       gradients, BoomerAMG)

#include <iostream>
#include <string_view>

#include "samples/benchmark/benchmark_command.h"
#include "samples/benchmark/method_process.h"
#include "samples/benchmark/runs.h"
#include "samples/files/output_files.h"

using namespace seamflow;

namespace {

ExitStatus benchmark(int argc, char** argv)
{
    if (argc == 3 && std::string_view(argv[1]) == run_method_word) {
        serve_method(argv[2]);
        return ExitStatus::Success;
    }
    BenchmarkCommand command;
    if (const auto end = parse_benchmark_command(argc, argv, command))
        return *end;
    const auto json = run_benchmark(command, std::cout);
    if (!command.json.empty())
        write_text(command.json, json.dump(2) + "\n");
    return ExitStatus::Success;
}

}  // namespace

int main(int argc, char** argv)
{
    return run_program("benchmark", [&] { return benchmark(argc, argv); });
}
