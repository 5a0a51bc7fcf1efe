#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "engine/distributed/ranks/conversation.h"
#include "partition/formats/mesh_io.h"
#include "partition/io/shared_output.h"
#include "partition/polygon_mesh.h"

/// Files that ranks write together. All of them call these functions together.
namespace seamflow {

/// Checks that a file of which every rank writes a slice has the format that these are of.
/// @throws OptionError
void require_slices_of(FileFormat format, const std::filesystem::path& path);

/// Rank 0 makes the file, all write their slices, and rank 0 gives it its name.
/// @throws OutputError
void write_together(Conversation& talk, const std::filesystem::path& path,
                    const std::function<void(const SharedOutput&)>& write_own);

/// As write_labelled_ply, of a mesh of which every rank has a stretch.
/// @param mesh of this rank's stretch, with corners numbered in the whole mesh. @param labels of its faces.
void write_labelled_together(Conversation& talk, const std::filesystem::path& path, const PolygonMesh& mesh,
                             const std::vector<Index>& labels);

}  // namespace seamflow
