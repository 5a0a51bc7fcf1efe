#pragma once

#include <cstddef>
#include <vector>

#include "partition/formats/ply_header.h"
#include "partition/formats/ply_slices.h"
#include "partition/io/mesh_builder.h"

namespace seamflow {

/// The role of a property in the mesh; the first three have the numbers of the coordinates.
enum class PlyRole : std::size_t {
    X,
    Y,
    Z,
    Corners,
    /// Not used by this reader.
    Other
};

/// The roles of an element's properties.
std::vector<PlyRole> roles_of(const PlyElement& element);

/// Reads a slice of a binary file whose elements are all of one kind, if they are vertices without lists or faces
/// without further lists.
/// @returns whether they are.
/// @throws InputError if there is any fault, not necessarily naming it.
bool read_plain_slice(const PlyHeader& header, const PlySlice& slice, const MeshSlice& place);

}  // namespace seamflow
