#include "samples/command/distributed_command.h"

#include "engine/options/option_table.h"
#include "engine/setup/presets.h"
#include "partition/errors.h"
#include "samples/command/command_help.h"
#include "samples/command/command_line.h"
#include "samples/command/presets.h"

namespace seamflow {

namespace {

/// Options that concern the whole mesh, or show the tasks of one process.
std::vector<SmoothProgram::Lack> lacks()
{
    const char* const one_process = "it needs the whole mesh in one process; use smooth";
    std::vector<SmoothProgram::Lack> list{
        {"--noise", "its amount needs the whole mesh; give --time-step, --time-step-edges or --radius"}};
    for (const OptionTraits& one : all_options())
        if ((one.concerns & concern::one_process) != 0 && !one.option.empty())
            list.push_back({std::string(one.option), one_process});
    for (const char* const own : {"--edges-from-file", "--self-intersections", "--trace", "--task-graph", "--html",
                                  "--out-dir", "--fill", "--keep-field-edges", "--from"})
        list.push_back({own, one_process});
    return list;
}

/// Ranks take steps in sub-meshes: sweeps unless a tolerance, a free boundary, the linear flow, a region or fields are
/// asked for; the latter four are for converged steps.
void settle_approach(SmoothCommand& command)
{
    FlowOptions& options = command.options;
    AccuracyOptions& accuracy = options.accuracy;
    if (accuracy.approach != Approach::Automatic && accuracy.approach != Approach::Decomposed)
        return;
    const bool shares_boundary = options.motion.boundary == Boundary::Free && options.interface == InterfaceOptions();
    const bool is_converged = accuracy.tolerance || shares_boundary || options.flow == FlowEquation::Linear ||
                              !command.region.empty() || command.fields.exists();
    accuracy.approach = is_converged ? Approach::Converged : Approach::Sweep;
}

}  // namespace

std::optional<ExitStatus> parse_distributed_command(int argc, char** argv, int rank, DistributedCommand& command)
{
    std::optional<std::size_t> whole_up_to;
    const SmoothProgram program{
        .name = "smooth-distributed",
        .description = "Smooths a mesh as smooth does, on as many ranks of MPI as mpirun starts: mpirun -n 4 "
                       "smooth-distributed INPUT OUTPUT …",
        .lacks = lacks(),
        .examples = "mpirun -n 4 smooth-distributed scan.ply smooth.ply --radius 1%   four ranks, each with a quarter\n"
                    "mpirun -n 4 smooth-distributed scan.ply smooth.ply --time-step-edges 5 --converge 1e-6   exact "
                    "steps\n"
                    "mpirun -n 4 smooth-distributed scan.ply smooth.ply --fields quality --fwhm 1%   numbers of the "
                    "vertices\n"
                    "mpirun -n 4 smooth-distributed scan.ply smooth.ply --radius 1% --steps 50 --checkpoint state   "
                    "continues where it was stopped\n",
        .add_own =
            [&](CLI::App& app) {
                app.get_option("--approach")
                    ->type_name("auto|decomposed|sweep|converged")
                    ->description(
                        "how a step is taken [sweep; converged with --converge, --boundary free, --flow linear or "
                        "--region or --fields]\n"
                        "sweep: one sweep over the sub-meshes; converged: these converge to the undecomposed "
                        "step.");
                app.get_option("--fwhm")->description(
                    "full width at half maximum of the smoothing, over all steps together; 10 steps unless told "
                    "otherwise\nOnly smooth measures the width that was reached.");
                app.get_option("--conditions")->type_name("adapted-robin|adapted-ventcell");
                app.get_option("--preset")
                    ->type_name("fair")
                    ->description("options that suit a kind of mesh\nOnly smooth, which has the whole mesh, measures "
                                  "noise and keeps edges.");
                app.option_defaults()->group(option_group::machine);
                add_bytes(app, "--whole-up-to", whole_up_to,
                          "rank 0 alone reads and writes files of up to so many bytes, in any format [16MiB]\n"
                          "--feather is for such files only.");
            },
        .checks_files = rank == 0};
    if (const auto end = parse_smooth_command(argc, argv, command.flow, program))
        return end;
    if (command.flow.options.keep_edges)
        throw OptionError("--preset cad keeps edges, which needs the whole mesh: use smooth");
    if (command.flow.chooses_amount) {
        const PresetTraits& preset = preset_of(command.flow.preset);
        if (preset.measures_noise() || command.flow.options.denoise)
            throw OptionError("say how much to smooth with --time-step, --time-step-edges, --radius or --preset fair: "
                              "only smooth, which has the whole mesh, can measure its noise");
        command.flow.amount = {.time_step_edges = preset.time_step_edges, .radius = preset.radius};
        command.flow.chosen += amount_of(preset);
    }
    settle_approach(command.flow);
    if (whole_up_to)
        command.sharing.whole_up_to = *whole_up_to;
    return std::nullopt;
}

}  // namespace seamflow
