#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/laplacian/edge_lists.h"

namespace seamflow {

/// Steps of many columns of data with one factor of the whole matrix, (M + dt K)(Xᵏ⁺¹ - Xᵏ) = -dt K Xᵏ: several columns
/// at a time, so that the factor is read from memory once for all of them, and each thread with columns of its own. A
/// constant column stays, bit for bit.
class WideSteps {
  public:
    /// @param unknown_of per vertex, -1 for none. @param n number of unknowns.
    /// @param is_held per vertex, whether it stays although it has an unknown; empty: none does.
    /// @param pairs, entries the off-diagonal entries of dt K, each standing for two, maybe repeated.
    WideSteps(std::span<const Index> unknown_of, Index n, std::span<const std::uint8_t> is_held,
              std::span<const VertexPair> pairs, std::span<const double> entries);

    /// Takes steps. A column's bits do not depend on the others.
    /// @param factor of M + dt K at the unknowns.
    /// @param rows per vertex, its row of the fields. @param fields any number of columns.
    /// @throws ComputationError if a result is not finite.
    void take(const LdlFactor<double>& factor, int n_steps, std::span<const Index> rows,
              Eigen::Ref<Eigen::MatrixXd> fields, const Executor& exec) const;

  private:
    /// An entry in the row of an unknown: the place of the other, and dt K.
    struct Entry {
        Index place;
        double value;
    };

    Index n_;
    /// The vertices: those of the unknowns in their order, then the others.
    std::vector<Index> vertex_at_;
    /// Per unknown; none of held ones.
    Lists<Entry> entries_;
};

}  // namespace seamflow
