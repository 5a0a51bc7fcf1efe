#include "engine/state/checkpoint.h"

#include <string_view>
#include <system_error>
#include <tuple>

#include <fmt/format.h>

#include "engine/state/archive.h"
#include "engine/state/flow_state.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

constexpr std::string_view first_line = "seamflow checkpoint\n";

}  // namespace

auto fields(Is<LengthStatistics> auto& of)
{
    auto& [mean, rms, max] = of;
    return std::tie(mean, rms, max);
}

auto fields(Is<DisplacementStatistics> auto& of)
{
    auto& [tangential, normal] = of;
    return std::tie(tangential, normal);
}

auto fields(Is<VertexDistance> auto& of)
{
    auto& [mean, rms, max, mean_edge] = of;
    return std::tie(mean, rms, max, mean_edge);
}

auto fields(Is<PhaseSeconds> auto& of)
{
    auto& [cut, analyse, assemble, factorise, solve, correct, interface, step, total] = of;
    return std::tie(cut, analyse, assemble, factorise, solve, correct, interface, step, total);
}

auto fields(Is<DisplacementSums> auto& of)
{
    auto& [drift, tangential, normal] = of;
    return std::tie(drift, tangential, normal);
}

auto fields(Is<StepMemory> auto& of)
{
    auto& [positions, arrays, numbers] = of;
    return std::tie(positions, arrays, numbers);
}

auto fields(Is<FlowState> auto& of)
{
    auto& [identity, approach, cut, steps, seconds, displacement, flow, reference] = of;
    return std::tie(identity, approach, cut, steps, seconds, displacement, flow, reference);
}

void write_checkpoint(const std::filesystem::path& file, const FlowState& state)
{
    write_archive(file, first_line, state);
}

std::shared_ptr<const FlowState> read_checkpoint(const std::filesystem::path& file)
{
    return std::make_shared<const FlowState>(read_archive<FlowState>(file, first_line));
}

void make_checkpoint_folder(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
        throw OutputError(fmt::format("{}: cannot create this folder for checkpoints: {}; name another",
                                      folder.string(), error ? error.message() : "it is a file"));
}

void require_belongs(const std::filesystem::path& file, std::uint64_t of_state, std::uint64_t of_flow,
                     std::int64_t step, int steps)
{
    constexpr const char* what_to_do =
        "continue with the same input and options, name another folder, or remove it to start over";
    if (of_state != of_flow)
        throw InputError(
            fmt::format("{}: belongs to another input or to other options; {}", file.string(), what_to_do));
    if (step > steps)
        throw OptionError(
            fmt::format("{}: is after step {}, but steps is {}; {}", file.string(), step, steps, what_to_do));
}

}  // namespace seamflow
