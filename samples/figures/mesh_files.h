#pragma once

#include <filesystem>
#include <string_view>

#include "samples/figures/experiment.h"

namespace seamflow {

/// Writes FIGURE-input.ply, and where the mesh is cut in two FIGURE-cut.txt, the label of each face.
/// @throws OutputError.
void write_input(const Experiment& experiment, const std::filesystem::path& folder, const FigureMesh& input);

/// Writes a state of the mesh, FIGURE-TITLE.ply: each vertex with the colour of its height (z) in the input, blue where
/// that was lowest, red where it was highest, and with that height as the property `height`.
/// @throws OutputError.
void write_state(const Experiment& experiment, const std::filesystem::path& folder, const FigureMesh& input,
                 std::string_view title, const Points& positions);

}  // namespace seamflow
