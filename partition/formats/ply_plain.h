#pragma once

#include <cstddef>
#include <vector>

#include "partition/formats/ply_header.h"
#include "partition/formats/ply_slices.h"
#include "partition/io/mesh_builder.h"

namespace seamflow {

/// What a property means to the mesh; the numbers of the first three are those of the coordinates.
enum class PlyRole : std::size_t {
    X,
    Y,
    Z,
    Corners,
    /// Nothing that this reader has a use for.
    Other
};

/// What the properties of an element mean.
std::vector<PlyRole> roles_of(const PlyElement& element);

/// Reads a slice of a binary file, all of whose elements are of one kind, if they are vertices without lists or faces
/// without further ones.
/// @returns whether they are.
/// @throws InputError if there is any fault, not necessarily naming it.
bool read_plain_slice(const PlyHeader& header, const PlySlice& slice, const MeshSlice& place);

}  // namespace seamflow
