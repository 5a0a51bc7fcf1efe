#pragma once

#include <span>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

/// What all sub-meshes are made of, whether they overlap or not.
namespace seamflow {

/// Sorts and leaves one of each.
void sort_unique(std::vector<Index>& values);

/// Position of `value` in the ascending range, or -1.
Index position_in(std::span<const Index> ascending, Index value);

/// Whether vertex v may move and has faces of several labels: whether it lies on Γ.
bool is_on_interface(const Topology& topology, std::span<const Index> labels, Index v);

/// The labels of the faces around a vertex, ascending.
std::vector<Index> labels_at(const Topology& topology, std::span<const Index> labels, Index v);

/// The vertices at the other ends of the edges at v, in ascending order.
std::vector<Index> edge_neighbours(const PolygonMesh& mesh, const Topology& topology, Index v);

/// A sub-mesh of the given faces with its vertices, their fixedness, and its half-edges; nothing of other sub-meshes
/// yet, and nothing owned.
/// @param faces in ascending order.
SubMesh copy_faces(const PolygonMesh& mesh, const Topology& topology, std::vector<Index> faces);

/// Appends those of the given vertices that the sub-mesh does not have yet as its halo.
void append_halo(std::vector<Index> vertices, SubMesh& sub_mesh);

/// The local index of a vertex of the sub-mesh or of its halo.
Index local_or_halo_index(const SubMesh& sub_mesh, Index v);

/// Notes a vertex of Γ and its edge neighbours, all of them in the sub-mesh or its halo, to be corrected after a step.
void append_to_seam(const PolygonMesh& mesh, const Topology& topology, Index v, SubMesh& sub_mesh);

/// Marks the vertices for which a sub-mesh speaks: those that may move and whose lowest label is its own.
void mark_owned(const Topology& topology, std::span<const Index> labels, Index own, SubMesh& sub_mesh);

}  // namespace seamflow
