#pragma once

#include <string>

#include "samples/figures/experiment.h"
#include "samples/figures/table.h"

namespace seamflow {

/// Curves of the distances to the undecomposed flow over the steps, as SVG: for each decomposed flow of a table a panel
/// with the mean, root mean square and largest V and H, all on the same logarithmic axis, and on the authors' own mesh
/// what their code gives in the end.
/// @returns empty where no flow has two steps or more.
std::string curves_svg(const Table& table, const Experiment& experiment);

}  // namespace seamflow
