#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "samples/benchmark/method_rows.h"

namespace seamflow {

/// One mesh, dt and number of steps.
struct GridCell {
    std::string mesh;
    Index vertices = 0;
    /// dt in squared mean edge lengths.
    double time_step_edges = 0.0;
    int steps = 0;
    Row ours;
    /// Empty if ours or the undecomposed flow failed. For an iterative peer, the row of the loosest tolerance with
    /// which it is as near to the undecomposed flow as ours.
    std::vector<Row> peers;

    /// The fastest of the peers that are as near as ours, by the median of its turns; null if there is none.
    [[nodiscard]] const Row* fastest_peer() const;
    /// Its median divided by that of ours; infinite without one.
    [[nodiscard]] double ratio() const;
};

/// Whether a row ends at least as near to the undecomposed flow as ours, by V_max and V_mean. Distances below a
/// thousandth and a ten-thousandth of a mean edge count as zero.
bool is_as_near(const Row& row, const Row& ours);

/// The methods to run in a cell, and how.
struct GridOptions {
    std::vector<Method> peers;
    Reference reference = Reference::Automatic;
    /// How often ours and the peers with similar times are run, in turns; the medians count.
    int turns = 3;
};

/// Runs the cells of one mesh, in turn.
class GridRunner {
  public:
    /// @param mesh, options must outlive this.
    GridRunner(const PolygonMesh& mesh, const GridOptions& options);

    /// Ours, the undecomposed flow, and the peers. A peer is abandoned if it is not yet as near and takes twice as long
    /// as the fastest: its row reports this.
    /// @returns a cell without name and dt in edges; without peers if ours or the undecomposed flow fails; the row of
    ///          ours then has the reason.
    GridCell run(const FlowOptions& flow);

    /// With the undecomposed flow of the last cell.
    [[nodiscard]] const MethodRows& rows() const { return rows_; }

  private:
    Row run_peer(Method peer, const GridCell& cell, const FlowOptions& flow);
    Row run_iterative(Method peer, const GridCell& cell, const FlowOptions& flow);
    [[nodiscard]] Row run_once(const MethodTask& task) const;
    void repeat(GridCell& cell) const;

    const GridOptions& options_;
    MethodRows rows_;
    /// Index in tolerance_ladder of the tolerance of the previous cell.
    std::map<Method, std::size_t> place_;
};

}  // namespace seamflow
