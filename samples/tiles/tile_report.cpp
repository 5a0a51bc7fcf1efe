#include "samples/tiles/tile_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/ranks/peak_memory.h"
#include "partition/text.h"
#include "samples/process/exit_status.h"
#include "samples/process/option_words.h"
#include "samples/report/report_text.h"
#include "samples/runs/command_run.h"

namespace seamflow {

TileReport::TileReport(const SmoothCommand& command, std::ostream& out)
    : command_(command)
    , out_(out)
{
}

void TileReport::print_input(std::span<const TileSummary> tiles, const MeshScale& scale, const FlowOptions& options,
                             const TileRun& run, double width) const
{
    std::int64_t n_vertices = 0;
    std::int64_t n_faces = 0;
    std::int64_t most = 0;
    for (const TileSummary& tile : tiles) {
        n_vertices += tile.n_vertices;
        n_faces += tile.n_faces;
        most = std::max(most, tile.n_vertices);
    }
    RunRecord record;
    record.input = counted(tiles.size(), "file", "files");
    record.scale = scale;
    record.names = flow_names(options, options.steps);
    print_start(out_, record, n_vertices, n_faces, options);
    out_ << fmt::format("tiles      {} vertices at most; {} of {} border vertices coincide with those of other files; "
                        "bands of {:.6g} around each",
                        most, run.n_shared, run.n_border, width)
         << std::endl;
}

void TileReport::add_step(const FlowReport& report, const std::filesystem::path& tile, int step)
{
    if (!missed_tolerance(command_, report.convergence).empty())
        missed_by_.insert(tile);
    convergence_.steps_short_of_tolerance += report.convergence.steps_short_of_tolerance;
    convergence_.steps_stagnated += report.convergence.steps_stagnated;
    has_remarks_on_steps_ = has_remarks_on_steps_ || !report.remarks.empty();
    if (!command_.verbose)
        return;
    out_ << fmt::format("step {} of {}  {}: {:.3f} s", step, command_.options.steps, tile.string(),
                        report.seconds.total);
    for (const auto& remarks : {report.choices, report.remarks})
        for (const Remark& remark : remarks)
            out_ << "  " << sentence(remark, option_of_program);
    out_ << std::endl;
}

void TileReport::add_remark(const std::filesystem::path& tile, const std::string& remark)
{
    const std::size_t begin = remark.find(tile.string());
    const std::string rest = begin == std::string::npos ? remark : remark.substr(begin + tile.string().size());
    const auto same = std::ranges::find(remarks_, rest, &RemarkOnFiles::rest);
    if (same != remarks_.end())
        ++same->n_files;
    else
        remarks_.push_back({remark, rest});
}

void TileReport::add_result(const Points& before, const Points& after)
{
    for (Eigen::Index v = 0; v < before.rows(); ++v)
        moved_.add((after.row(v) - before.row(v)).norm());
    ++n_written_;
}

void TileReport::print_result(double seconds, int threads, const MeshScale& scale) const
{
    out_ << fmt::format("time       {:.3g} s; {}, {:.4g} MB\n", seconds,
                        counted(static_cast<std::uint64_t>(threads), "thread", "threads"),
                        static_cast<double>(peak_memory_bytes()) / 1e6);
    for (const RemarkOnFiles& one : remarks_)
        out_ << "remark     " << one.text
             << (one.n_files == 1 ? "" : fmt::format(" (so it is with {} files in all)", one.n_files)) << '\n';
    if (has_remarks_on_steps_ && !command_.verbose)
        out_ << "remark     There are remarks on the steps of single files; --verbose lists them.\n";
    const LengthStatistics moved = moved_.statistics();
    out_ << fmt::format("result     {} in {}", counted(n_written_ + n_earlier_, "file", "files"),
                        command_.out_dir.string());
    if (n_earlier_ > 0)
        out_ << fmt::format(", {} of them by an earlier run", n_earlier_);
    if (n_written_ > 0)
        out_ << ": " << (n_earlier_ > 0 ? "the others " : "") << moved_in_words(moved, scale.mean_edge);
    out_ << std::endl;
}

ExitStatus TileReport::status() const
{
    if (missed_by_.empty())
        return ExitStatus::Success;
    say_error("smooth", fmt::format("{} of {}; {} has the last state", missed_tolerance(command_, convergence_),
                                    counted(missed_by_.size(), "file", "files"), command_.out_dir.string()));
    return ExitStatus::ComputationFailed;
}

}  // namespace seamflow
