#pragma once

#include <string>
#include <vector>

#include "samples/figures/experiment.h"
#include "samples/figures/table.h"

namespace seamflow {

/// Curves of the distances to the undecomposed flow over the steps, as SVG: for each decomposed flow of a table a panel
/// with the mean, root mean square and largest V and H, all on the same logarithmic axis, and on the authors' own mesh
/// the results of their code at the end.
/// @returns empty if no flow has two steps or more.
std::string curves_svg(const Table& table, const Experiment& experiment);

/// V_mean and V_max after the last step over the number of sub-meshes, as SVG: for each table and each way of taking
/// steps (the paper's method, the library's defaults) a panel with a curve for each Laplacian.
std::string curves_of_many(const std::vector<Table>& tables);

/// The same over √dt / width, the width of a sub-mesh being the root of its area: for each way of taking steps a panel
/// with the curves of all tables.
std::string curves_over_width(const std::vector<Table>& tables);

}  // namespace seamflow
