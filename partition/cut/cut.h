#pragma once

#include <vector>

#include "partition/index.h"
#include "partition/remark.h"

namespace seamflow {

/// The division of the faces of a mesh into sub-meshes.
struct Cut {
    /// #F: the part each face belongs to, from 0 to n_parts - 1; each label occurs. Unless n_parts is 1, each part is a
    /// manifold with boundary, except at junctions (see repair, free_junctions).
    std::vector<Index> labels;
    /// 0 for a mesh without faces.
    Index n_parts = 0;
    /// The number of faces that were moved to other parts to make every part a manifold.
    Index repaired_faces = 0;
    /// Remarks on the cut for the user, one sentence each.
    std::vector<Remark> remarks;
};

}  // namespace seamflow
