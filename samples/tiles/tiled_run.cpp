#include "samples/tiles/tiled_run.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>

#include "engine/motion/resolved_motion.h"
#include "engine/options/option_table.h"
#include "engine/setup/resolved_options.h"
#include "engine/state/checkpoint.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/text.h"
#include "samples/files/mesh_results.h"
#include "samples/files/output_files.h"
#include "samples/process/exit_status.h"
#include "samples/process/interruption.h"
#include "samples/report/progress_bar.h"
#include "samples/tiles/tile_input.h"
#include "samples/tiles/tile_report.h"
#include "samples/tiles/tile_stepper.h"
#include "samples/tiles/tile_union.h"

namespace seamflow {

namespace {

/// Of converged steps, if the user has not chosen how to take steps: what is left does not show along borders.
constexpr double default_tolerance = 1e-5;

/// Adds the place to what an error says.
template <class Work>
void with_name_of(const std::filesystem::path& path, Work&& work)
{
    try {
        work();
    } catch (const InputError& error) {
        throw InputError(Wording{unmarked(path.string() + ": ").text + error.wording().text});
    } catch (const ComputationError& error) {
        throw ComputationError(path.string() + ": " + error.what());
    }
}

bool has_normals(const MeshFile& input, const Executor& exec)
{
    return std::ranges::any_of(extras_of(*input.source, exec), [](const std::string& extra) {
        return extra == "normals" || extra.find("(nx") != std::string::npos || extra.find(" nx") != std::string::npos;
    });
}

/// The options of the steps.
FlowOptions options_for(const SmoothCommand& command, const MeshScale& scale)
{
    FlowOptions options = command.options;
    with_name_of(command.out_dir, [&] {
        LengthScale lengths = scale.lengths();
        options.motion = with_lengths(std::move(options.motion), lengths);
        options.time_step = time_step_of(options, lengths);
    });
    options.time_step_edges.reset();
    options.radius.reset();
    if (options.laplacian == Laplacian::Uniform)
        options.uniform_edge = scale.mean_edge;
    const Approach approach = options.accuracy.approach;
    if (!options.accuracy.tolerance && (approach == Approach::Automatic || approach == Approach::Decomposed) &&
        is_symmetric(options.laplacian) && options.scheme == Scheme::BackwardEuler &&
        first_set(options, concern::sweeps | concern::method).empty() && !is_foreign(options.resources.factorisation))
        options.accuracy.tolerance = default_tolerance;
    return options;
}

class TiledRun {
  public:
    TiledRun(const SmoothCommand& command, std::ostream& out)
        : command_(command)
        , out_(out)
        , interruption_("smooth")
        , workers_(command.options.resources.threads)
        , exec_(workers_.exec())
        , bar_(command.quiet ? ProgressBar::Shown::Never : ProgressBar::Shown::OnTerminal)
        , folder_(command.out_dir / ".seamflow-tiles")
        , report_(command, out)
    {
    }

    ExitStatus run()
    {
        folder_.make();
        has_resumed_ = folder_.has_run();
        try {
            return take_steps();
        } catch (...) {
            // Refused: there is nothing to continue.
            if (!has_resumed_ && !has_stepped_)
                folder_.remove();
            throw;
        }
    }

  private:
    ExitStatus take_steps()
    {
        read_all();
        report_.print_input(tiles_, scale_, options_, run_, width_);
        interruption_.begin_work();
        const int first = first_step();
        write_missing();
        for (int step = first; step <= options_.steps; ++step)
            if (!take_step(step))
                return end_early(step);
        folder_.remove();
        bar_.erase();
        if (run_.n_held > 0)
            report_.add_remark({}, fmt::format("{} where borders of files meet but cannot be joined (files overlap or "
                                               "have other triangles there, three sheets meet, or faces are turned "
                                               "round) {}: cut the files along edges that both have.",
                                               counted(static_cast<std::uint64_t>(run_.n_held), "vertex", "vertices"),
                                               run_.n_held == 1 ? "stays" : "stay"));
        else if (tiles_.size() > 1 && run_.n_shared == 0 && options_.motion.weld)
            report_.add_remark({}, "No borders of two files coincide, so that each was smoothed alone; --weld with a "
                                   "small length joins borders that differ a little.");
        report_.print_result(whole_.seconds(), workers_.threads(), scale_);
        return report_.status();
    }

    [[nodiscard]] Index n_tiles() const { return static_cast<Index>(tiles_.size()); }
    void read_all();
    int first_step();
    bool take_step(int step);
    bool take_step(Index tile, int step);
    void write(Index tile, const Points& positions);
    void write_missing();
    FlowControl control_for(Index tile, int step);
    ExitStatus end_early(int step);

    const SmoothCommand& command_;
    std::ostream& out_;
    Interruption interruption_;
    Workers workers_;
    Executor exec_;
    ProgressBar bar_;
    TileFolder folder_;
    TileReport report_;
    Stopwatch whole_;

