#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/topology.h"

namespace seamflow {

/// Low-pass filters of vertex positions with uniform weights, which need no equations: with S one or more rounds in
/// which each vertex goes half the way to the mean of its neighbours, the result is 1 - (1 - S)³. Only interior
/// vertices move. Bits do not depend on how loops are run.
class PositionFilters {
  public:
    /// @param neighbours per vertex: those at the other ends of its edges. Must outlive the filters.
    PositionFilters(const Topology& topology, const IndexLists& neighbours);

    /// One result, #V by 3, for each of several numbers of rounds of S.
    /// @param rounds ascending.
    [[nodiscard]] std::vector<Points> low_pass(const Points& positions, const std::vector<int>& rounds,
                                               const Executor& exec = run_serially) const;

    /// The same with normalised convolution (Knutsson, Westin, 1993): a vertex counts the less, the further it is from
    /// the filtered surface, compared with the vertices around it. Where noise moves only some of the vertices, those
    /// that it has not moved decide.
    /// @param filtered #V by 3: after low_pass. @param normals #V by 3: of that surface.
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
