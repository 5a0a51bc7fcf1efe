#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/topology.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

/// Rows of the undecomposed step with Δ_P at some vertices, without a matrix, or the shares in them of some faces
/// around the vertices: they reach two rings.
class PtackovaRows {
  public:
    /// @param vertices one per row. @param faces per row, faces around its vertex.
    PtackovaRows(const PolygonMesh& mesh, const Topology& topology, std::vector<Index> vertices, IndexLists faces);

    /// The residuals of the rows, each multiplied by the area M_v of its vertex: M_v (Vᵏ⁺¹ - Vᵏ + dt Δ_P(Vᵏ) Vᵏ⁺¹).
    /// Allocates nothing.
    /// @param before, after #V by 3: Vᵏ and Vᵏ⁺¹; at these faces and those that share an edge with one.
    /// @param time_step dt, in length².
    /// @param residuals #rows by 3.
    void evaluate(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                  double time_step, const Executor& exec, Points& residuals);

  private:
    /// A face of a mesh, and its data.
    struct Face {
        Index index;
        /// See PtackovaVelho::flux_map: b and |f| at Vᵏ, x = Vᵏ⁺¹.
        Eigen::Matrix3d flux;
        double area;
        /// Share of each of its corners in ΔV, times M_v.
        Point share;
    };

    std::vector<Index> vertices_;
    /// Per row, as numbers in the list below.
    IndexLists faces_at_;
    /// Those of the rows, then those that share an edge with one of them.
    std::vector<Face> faces_;
    Index n_inner_ = 0;
    /// #F: the number of a face in that list, or -1.
    std::vector<Index> number_;
};

}  // namespace seamflow
