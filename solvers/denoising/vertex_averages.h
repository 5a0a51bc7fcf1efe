#pragma once

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Averages over each vertex and the vertices at the other ends of its edges, all with the same weight. Bits do not
/// depend on how loops are run.
class VertexAverages {
  public:
    /// @param mesh its vertices are not used. @param topology twins are not used. Both must outlive the object.
    VertexAverages(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

    /// Numbers of faces, one row per face.
    using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// Averages numbers of faces over the surface: each vertex takes the mean of its faces, then, several times, the
    /// mean of itself and its neighbours; then each face takes the mean of its vertices.
    /// @param near #F by any number of columns; replaced by the means after `rounds` rounds, unless that is 0.
    /// @param around of the same size; receives the means after `further_rounds` more rounds.
    void spread(Rows& near, Rows& around, int rounds, int further_rounds, const Executor& exec = run_serially) const;

    /// Per vertex: the vertices at the other ends of its edges, ascending.
    [[nodiscard]] const IndexLists& neighbours() const { return neighbours_; }

  private:
    /// Spreads at most `Width` columns, beginning with column `first`.
    template <int Width>
    void spread_columns(Rows& near, Rows& around, Eigen::Index first, int rounds, int further_rounds,
                        const Executor& exec) const;

    const PolygonMesh* mesh_;
    const Topology* topology_;
    IndexLists neighbours_;
};

}  // namespace seamflow
