#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/cut/band.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/index_lists.h"

namespace seamflow {

/// Faces of a part outside its largest component.
struct LooseFaces {
    /// Those of one component after the other, the lowest first.
    std::vector<std::int64_t> faces;
    std::vector<Index> component_sizes;
    std::vector<std::int64_t> corners;
};

/// The components of some parts, except the largest of each (of equals the one with the lowest face). All ranks call
/// this together: each checks some parts, which it gets as a whole.
/// @param parts ascending, the same at all ranks. @returns those of all ranks, at rank 0; nothing at the others.
LooseFaces gather_loose(Communicator& comm, const SlicedCut& cut, const std::vector<Index>& parts);

/// The components as faces of a band, in the order of their lowest faces.
IndexLists components_in(const Band& band, const LooseFaces& loose);

/// Joins loose components to the parts with which they share most edges, in rings around settled faces.
/// @param band of all faces around them. @param components the loose ones, as faces of the band.
/// @param n_parts grows if one has no settled face around it, and becomes a part.
/// @returns one label per component.
std::vector<Index> join_to_neighbours(const Band& band, const IndexLists& components, Index& n_parts);

}  // namespace seamflow
