#pragma once

#include <filesystem>
#include <iosfwd>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/measure/flow_report.h"
#include "partition/metrics/length_statistics.h"
#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"
#include "samples/report/mesh_scale.h"
#include "samples/tiles/tile_files.h"
#include "samples/tiles/tile_input.h"

namespace seamflow {

/// What a run over tiles prints.
class TileReport {
  public:
    /// Both must outlive this.
    TileReport(const SmoothCommand& command, std::ostream& out);

    /// Prints the input and the amount.
    /// @param width of bands, in units of length.
    void print_input(std::span<const TileSummary> tiles, const MeshScale& scale, const FlowOptions& options,
                     const TileRun& run, double width) const;

    /// Takes note of the step of a tile, and with --verbose prints it.
    /// @param step from 1.
    void add_step(const FlowReport& report, const std::filesystem::path& tile, int step);

    /// Adds a remark on a file. What is said of several is printed once.
    void add_remark(const std::filesystem::path& tile, const std::string& remark);

    /// Adds the result of a tile.
    /// @param before, after #V by 3.
    void add_result(const Points& before, const Points& after);

    /// Counts a result that an earlier run has written.
    void add_earlier_result() { ++n_earlier_; }

    /// Prints time, memory, remarks and the result.
    void print_result(double seconds, int threads, const MeshScale& scale) const;

    /// Reports steps that missed their tolerance on standard error. @returns how the program ends.
    [[nodiscard]] ExitStatus status() const;

  private:
    struct RemarkOnFiles {
        /// Of the first file, and without its name.
        std::string text;
        std::string rest;
        int n_files = 1;
    };

    const SmoothCommand& command_;
    std::ostream& out_;
    std::vector<RemarkOnFiles> remarks_;
    bool has_remarks_on_steps_ = false;
    LengthSums moved_;
    std::uint64_t n_written_ = 0;
    std::uint64_t n_earlier_ = 0;
    /// Of all steps of tiles; and the tiles that have missed the tolerance.
    ConvergenceReport convergence_;
    std::set<std::filesystem::path> missed_by_;
};

}  // namespace seamflow
