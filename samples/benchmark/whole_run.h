#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "samples/benchmark/grid_cell.h"

namespace seamflow {

/// The time of one run of `smooth` by phases, in seconds of wall-clock time.
struct WholeRunPhases {
    double read = 0.0;
    double cut = 0.0;
    double analyse = 0.0;
    double steps = 0.0;
    double write = 0.0;
    /// Start and end of the process, and all else: what the median of the turns before took longer than these phases; 0
    /// where the further run was slower.
    double rest = 0.0;
};

/// `smooth` from file to file, a process for each turn, and the methods that ran in turns with it.
struct WholeRun {
    std::string mesh;
    Index vertices = 0;
    FlowOptions flow;
    /// dt in squared mean edge lengths.
    double time_step_edges = 0.0;
    /// Without the dot.
    std::string format;
    std::uintmax_t file_bytes = 0;
    Turns smooth;
    /// Of one further run.
    WholeRunPhases phases;
    std::size_t peak_memory_bytes = 0;
    /// Distance to the undecomposed flow.
    std::optional<double> v_max;
    std::optional<double> v_mean;
    /// One step by CHOLMOD, without analysis and files; empty without CHOLMOD among the peers.
    Turns cholmod_step;
    /// As near to the undecomposed flow as ours: see GridRunner.
    std::vector<Row> peers;

    /// Medians: all of `smooth` divided by a step of CHOLMOD.
    [[nodiscard]] double ratio_to_cholmod_step() const;
};

/// Writes the mesh in a format, unless it is a file already, and runs `smooth`, which is in the folder of this program,
/// and the peers on that file.
/// @param given the file of the mesh; empty: it is written as `format`.
/// @param time_step_edges dt in squared mean edge lengths.
/// @throws ComputationError if `smooth` fails; as GridRunner.
WholeRun run_whole(const PolygonMesh& mesh, const std::filesystem::path& given, const std::string& format,
                   const FlowOptions& flow, double time_step_edges, const GridOptions& options);

void print_whole_run(std::ostream& out, const WholeRun& run);
nlohmann::ordered_json whole_run_json(const WholeRun& run);

}  // namespace seamflow
