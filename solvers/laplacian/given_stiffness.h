#pragma once

#include <memory>
#include <span>
#include <vector>

#include "partition/index_lists.h"
#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

/// K and M of a whole mesh as numbers, where they do not follow from positions. Only vertices of one face have entries.
struct GivenStiffness {
    /// #V: the vertices that each has faces with, ascending.
    IndexLists neighbours;
    /// Of each neighbour: -K_vw, and how many faces have both.
    std::vector<double> weights;
    std::vector<Index> n_faces;
    /// #V: M_v, in length².
    std::vector<double> mass;
};

/// A Laplacian with these K and M, at whatever positions. Faces share them evenly: an entry of K among those with both
/// vertices, one of M among those at the vertex.
/// @param laplacian one that is a sum over the faces of a sub-mesh.
/// @param local_to_global its vertices in the whole mesh.
std::unique_ptr<SymmetricLaplacian> with_stiffness(std::unique_ptr<SymmetricLaplacian> laplacian,
                                                   const GivenStiffness& given, std::span<const Index> local_to_global);

}  // namespace seamflow
