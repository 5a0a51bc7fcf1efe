#include "samples/files/checkpoints.h"

#include "engine/state/checkpoint.h"
#include "engine/state/flow_identity.h"

namespace seamflow {

namespace {

constexpr const char* file_name = "smooth.checkpoint";

}  // namespace

Checkpoints::Checkpoints(const std::filesystem::path& folder, const CheckpointPeriod& period)
    : file_(folder / file_name)
    , period_(period)
{
}

std::shared_ptr<const FlowState> Checkpoints::find(const PolygonMesh& mesh, const AllOptions& options) const
{
    make_checkpoint_folder(file_.parent_path());
    if (!std::filesystem::exists(file_))
        return nullptr;
    auto state = read_checkpoint(file_);
    require_belongs(file_, state->identity, identity_of(mesh, options), state->n_steps(), options.steps);
    return state;
}

void Checkpoints::save_if_due(const StepState& state, bool is_last)
{
    const double since = since_kept_.seconds();
    if (!is_last && (state.step % period_.steps != 0 || since < period_.seconds ||
                     seconds_of_last_ > period_.most_of_time * (seconds_of_last_ + since)))
        return;
    const Stopwatch saving;
    write_checkpoint(file_, *state.capture());
    step_ = state.step;
    seconds_of_last_ = saving.seconds();
    seconds_ += seconds_of_last_;
    since_kept_.lap();
}

}  // namespace seamflow
