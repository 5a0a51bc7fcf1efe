#pragma once

#include <optional>
#include <vector>

#include "engine/tasks/workers.h"
#include "partition/formats/mesh_file.h"
#include "samples/command/smooth_command.h"
#include "samples/page/page_flow.h"

namespace seamflow {

/// The page of --html, so far the input; empty without --html.
/// @param left_out ascending: the faces of the file that are not in the mesh.
/// @param workers pack the mesh.
/// @throws OutputError for a mesh that no page can show.
std::optional<PageFlow> begin_page(const SmoothCommand& command, const MeshFile& file,
                                   const std::vector<Index>& left_out, Workers& workers);

}  // namespace seamflow
