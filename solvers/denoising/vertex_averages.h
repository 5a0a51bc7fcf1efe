#pragma once

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Averages over vertices and those at the other ends of their edges, all with the same weight. Bits do not depend on
/// how loops are run.
class VertexAverages {
  public:
    /// @param mesh its vertices are not used. @param topology twins are not used. Both must outlive the object.
    VertexAverages(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

    /// Numbers of faces, one row each.
    using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// Spreads numbers over the surface: vertices take the mean of their faces, then several times that of themselves
    /// and their neighbours, and faces that of their vertices.
    /// @param near #F by any number; replaced by the means after some rounds, unless there are none.
    /// @param around as large; replaced by those after further rounds.
    void spread(Rows& near, Rows& around, int rounds, int further_rounds, const Executor& exec = run_serially) const;

    /// Per vertex: those at the other ends of its edges, ascending.
    [[nodiscard]] const IndexLists& neighbours() const { return neighbours_; }

  private:
    /// Spreads some columns, at most `Width`, from the first on.
    template <int Width>
    void spread_columns(Rows& near, Rows& around, Eigen::Index first, int rounds, int further_rounds,
                        const Executor& exec) const;

    const PolygonMesh* mesh_;
    const Topology* topology_;
    IndexLists neighbours_;
};

}  // namespace seamflow
