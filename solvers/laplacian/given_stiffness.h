#pragma once

#include <vector>

#include "partition/index_lists.h"

namespace seamflow {

/// K and M of a whole mesh as numbers, for a K and an M that do not follow from positions. Only vertices of a common
/// face have entries. Faces share entries evenly: an entry of K is shared by the faces with both vertices, an entry of
/// M by the faces at the vertex.
struct GivenStiffness {
    /// #V: the vertices with which each vertex has faces in common, ascending.
    IndexLists neighbours;
    /// Per neighbour: -K_vw, and the number of faces with both vertices.
    std::vector<double> weights;
    std::vector<Index> n_faces;
    /// #V: M_v, in length².
    std::vector<double> mass;
};

}  // namespace seamflow
