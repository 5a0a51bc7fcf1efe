#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// @throws OutputError for a mesh of more faces than a browser can show.
void require_showable(const PolygonMesh& mesh, const std::filesystem::path& path);

/// The steps whose states a page holds, so that its size stays bounded: all if they take at most about 80 MB and are at
/// most 200; else as many as this allows, evenly spaced, always with the last one.
/// @param steps of the flow. @param undecomposed whether the page holds the undecomposed flow, too.
/// @returns ascending, from 1 to `steps`.
std::vector<int> shown_steps(int steps, Index n_vertices, bool undecomposed);

/// A sentence for the user; empty if all steps are shown.
std::string remark_on_shown_steps(int steps, int shown);

}  // namespace seamflow