    std::vector<TileSummary> tiles_;
    MeshScale scale_;
    FlowOptions options_;
    TileRun run_;
    double width_ = 0.0;
    /// Of the states before the current step, and of those after it, as far as they exist.
    std::vector<BoundingBox> boxes_;
    std::vector<BoundingBox> next_boxes_;
    bool has_resumed_ = false;
    /// Whether a tile has the state of a step.
    bool has_stepped_ = false;
};

/// Reads all tiles, to keep them or to find that they are those that were kept.
void TiledRun::read_all()
{
    for (const std::filesystem::path& path : command_.tiles) {
        TileInput input = read_tile(path, exec_);
        require_storable(input.file.mesh, command_.out_dir / path.filename(), input.file.kind);
        if (input.left_out.count > 0)
            report_.add_remark(path, MeshOutput(path, input.file).remark_on_faces(input.left_out, true));
        tiles_.push_back(summary_of(path, input.file.mesh, exec_));
        if (!has_resumed_)
            keep_input(folder_, n_tiles() - 1, input.file.mesh, exec_);
    }
    scale_ = scale_of(tiles_);
    options_ = options_for(command_, scale_);
    double longest = 0.0;
    for (const TileSummary& tile : tiles_)
        longest = std::max(longest, tile.mean_edge);
    width_ = width_of_bands(options_, longest);
    const std::uint64_t identity = identify(tiles_, options_);
    if (has_resumed_) {
        run_ = folder_.run();
        require_belongs(folder_.run_file(), run_.identity, identity, 0, options_.steps);
    } else {
        run_.identity = identity;
        join_tiles(folder_, tiles_, options_.motion.weld, run_, exec_);
        folder_.save(run_);
    }
    // The C library keeps memory that was freed between other memory.
    malloc_trim(0);
}

/// @returns the step to take; tiles may already have it.
int TiledRun::first_step()
{
    const int done = folder_.latest_step(n_tiles());
    for (Index tile = 0; tile < n_tiles(); ++tile)
        boxes_.push_back(box_around(folder_.state(tile, done)));
    if (has_resumed_)
        out_ << "resumed    after step " << done << ", from " << folder_.path().string() << std::endl;
    return done + 1;
}

/// @returns false if a signal came.
bool TiledRun::take_step(int step)
{
    next_boxes_.assign(boxes_.size(), {});
    for (Index tile = 0; tile < n_tiles(); ++tile) {
        if (folder_.has_state(tile, step)) {
            next_boxes_[tile] = box_around(folder_.state(tile, step));
            continue;
        }
        if (!take_step(tile, step))
            return false;
    }
    boxes_ = next_boxes_;
    for (Index tile = 0; tile < n_tiles(); ++tile)
        folder_.remove_state(tile, step - 1);
    return true;
}

bool TiledRun::take_step(Index tile, int step)
{
    if (interruption_.token().stop_requested())
        return false;
    Points positions;
    try {
        with_name_of(tiles_[usize(tile)].path, [&] {
            const TileStepper stepper(folder_, options_, width_);
            const FlowReport report = stepper.take(tile, step, boxes_, control_for(tile, step), exec_, positions);
            bar_.erase();
            report_.add_step(report, tiles_[usize(tile)].path, step);
        });
    } catch (const Cancelled&) {
        return false;
    }
    malloc_trim(0);
    folder_.take_from_owners(tile, folder_.read<TileOwners>(tile), step, positions);
    next_boxes_[tile] = box_around(positions);
    // First the result: what has a state of the last step is written.
    if (step == options_.steps)
        write(tile, positions);
    folder_.save_state(tile, step, positions);
    has_stepped_ = true;
    return true;
}

/// Of tiles that have the state of the last step: an earlier run has written them.
void TiledRun::write_missing()
{
    std::error_code ignored;
    for (Index tile = 0; tile < n_tiles(); ++tile) {
        if (!folder_.has_state(tile, options_.steps))
            continue;
        if (std::filesystem::exists(command_.out_dir / tiles_[usize(tile)].path.filename(), ignored))
            report_.add_earlier_result();
        else
            write(tile, folder_.state(tile, options_.steps));
    }
}

void TiledRun::write(Index tile, const Points& positions)
{
    const TileSummary& summary = tiles_[usize(tile)];
    TileInput input = read_tile(summary.path, exec_);
    if (summary_of(summary.path, input.file.mesh, exec_).checksum != summary.checksum)
        throw InputError(summary.path.string() + ": has been changed since the run began; start over with it");
    report_.add_result(input.file.mesh.vertices, positions);
    input.file.mesh.vertices = positions;
    const MeshOutput output(command_.out_dir / summary.path.filename(), input.file, options_.motion.weld);
    for (const std::string& remark : output.write(input.file.mesh, nullptr, exec_))
        report_.add_remark(summary.path, remark);
    if (run_.n_shared > 0 && has_normals(input.file, exec_))
        report_.add_remark(summary.path, summary.path.string() +
                                             ": normals of vertices on borders are those of the faces of this file "
                                             "alone; compute them again where borders must not show in shading.");
}

FlowControl TiledRun::control_for(Index tile, int step)
{
    FlowControl control{.stop = interruption_.token(), .on_progress = {}, .resume = nullptr};
    if (bar_.is_shown())
        control.on_progress = [this, tile, step](const FlowProgress& of_tile) {
            FlowProgress progress = of_tile;
            progress.step = step;
            progress.steps = options_.steps;
            progress.fraction = (step - 1 + (tile + of_tile.fraction) / n_tiles()) / options_.steps;
            bar_.draw(progress, interruption_.token().stop_requested());
        };
    return control;
}

ExitStatus TiledRun::end_early(int step)
{
    bar_.erase();
    say_error("smooth",
              fmt::format("interrupted in step {} of {}; the same command continues there", step, options_.steps));
    return interruption_.status();
}

}  // namespace

ExitStatus smooth_tiles(const SmoothCommand& command)
{
    std::ostream silence(nullptr);
    return TiledRun(command, command.quiet ? silence : std::cout).run();
}

}  // namespace seamflow
