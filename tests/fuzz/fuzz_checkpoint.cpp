// Any bytes as a checkpoint, with a checksum that fits them: they are refused with an InputError, or a flow goes on
// from there, to positions that are finite.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "engine/mean_curvature_flow.h"
#include "engine/state/checkpoint.h"
#include "engine/state/checksum.h"
#include "engine/state/flow_state.h"
#include "partition/errors.h"
#include "tests/fuzz/checkpointed_flow.h"
#include "tests/fuzz/fuzzed_file.h"

namespace {

using namespace seamflow;
using namespace seamflow::test;

/// The bytes with the checksum that they should have.
std::vector<std::uint8_t> with_checksum(std::span<const std::uint8_t> bytes)
{
    std::vector<std::uint8_t> result(bytes.begin(), bytes.end());
    Checksum checksum;
    checksum.add(std::as_bytes(bytes));
    const std::uint64_t value = checksum.value();
    result.resize(result.size() + sizeof value);
    std::memcpy(result.data() + bytes.size(), &value, sizeof value);
    return result;
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t n_bytes)
{
    std::shared_ptr<const FlowState> state;
    try {
        const auto whole = with_checksum({bytes, n_bytes});
        const FuzzedFile file("checkpoint", whole.data(), whole.size());
        state = read_checkpoint(file.path());
    } catch (const InputError&) {
        return 0;
    }
    CheckpointedFlow flow;
    try {
        mean_curvature_flow(flow.mesh, flow.options, {}, {.stop = {}, .on_progress = {}, .resume = state});
    } catch (const InputError&) {
    } catch (const OptionError&) {
    } catch (const ComputationError&) {
    }
    demand(flow.mesh.vertices.allFinite(), "positions are finite");
    return 0;
}
