// Smooths a mesh: reads it, cuts it into sub-meshes, runs the flow and writes the result.
//
// What runs in each step, for every sub-mesh at once (one task graph, no barrier in between):
//
//     assemble and factorise ──► solve ──► correct the interface
//                                  ▲         ▲
//        solve of the adjacent ────┘         └─ solve of all sub-meshes around
//        sub-meshes of lower colour
//        that it takes values from

#include "samples/smooth_program.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>

#include "engine/ranks/rank_group.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "partition/io/input_file.h"
#include "samples/command/smooth_command.h"
#include "samples/files/about_file.h"
#include "samples/files/mesh_input.h"
#include "samples/files/mesh_results.h"
#include "samples/files/output_files.h"
#include "samples/options/smooth_surface.h"
#include "samples/process/interruption.h"
#include "samples/report/mesh_scale.h"
#include "samples/report/report_json.h"
#include "samples/report/report_text.h"
#include "samples/report/surface_remarks.h"
#include "samples/runs/begin_page.h"
#include "samples/runs/command_run.h"
#include "samples/runs/field_run.h"
#include "samples/runs/long_run.h"
#include "samples/runs/named_files.h"
#include "samples/runs/run_reports.h"
#include "samples/runs/smoothing_run.h"
#include "samples/runs/step_results.h"
#include "samples/tiles/tiled_run.h"

