#pragma once

#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/topology.h"
#include "solvers/interface/interface_copies.h"
#include "solvers/interface/interface_peers.h"
#include "solvers/interface/shared_rows.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

/// The residuals of the rows at Γ of a decomposed step with Δ_P, each multiplied by the area M_v of its vertex,
/// M_v (Vᵏ⁺¹ - Vᵏ + dt Δ_P(Vᵏ) Vᵏ⁺¹): without a matrix. They reach two rings, too far for one sub-mesh to know. The
/// residuals at vertices beside Γ, which a sub-mesh has from its own faces alone, are distributed to the vertices of Γ
/// with which they share a face. Every sub-mesh adds up its faces' shares of the rows; a vertex of Γ has the sum of
/// these over its copies.
class WholeRows {
  public:
    /// @param decomposition, peers see ErrorEquation; both must outlive this.
    WholeRows(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
              InterfacePeers& peers);

    /// All peers call this together. Allocates nothing for one peer.
    /// @param before, after #V by 3: Vᵏ, and Vᵏ⁺¹ as solved; at own faces and those that share an edge with one.
    /// @param time_step dt, in length².
    void measure(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                 double time_step, const Executor& exec);

    /// At the i-th vertex of an own sub-mesh's Γ.
    [[nodiscard]] Point residual(Index s, Index i) const;

  private:
    /// A face of the mesh, and its data.
    struct Face {
        Index index;
        /// See PtackovaVelho::flux_map: b and |f| at Vᵏ, x = Vᵏ⁺¹.
        Eigen::Matrix3d flux;
        double area;
        /// Share of each of its corners in ΔV, times M_v.
        Point share;
    };

    void list_rows(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                   const InterfacePeers& peers);
    void list_faces(const PolygonMesh& mesh, const Topology& topology);
    void evaluate(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                  double time_step, const Executor& exec);

    InterfaceCopies copies_;
    SharedRows shared_;
    /// Per row at Γ its copy, and the rows beside Γ that are distributed to it. The latter follow those at Γ; each with
    /// the number of copies sharing it.
    std::vector<Index> copy_of_row_;
    IndexLists beside_;
    std::vector<Index> n_sharing_;
    /// Per row: its vertex, and own faces around it, as numbers in the list below.
    std::vector<Index> vertices_;
    IndexLists faces_at_;
    /// Those of the rows, then those that share an edge with one of them.
    std::vector<Face> faces_;
    Index n_inner_ = 0;
    /// #F: the number of a face in that list, or -1.
    std::vector<Index> number_;
    Points of_rows_;
    /// #copies by 3.
    Points of_copies_;
};

}  // namespace seamflow
