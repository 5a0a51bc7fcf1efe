#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "samples/benchmark/grid_cell.h"

namespace seamflow {

/// The name of a row, with the tolerance of an iterative method: "cg 1e-03".
std::string name_with_tolerance(const Row& row);

/// The table of a grid, a line for each cell as soon as it is known.
void print_grid_head(std::ostream& out);
void print_grid_cell(std::ostream& out, const GridCell& cell);

/// Prints the meaning of the numbers; a table of the ratios in Markdown, with a line for each mesh and a column for
/// each time step with all numbers of steps; and the cells in which ours is not the fastest, with the margins.
/// @param cells mesh by mesh, for each dt by dt.
void print_grid_summary(std::ostream& out, const std::vector<GridCell>& cells);

nlohmann::ordered_json grid_cell_json(const GridCell& cell);

}  // namespace seamflow