namespace seamflow {

namespace {

/// Reads, flows and writes.
/// @param run holds the command line.
ExitStatus run(SmoothCommand& command, RunRecord& run, RankGroup* ranks)
{
    Interruption interruption(command.program);
    std::ostream& out = *command.messages;
    const Stopwatch whole;
    Workers workers(command.options.resources.threads);
    const Executor exec = workers.exec();
    FaultLog left_out{.of_faces_alone = true};
    MeshFile file = read_surface(command.input, command.options.motion.strict ? nullptr : &left_out, exec);
    read_named_files(command, file.mesh, left_out.faces_left_out);
    run.read_seconds = whole.seconds();
    run.scale = measure_scale(file.mesh, exec);
    about_file(command.input, [&] { resolve_amount(command, file.mesh, exec, run); });
    run.choose_seconds = whole.seconds() - run.read_seconds;
    print_start(out, run, file.mesh.n_vertices(), file.mesh.n_faces(), command.options);
    const MeshOutput output(command.output, file, command.options.motion.weld);
    output.require_storable();
    std::optional<MeshOutput> steps;
    if (command.every_step)
        steps.emplace(command.every_step->path(1), file, command.options.motion.weld).require_storable();
    const std::vector<std::string> losses =
        output.remarks_on_input(command.input, left_out, !command.options.report.keep_gaps, exec);
    std::optional<PageFlow> page = begin_page(command, file, left_out.faces_left_out, workers);
    std::optional<SurfaceChangeMeter> change;
    if (!command.quiet || !command.report.empty() || !command.html.empty())
        change.emplace(file.mesh, exec);
    LongRun long_run(command, file, interruption, out);
    const StepObserver on_step = long_run.observing(
        show_and_write_steps(command, steps, file.mesh, run.scale.mean_edge, run.write_seconds, page, out, exec));
    SmoothReport report;
    try {
        FlowControl control = long_run.control();
        control.ranks = ranks;
        report =
            about_file(command.input, [&] { return smooth_surface(file.mesh, command.options, on_step, control); });
        if (control.resume != nullptr && command.every_step)
            report.remarks.push_back("--every-step wrote no files for the steps up to " +
                                     std::to_string(control.resume->n_steps()) + ", which an earlier run took.");
    } catch (const Cancelled&) {
        return long_run.end_early();
    } catch (const ComputationError&) {
        long_run.keep_last_step();
        throw;
    } catch (const std::bad_alloc&) {
        long_run.keep_last_step();
        throw;
    }
    long_run.end();
    run.checkpoint_seconds = long_run.checkpoint_seconds();
    // The C library keeps memory that was freed between other memory.
    malloc_trim(0);
    report.remarks.insert(report.remarks.begin(), run.remarks.begin(), run.remarks.end());
    // Without steps, the choices do not matter.
    if (command.options.steps == 0)
        report.choices.clear();
    // A run that continues from its last step has nothing to observe.
    if (page && !page->has_undecomposed() && page->states().back().step < command.options.steps)
        page->add_step(command.options.steps, file.mesh.vertices, nullptr);

    // Before the result is there: memory may not suffice.
    if (change)
        run.surface = change->measure(file.mesh, report.mesh, command.self_intersections, exec);
    const Stopwatch writing;
    for (const auto& remarks : {losses, output.write(file.mesh, report.separated ? &*report.separated : nullptr, exec)})
        report.remarks.insert(report.remarks.end(), remarks.begin(), remarks.end());
    if (!command.parts.empty())
        write_labelled_ply(command.parts, file.mesh, report.cut.labels, exec);
    run.write_seconds += writing.seconds();
    if (change) {
        remark_on_loss(command.options, run.surface, report.remarks);
        remark_on_folds(command.options, run.surface, report.remarks);
    }
    if (page && !page->remark().empty())
        report.remarks.push_back(page->remark());
    complete_record(run, report);
    run.seconds = whole.seconds();
    write_reports(command, run, report, page);
    if (command.verbose)
        print_details(out, run, command.options, report);
    if (ranks != nullptr)
        print_ranks(out, run, ranks->size());
    print_result(out, run, report);
    return require_converged(command, report.convergence);
}

/// Each rank has its part of the threads of its machine, or as many as the command line says. Rank 0 works alone with
/// those of all ranks on its machine.
void share_threads(SmoothCommand& command, RankGroup& ranks)
{
    int& threads = command.options.resources.threads;
    const int n_here = ranks.n_on_this_machine();
    if (command.chooses_threads) {
        const int of_machine = threads > 0 ? threads : n_threads_of_arena();
        ranks.set_threads_of_each(std::max(1, of_machine / n_here));
    } else {
        ranks.set_threads_of_each(threads);
        threads = std::min(threads * n_here, most_threads);
    }
}

/// Removes the report of an earlier run that a refused command line names, so that nobody takes it for that of this
/// one. Other files stay.
void remove_stale_report(std::span<char* const> arguments)
{
    constexpr std::string_view option = "--report";
    std::filesystem::path report;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        const std::string_view word = arguments[i];
        if (word == option && i + 1 < arguments.size())
            report = arguments[i + 1];
        else if (word.starts_with(option) && word.substr(option.size()).starts_with("="))
            report = word.substr(option.size() + 1);
    }
    const std::string beginning = smooth_failure_json({}, {}).substr(0, sizeof "{\n  \"schema\":");
    std::string found(beginning.size(), ' ');
    if (std::ifstream(report).read(found.data(), static_cast<std::streamsize>(found.size())) && found == beginning) {
        std::error_code ignored;
        std::filesystem::remove(report, ignored);
    }
}

/// parse_smooth_command, which leaves no report of an earlier run where it refuses.
std::optional<ExitStatus> parse(int argc, char** argv, SmoothCommand& command, const SmoothProgram& program)
{
    const std::span<char* const> arguments(argv, static_cast<std::size_t>(argc));
    try {
        const auto end = parse_smooth_command(argc, argv, command, program);
        if (end == ExitStatus::WrongUsage)
            remove_stale_report(arguments);
        return end;
    } catch (...) {
        remove_stale_report(arguments);
        throw;
    }
}

}  // namespace

ExitStatus run_smooth_program(int argc, char** argv, const SmoothProgram& program, RankGroup* ranks)
{
    SmoothCommand command;
    if (const auto end = parse(argc, argv, command, program))
        return *end;
    if (!command.out_dir.empty())
        return smooth_tiles(command);
    if (ranks != nullptr)
        share_threads(command, *ranks);
    RunRecord record = begin_record(command);
    record.input = command.input.string();
    record.output = command.output.string();
    try {
        return command.fields.exists() ? run_fields(command, record, ranks) : run(command, record, ranks);
    } catch (...) {
        // The report has the message of standard error, if it can be written.
        try {
            if (!command.report.empty())
                write_text(command.report, smooth_failure_json(record, current_failure()));
        } catch (const OutputError&) {
        }
        throw;
    }
}

}  // namespace seamflow
