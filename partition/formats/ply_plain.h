#pragma once

#include "partition/formats/ply_data.h"
#include "partition/io/mesh_builder.h"

namespace seamflow {

/// Reads a slice of a binary file whose elements are all of one kind, if they are vertices without lists or faces
/// without further lists: 1.7 times as fast as PlySource.
/// @returns whether the elements are of these kinds.
/// @throws InputError if there is any fault, whose message need not name it.
bool read_plain_slice(const PlyHeader& header, const PlySlice& slice, const MeshSlice& mesh_slice);

}  // namespace seamflow
