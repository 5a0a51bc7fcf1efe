// Makes the checkpoints that fuzzing begins with: make_checkpoint_seeds DIRECTORY.

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/mean_curvature_flow.h"
#include "engine/state/checkpoint.h"
#include "tests/fuzz/checkpointed_flow.h"
#include "tests/fuzz/seeds.h"

namespace {

using namespace seamflow;
using namespace seamflow::test;

/// Without their checksums, which are the harness's.
void make_checkpoints(const std::filesystem::path& root)
{
    const Seeds seeds(root, "checkpoint");
    CheckpointedFlow flow;
    std::vector<std::filesystem::path> written;
    mean_curvature_flow(flow.mesh, flow.options, [&](const StepState& state) {
        written.push_back(seeds.path("step" + std::to_string(written.size() + 1)));
        write_checkpoint(written.back(), *state.capture());
    });
    for (const auto& path : written)
        std::filesystem::resize_file(path, std::filesystem::file_size(path) - sizeof(std::uint64_t));
    seeds.words({"seamflow checkpoint\\x0a", "\\xff\\xff\\xff\\xff\\xff\\xff\\xff\\xff",
                 "\\x00\\x00\\x00\\x00\\x00\\x00\\xf8\\x7f", "\\x00\\x00\\x00\\x00\\x00\\x00\\xf0\\x7f"});
}

}  // namespace

int main(int n, char** arguments)
{
    if (n != 2) {
        std::fprintf(stderr, "usage: make_checkpoint_seeds DIRECTORY\n");
        return 2;
    }
    try {
        make_checkpoints(arguments[1]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_checkpoint_seeds: %s\n", error.what());
        return 1;
    }
}
