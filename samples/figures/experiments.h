#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "samples/figures/experiment.h"

namespace seamflow {

/// q of the flows with adapted Ventcell conditions, for which the paper has no number: as much of the second derivative
/// along the interface as the Laplacian itself has.
inline constexpr double ventcell_q = 1.0;

/// All experiments, in the order of the paper.
const std::vector<Experiment>& experiments();

/// The name of the experiments with 2, 4, 8, 16 and 32 sub-meshes, which the paper does not have.
inline constexpr std::string_view many_sub_meshes = "subdomains";

/// The decomposed flows of an experiment with 2, 4, 8, 16 and 32 sub-meshes by METIS, plain and by the library's
/// defaults, instead of its own; only for Laplacians whose decomposed flow the figure shows.
Experiment with_many_sub_meshes(const Experiment& experiment);

/// The options of one flow on the mesh of its figure. With CutKind::Halves they follow the paper to the letter, except
/// for AuthorsRun on the authors' own mesh.
FlowOptions options_of(const Experiment& experiment, const Variant& variant, const FigureMesh& mesh);

/// The command line by which `smooth` repeats a flow from the files that `figures` writes.
std::string command_of(const Experiment& experiment, const Variant& variant, const FigureMesh& mesh);

}  // namespace seamflow
