#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "samples/benchmark/grid_cell.h"

namespace seamflow {

/// A mesh for whole runs.
struct WholeRunInput {
    const PolygonMesh& mesh;
    std::string name;
    /// Empty: the mesh is written as `format`.
    std::filesystem::path file;
    /// "obj", "off", "ply" or "stl".
    std::string format;
};

/// The table of whole runs: times from file to file, of `smooth` also its phases (see add_whole_run).
Table whole_run_table(std::ostream& out);

/// Runs `smooth`, which is in the folder of this program, from file to file, a process for each turn, and in turns with
/// it the peers that are as near to the undecomposed flow as ours, on the same file; beside CHOLMOD also one of its
/// steps without files and analysis. The phases of `smooth` are those of one further run; "rest" is the start and the
/// end of the process and all else: what the median of the turns took longer than these phases, or 0.
/// @param time_step_edges dt in squared mean edge lengths.
/// @throws ComputationError if `smooth` fails; as GridRunner.
void add_whole_run(Table& table, const WholeRunInput& input, const FlowOptions& flow, double time_step_edges,
                   const GridOptions& options);

}  // namespace seamflow
