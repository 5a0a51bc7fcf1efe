#include "samples/tiles/tiled_run.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/options/option_table.h"
#include "engine/setup/presets.h"
#include "engine/state/checkpoint.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/io/input_position.h"
#include "samples/files/mesh_results.h"
#include "samples/files/output_files.h"
#include "samples/process/freed_memory.h"
#include "samples/process/interruption.h"
#include "samples/process/peak_memory.h"
#include "samples/report/progress_bar.h"
#include "samples/report/report_text.h"
#include "samples/runs/smoothing_run.h"
#include "samples/tiles/tile_input.h"
#include "samples/tiles/tile_stepper.h"
#include "samples/tiles/tile_union.h"

namespace seamflow {

namespace {

/// Of converged steps, if the user has not chosen how to take steps: what is left does not show along borders.
constexpr double default_tolerance = 1e-5;

/// So many remarks are printed without --verbose.
constexpr std::size_t most_remarks = 8;

/// Adds the place to what an error says.
template <class Work>
void with_name_of(const std::filesystem::path& path, Work&& work)
{
    try {
        work();
    } catch (const InputError& error) {
        throw InputError(path.string() + ": " + error.what());
    } catch (const ComputationError& error) {
        throw ComputationError(path.string() + ": " + error.what());
    }
}

/// The options of the steps.
FlowOptions options_for(const SmoothCommand& command, const MeshScale& scale)
{
    FlowOptions options = command.options;
    with_name_of(command.out_dir, [&] {
        options.time_step = time_step_of(command.amount, scale, options.steps, filter_of(options));
        if (command.attach)
            options.motion.attachment = attachment_of(*command.attach, scale.diagonal);
    });
    options.motion.weld = command.weld ? std::optional(length_of(*command.weld, scale.diagonal)) : std::nullopt;
    if (command.within)
        options.motion.within = length_of(*command.within, scale.diagonal);
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
    {
    }

    ExitStatus run()
    {
        read_all();
        describe();
        interruption_.begin_work();
        const int first = first_step();
        for (int step = first; step <= options_.steps; ++step)
            if (!take_step(step))
                return end_early(step);
        folder_.remove();
        conclude();
        return require_converged();
    }

  private:
    [[nodiscard]] Index n_tiles() const { return static_cast<Index>(tiles_.size()); }
    void read_all();
    void describe() const;
    int first_step();
    bool take_step(int step);
    bool take_step(Index tile, int step);
    void write(Index tile, const Points& positions);
    FlowControl control_for(Index tile, int step);
    void note(const FlowReport& report, Index tile, int step);
    ExitStatus end_early(int step);
    void conclude();
    [[nodiscard]] ExitStatus require_converged() const;

    const SmoothCommand& command_;
    std::ostream& out_;
    Interruption interruption_;
    Workers workers_;
    Executor exec_;
    ProgressBar bar_;
    TileFolder folder_;
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

    std::vector<std::string> remarks_;
    std::size_t n_remarks_of_flows_ = 0;
    LengthSums moved_;
    Index n_written_ = 0;
    /// How many steps of tiles have missed the tolerance.
    int n_missed_ = 0;
    std::string missed_;
};

/// Reads all tiles, to keep them or to find that they are those that were kept.
void TiledRun::read_all()
{
    folder_.make();
    has_resumed_ = folder_.has_run();
    for (const std::filesystem::path& path : command_.tiles) {
        TileInput input = read_tile(path, exec_);
        require_storable(input.file.mesh, command_.out_dir / path.filename(), input.file.kind);
        if (input.left_out.count > 0)
            remarks_.push_back(
                remark_on_faces(input.left_out, command_.out_dir / path.filename(), true, input.file.kind));
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
    const FlowIdentity identity = identify(tiles_, options_);
    if (has_resumed_) {
        run_ = folder_.run();
        require_belongs(folder_.run_file(), run_.identity, identity, 0, options_.steps);
    } else {
        run_.identity = identity;
        join_tiles(folder_, tiles_, options_.motion.weld, run_, exec_);
        folder_.keep(run_);
    }
    return_freed_memory();
}

void TiledRun::describe() const
{
    std::int64_t n_vertices = 0;
    std::int64_t n_faces = 0;
    std::int64_t largest = 0;
    for (const TileSummary& tile : tiles_) {
        n_vertices += tile.n_vertices;
        n_faces += tile.n_faces;
        largest = std::max(largest, tile.n_vertices);
    }
    RunRecord record;
    record.input = counted(tiles_.size(), "file", "files");
    record.scale = scale_;
    print_input(out_, record, n_vertices, n_faces);
    print_amount(out_, scale_, options_);
    out_ << fmt::format("tiles      {} vertices at most; {} of {} border vertices coincide with those of other files; "
                        "bands of {:.6g} around each",
                        largest, run_.n_shared, run_.n_border, width_)
         << std::endl;
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
    const Stopwatch watch;
    try {
        with_name_of(tiles_[at(tile)].path, [&] {
            const TileStepper stepper(folder_, options_, width_);
            note(stepper.take(tile, step, boxes_, control_for(tile, step), exec_, positions), tile, step);
        });
    } catch (const Cancelled&) {
        return false;
    }
    return_freed_memory();
    folder_.take_from_owners(tile, folder_.owners(tile), step, positions);
    next_boxes_[tile] = box_around(positions);
    // First the result: what has a state of the last step is written.
    if (step == options_.steps)
        write(tile, positions);
    folder_.keep_state(tile, step, std::move(positions));
    if (command_.verbose)
        out_ << fmt::format("step {} of {}  {}: {:.3f} s", step, options_.steps, tiles_[at(tile)].path.string(),
                            watch.seconds())
             << std::endl;
    return true;
}

void TiledRun::write(Index tile, const Points& positions)
{
    const TileSummary& summary = tiles_[at(tile)];
    TileInput input = read_tile(summary.path, exec_);
    if (summary_of(summary.path, input.file.mesh, exec_).checksum != summary.checksum)
        throw InputError(summary.path.string() + ": has been changed since the run began; start over with it");
    Points& vertices = input.file.mesh.vertices;
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        moved_.add((positions.row(v) - vertices.row(v)).norm());
    vertices = positions;
    for (const std::string& remark :
         write_state(command_.out_dir / summary.path.filename(), input.file.mesh, nullptr, input.file, exec_))
        remarks_.push_back(remark);
    ++n_written_;
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

void TiledRun::note(const FlowReport& report, Index tile, int step)
{
    bar_.erase();
    if (const std::string missed = missed_tolerance(command_, report.convergence); !missed.empty()) {
        ++n_missed_;
        missed_ = missed;
    }
    n_remarks_of_flows_ += report.remarks.size();
    if (!command_.verbose)
        return;
    for (const std::string& choice : report.choices)
        out_ << fmt::format("step {}, {}: {}\n", step, tiles_[at(tile)].path.string(), choice);
    for (const std::string& remark : report.remarks)
        out_ << fmt::format("step {}, {}: {}\n", step, tiles_[at(tile)].path.string(), remark);
}

ExitStatus TiledRun::end_early(int step)
{
    bar_.erase();
    std::cerr << fmt::format("smooth: interrupted in step {} of {}; the same command continues there\n", step,
                             options_.steps);
    return interruption_.status();
}

void TiledRun::conclude()
{
    bar_.erase();
    out_ << fmt::format("time       {:.3g} s; {}, {:.4g} MB\n", whole_.seconds(),
                        counted(static_cast<std::uint64_t>(workers_.threads()), "thread", "threads"),
                        static_cast<double>(peak_memory_bytes()) / 1e6);
    if (tiles_.size() > 1 && run_.n_shared == 0)
        remarks_.emplace_back(
            "No borders of two files coincide, so that each was smoothed alone: --weld with a small length joins "
            "those that differ a little.");
    const std::size_t n_shown = command_.verbose ? remarks_.size() : std::min(remarks_.size(), most_remarks);
    for (std::size_t i = 0; i < n_shown; ++i)
        out_ << "remark     " << remarks_[i] << '\n';
    if (n_shown < remarks_.size())
        out_ << fmt::format("remark     There are {} more remarks like these; --verbose lists them.\n",
                            remarks_.size() - n_shown);
    if (n_remarks_of_flows_ > 0 && !command_.verbose)
        out_ << "remark     Some steps of single files have remarks; --verbose lists them.\n";
    const LengthStatistics moved = moved_.statistics();
    const double edge = scale_.mean_edge > 0.0 ? scale_.mean_edge : 1.0;
    out_ << fmt::format("result     {} in {}: moved {:.3g} mean edge lengths on average, {:.3g} at most",
                        counted(static_cast<std::uint64_t>(n_written_), "file", "files"), command_.out_dir.string(),
                        moved.mean / edge, moved.max / edge)
         << std::endl;
}

ExitStatus TiledRun::require_converged() const
{
    if (n_missed_ == 0)
        return ExitStatus::Success;
    std::cerr << fmt::format("smooth: {} of {}; {} has the last state\n", missed_,
                             counted(static_cast<std::uint64_t>(n_missed_), "file", "files"),
                             command_.out_dir.string());
    return ExitStatus::ComputationFailed;
}

}  // namespace

ExitStatus smooth_tiles(const SmoothCommand& command)
{
    std::ostream silence(nullptr);
    return TiledRun(command, command.quiet ? silence : std::cout).run();
}

}  // namespace seamflow
