#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

/// Parts of a cut grow into adjacent ones, so that they overlap.
namespace seamflow {

/// The rules by which the parts of a cut grow.
struct Overlap {
    /// #F: the part of every face.
    std::span<const Index> labels;
    /// #parts: the stage of a sweep in which each part is solved, different for parts that share a vertex of Γ. Part i
    /// grows into parts of the same or a later stage.
    std::span<const Index> stage;
    /// The number of times that each part grows by all faces that share a vertex with it, at least 0.
    int layers = 1;
};

/// The faces of part s after growing, in ascending order.
/// @param faces the faces of the ungrown part, in ascending order.
std::vector<Index> grow(const PolygonMesh& mesh, const Topology& topology, const Overlap& overlap, Index s,
                        std::vector<Index> faces);

}  // namespace seamflow
