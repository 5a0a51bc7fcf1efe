#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The faces of a mesh in small connected groups, the nodes of a graph coarser than the dual graph of the mesh (see
/// FaceGraph).
struct FaceClusters {
    /// The faces of every cluster, each connected through edges of exactly two faces.
    IndexLists faces;
    /// #F: the cluster of every face.
    std::vector<Index> cluster_of;

    [[nodiscard]] Index size() const { return faces.size(); }
};

/// The weight of a face when a mesh is divided: the number of triangles that it could be split into, which is about its
/// share of the unknowns.
inline Index face_weight(const PolygonMesh& mesh, Index f)
{
    return static_cast<Index>(mesh.face(f).size()) - 2;
}

/// The weight of clusters for a mesh that is cut into k parts; 1 if its faces should not be grouped.
/// @param total the weight of all faces.
Index cluster_weight(double total, Index k);

/// Minimum number of faces in a chunk (see grow_clusters).
inline constexpr Index faces_per_chunk = 1 << 18;

/// Grows clusters breadth first, one beside the other, each until its faces weigh `weight` or no free face is left
/// around it. Linear in the size of the mesh. A large mesh, if its faces mostly have neighbours of near numbers, is
/// processed in chunks of at least `chunk` faces, several at a time; clusters at the ends of chunks are then dissolved
/// and grown again across the ends.
/// @param weight at least 1; 1 makes every face f the cluster f.
FaceClusters grow_clusters(const PolygonMesh& mesh, const Topology& topology, Index weight,
                           const Executor& exec = run_serially, Index chunk = faces_per_chunk);

}  // namespace seamflow
