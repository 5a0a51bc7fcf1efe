#pragma once

#include <span>
#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

/// Any number of overlapping sub-meshes, for the alternating Schwarz method (paper, eqs. 18 and 19). Each is its own
/// part of the cut, grown into parts of the same or a later stage. Its result is used on its own part only; where own
/// parts meet, on Γ, the result of the earliest stage is used.
namespace seamflow {

/// How a cut is made to overlap.
struct Overlap {
    /// #F, the part of every face.
    std::span<const Index> labels;
    /// #parts, different for parts that share a vertex of Γ: part i grows into those of the same or a later stage.
    std::span<const Index> stage;
    /// How often each part grows by all faces that share a vertex with it, at least 0.
    int layers = 1;
};

/// The faces of part s, grown, in ascending order.
/// @param faces those of the part itself.
std::vector<Index> grow(const PolygonMesh& mesh, const Topology& topology, const Overlap& overlap, Index s,
                        std::vector<Index> faces);

/// Cuts out the sub-mesh of part s, grown. Its interface is its artificial boundary: the vertices that may move and
/// have faces outside; of the interface's lists only `vertices` is filled in (the others are -1 or empty), which need
/// no fan. Its corrected and owned vertices are those of the part itself. May be called for several sub-meshes at once.
/// @param faces those of the part itself, in ascending order.
SubMesh make_overlapping_sub_mesh(const PolygonMesh& mesh, const Topology& topology, const Overlap& overlap, Index s,
                                  std::vector<Index> faces);

/// Joins sub-meshes made by make_overlapping_sub_mesh. `interface.sharing` lists the parts that have the vertex, the
/// halo transfers fill all vertices outside the own part, and all parts they join are adjacent.
Decomposition connect_overlapping(std::vector<SubMesh> sub_meshes, const Topology& topology, const Overlap& overlap);

}  // namespace seamflow
