#pragma once

#include <vector>

#include "partition/polygon_mesh.h"
#include "samples/command/smooth_command.h"

namespace seamflow {

/// Reads into the options the files that the command line names besides the input: labels, fixed vertices, edges,
/// weights of the attachment, and the region.
/// @param left_out ascending: the numbers in the file of the faces that are not in the mesh; they have labels, too.
/// @throws InputError
void read_named_files(SmoothCommand& command, const PolygonMesh& mesh, const std::vector<Index>& left_out);

}  // namespace seamflow
