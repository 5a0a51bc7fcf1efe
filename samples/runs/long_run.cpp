#include "samples/runs/long_run.h"

#include <exception>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/io/input_file.h"
#include "samples/files/mesh_results.h"
#include "samples/process/exit_status.h"
#include "samples/process/option_words.h"

namespace seamflow {

std::filesystem::path interrupted_path(const std::filesystem::path& output, const std::filesystem::path& input)
{
    std::filesystem::path path = output;
    std::error_code ignored;
    do {
        const std::filesystem::path before = before_extension(path);
        const std::string extension = path.string().substr(before.string().size());
        path = before.string() + ".interrupted" + extension;
    } while (std::filesystem::equivalent(path, input, ignored));
    return path;
}

LongRun::LongRun(const SmoothCommand& command, const MeshFile& file, Interruption& interruption, std::ostream& out)
    : command_(&command)
    , file_(&file)
    , interruption_(&interruption)
    , bar_(command.quiet ? ProgressBar::Shown::Never : ProgressBar::Shown::OnTerminal)
    , room_(command.output, file, command.input)
{
    if (!command.checkpoint.empty()) {
        checkpoints_.emplace(command.checkpoint, command.checkpoint_period);
        try {
            resume_ = checkpoints_->find(file.mesh, command.options);
        } catch (const OptionError& error) {
            if (!command.gives_radius)
                throw;
            throw OptionError(
                sentence(error.wording(), option_of_program) +
                " (--radius is divided among the steps: to continue with more of them, give --time-step)");
        }
    }
    if (resume_ != nullptr)
        out << "resumed    after step " << resume_->n_steps() << ", from " << checkpoints_->file().string()
            << std::endl;
    interruption.begin_work();
}

FlowControl LongRun::control()
{
    FlowControl control{.stop = interruption_->token(), .on_progress = {}, .resume = resume_};
    if (bar_.is_shown())
        control.on_progress = [this](const FlowProgress& progress) {
            bar_.draw(progress, interruption_->token().stop_requested());
        };
    return control;
}

StepObserver LongRun::observing(StepObserver inner)
{
    return [this, inner = std::move(inner)](const StepState& state) {
        bar_.erase();
        // Before anything can fail: the mesh has moved already.
        if (state.separated != nullptr) {
            PolygonMesh separated = *state.separated;
            separated_ = std::move(separated);
        }
        step_ = state.step;
        inner(state);
        if (checkpoints_)
            checkpoints_->save_if_due(state, state.step == command_->options.steps);
    };
}

void LongRun::end()
{
    bar_.erase();
    room_.give_back();
}

ExitStatus LongRun::end_early()
{
    bar_.erase();
    std::string message;
    if (step_ == 0) {
        message = "interrupted before a step was complete; no mesh was written";
    } else {
        message = fmt::format("interrupted; {} has the mesh after step {} of {}", write_last_step().string(), step_,
                              command_->options.steps);
    }
    const int kept = !checkpoints_              ? 0
                     : checkpoints_->step() > 0 ? checkpoints_->step()
                     : resume_                  ? resume_->n_steps()
                                                : 0;
    if (kept > 0)
        message += fmt::format("; the same command continues after step {}", kept);
    say_error(command_->program, message);
    return interruption_->status();
}

void LongRun::keep_last_step()
{
    bar_.erase();
    if (step_ == 0)
        return;
    try {
        const auto path = write_last_step();
        say_error(command_->program,
                  fmt::format("{} has the mesh after step {} of {}", path.string(), step_, command_->options.steps));
    } catch (const std::exception&) {
        // The user needs to know why the flow failed: that is reported.
    }
}

std::filesystem::path LongRun::write_last_step()
{
    room_.give_back();
    const std::filesystem::path output = is_standard_stream(command_->output)
                                             ? std::filesystem::path("smooth" + extension_of(file_->kind.format))
                                             : command_->output;
    const auto path = interrupted_path(output, command_->input);
    MeshOutput(path, *file_, command_->options.motion.weld)
        .write(file_->mesh, separated_ ? &*separated_ : nullptr, run_serially);
    return path;
}

}  // namespace seamflow
