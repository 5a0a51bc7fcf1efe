#pragma once

#include <vector>

#include "partition/index_lists.h"

namespace seamflow {

/// K and M of a whole mesh as numbers, where they do not follow from positions. Only vertices of one face have entries.
/// Faces share them evenly: an entry of K among those with both vertices, one of M among those at the vertex.
struct GivenStiffness {
    /// #V: the vertices that each has faces with, ascending.
    IndexLists neighbours;
    /// Of each neighbour: -K_vw, and how many faces have both.
    std::vector<double> weights;
    std::vector<Index> n_faces;
    /// #V: M_v, in length².
    std::vector<double> mass;
};

}  // namespace seamflow
