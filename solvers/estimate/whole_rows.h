#pragma once

#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/topology.h"
#include "solvers/interface/interface_copies.h"
#include "solvers/interface/interface_ranks.h"
#include "solvers/interface/shared_rows.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

/// The residuals of the rows at Γ of a decomposed step with Δ_P, each multiplied by the area M_v of its vertex, M_v
/// (Vᵏ⁺¹ - Vᵏ + dt Δ_P(Vᵏ) Vᵏ⁺¹), computed without a matrix. Rows of Δ_P reach two rings, more than one sub-mesh knows.
/// A vertex beside Γ shares a face with a vertex of Γ but is not on it: its sub-mesh knows the residual from its own
/// faces alone, and distributes it to the vertices of Γ with which it shares a face. Every sub-mesh adds up the shares
/// of its faces in the rows; the residual at a vertex of Γ is the sum over its copies.
class WholeRows {
  public:
    /// @param decomposition without overlap, sub-meshes of other ranks being fragments. @param ranks must outlive this,
    /// as must the decomposition.
    WholeRows(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
              InterfaceRanks& ranks);

    /// Measures all residuals; all ranks call this together. Allocates no memory if there is one rank.
    /// @param before, after #V by 3: Vᵏ, and Vᵏ⁺¹ as solved, at the vertices of own faces and of faces that share an
    ///        edge with one.
    /// @param time_step dt, in length².
    void measure(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                 double time_step, const Executor& exec);

    /// The residual at the i-th vertex of the Γ of an own sub-mesh.
    [[nodiscard]] Point residual(Index s, Index i) const;

  private:
    /// A face of the mesh, and the data of a step in it.
    struct Face {
        Index index;
        /// The map from the edge vectors of the face to the fluxes across its edges (see PtackovaVelho::flux_map), with
        /// the bisectors b and the area |f| at Vᵏ, and x = Vᵏ⁺¹.
        Eigen::Matrix3d flux;
        double area;
        /// The face's share in M_v ΔV at each of its corners.
        Point share;
    };

    void list_rows(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                   const InterfaceRanks& ranks);
    void list_faces(const PolygonMesh& mesh, const Topology& topology);
    void evaluate(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                  double time_step, const Executor& exec);

    InterfaceCopies copies_;
    SharedRows shared_;
    /// Per row at Γ: its copy, and the rows beside Γ that are distributed to it, numbered from 0; vertices_, faces_at_
    /// and of_rows_ have them after the rows at Γ. Per row beside Γ: the number of rows at Γ that share it.
    std::vector<Index> copy_of_row_;
    IndexLists beside_;
    std::vector<Index> n_sharing_;
    /// Per row: its vertex; and the own faces around the vertex, as indices of `faces_`.
    std::vector<Index> vertices_;
    IndexLists faces_at_;
    /// The n_inner_ own faces of the rows, then the faces that share an edge with one of them.
    std::vector<Face> faces_;
    Index n_inner_ = 0;
    /// #F: the index of a face in `faces_`, or -1.
    std::vector<Index> number_;
    /// #rows by 3: the residuals from the own faces around each vertex.
    Points of_rows_;
    /// #copies by 3: the shares of the copies' sub-meshes.
    Points of_copies_;
};

}  // namespace seamflow
