#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "engine/distributed/files/shared_mesh_file.h"
#include "partition/executor.h"
#include "partition/formats/text_slices.h"

namespace seamflow {

/// Reads the header of a text file (see slice_obj_text and similar).
using TextSlicer = std::unique_ptr<SlicedText> (*)(const std::filesystem::path& path, std::string_view text);

/// An OBJ, OFF or PLY file that is text, of which every rank reads and writes about as many bytes, up to the end of a
/// line. All ranks must see the file under this path. Normals stay as they are.
/// @param exec runs what is done piece by piece.
/// @throws InputError naming the file.
std::unique_ptr<SharedMeshFile> open_sliced_text(const std::filesystem::path& path, TextSlicer slicer,
                                                 const FileSharing& sharing, const Executor& exec);

}  // namespace seamflow
