#include "samples/common/checkpoints.h"

#include <array>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "engine/state/checkpoint.h"
#include "partition/errors.h"
#include "samples/common/command_line.h"

namespace seamflow {

namespace {

constexpr const char* file_name = "smooth.checkpoint";

/// Failures of `body` come out with the name of the file, and what to do.
template <class Body>
void name_file_in_errors(const std::filesystem::path& file, Body&& body)
{
    const auto message = [&](const std::exception& error) {
        return file.string() + ": " + error.what() +
               "; go on with the same input and options, name another folder, or remove it to begin anew";
    };
    try {
        body();
    } catch (const InputError& error) {
        throw InputError(message(error));
    } catch (const OptionError& error) {
        throw OptionError(message(error));
    }
}

}  // namespace

CheckpointPeriod parse_checkpoint_period(std::string_view text)
{
    constexpr std::array<std::pair<std::string_view, double>, 3> units{{{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}}};
    const std::string_view unit = text.substr(text.find_last_of("0123456789.") + 1);
    const std::string_view number = text.substr(0, text.size() - unit.size());
    try {
        if (unit.empty())
            return {.steps = static_cast<int>(parse_integer(number, 1, std::numeric_limits<int>::max()))};
        for (const auto& [name, seconds] : units)
            if (unit == name)
                return {.seconds = seconds * parse_real(number, {0.0, 1e9})};
    } catch (const OptionError&) {
    }
    throw OptionError("\"" + std::string(text) +
                      "\" is neither a number of steps from 1 nor a time: give one with s, min or h");
}

Checkpoints::Checkpoints(const std::filesystem::path& folder, const CheckpointPeriod& period)
    : file_(folder / file_name)
    , period_(period)
{
}

std::shared_ptr<const FlowState> Checkpoints::find(const PolygonMesh& mesh, const FlowOptions& options) const
{
    std::error_code error;
    std::filesystem::create_directories(file_.parent_path(), error);
    if (!std::filesystem::is_directory(file_.parent_path()))
        throw OutputError(file_.parent_path().string() + ": there can be no such folder for checkpoints, " +
                          (error ? error.message() : "for that is a file") + "; name another");
    if (!std::filesystem::exists(file_))
        return nullptr;
    auto state = std::make_shared<const FlowState>(read_checkpoint(file_));
    name_file_in_errors(file_, [&] {
        require_same(state->identity, identify(mesh, options));
        if (state->n_steps() > options.steps)
            throw OptionError(fmt::format("is after step {}, but steps is {}", state->n_steps(), options.steps));
    });
    return state;
}

void Checkpoints::keep(const StepState& state, bool is_last)
{
    if (!is_last && (state.step % period_.steps != 0 || since_kept_.seconds() < period_.seconds))
        return;
    write_checkpoint(file_, state.capture());
    step_ = state.step;
    since_kept_.lap();
}

}  // namespace seamflow
