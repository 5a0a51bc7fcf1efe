#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/topology.h"

namespace seamflow {

/// Low-pass filters of vertex positions with uniform weights, without equations to solve: S is one or more rounds in
/// which each vertex moves half the way to the mean of its neighbours, and the filter is 1 - (1 - S)³. Only interior
/// vertices move. Bits do not depend on how loops are run.
class PositionFilters {
  public:
    /// @param neighbours per vertex, along edges. Must outlive the filters.
    PositionFilters(const Topology& topology, const IndexLists& neighbours);

    /// Filters the positions with several numbers of rounds of S.
    /// @param positions #V by 3. @param rounds ascending. @returns one result, #V by 3, per number of rounds.
    [[nodiscard]] std::vector<Points> low_pass(const Points& positions, const std::vector<int>& rounds,
                                               const Executor& exec = run_serially) const;

    /// Filters the positions by normalised convolution (Knutsson, Westin, 1993): a vertex has the less weight, the
    /// further it is from the filtered surface, compared with the vertices around it. Where noise moves only some of
    /// the vertices, the other vertices determine the result.
    /// @param filtered #V by 3: a result of low_pass. @param normals #V by 3: of the filtered surface.
    [[nodiscard]] std::vector<Points> robust_low_pass(const Points& positions, const Points& filtered,
                                                      const Points& normals, const std::vector<int>& rounds,
                                                      const Executor& exec = run_serially) const;

  private:
    template <class Rows>
    void average(const Rows& from, Rows& to, const Executor& exec) const;

    const IndexLists* neighbours_;
    std::vector<std::uint8_t> is_interior_;
};

}  // namespace seamflow
