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
    /// None where ours or the undecomposed flow failed. Of an iterative peer the row of the loosest tolerance with
    /// which it is as near to the undecomposed flow as ours.
    std::vector<Row> peers;

    /// Of the peers that are as near as ours the one that takes the least time, set-up included; null if there is none.
    [[nodiscard]] const Row* fastest_peer() const;
    /// Its time in that of ours; infinite without one.
    [[nodiscard]] double ratio() const;
};

/// Whether a row ends at least as near to the undecomposed flow as ours, by V_max and V_mean. Distances below a
/// thousandth and a ten-thousandth of a mean edge count as none.
bool is_as_near(const Row& row, const Row& ours);

/// What is run in a cell.
struct GridOptions {
    std::vector<Method> peers;
    Reference reference = Reference::Automatic;
    /// How often ours and the peers that come near it are run in turns; the least times count.
    int turns = 3;
};

/// Runs the cells of one mesh, in turn.
class GridRunner {
  public:
    /// @param mesh, options must outlive this.
    GridRunner(const PolygonMesh& mesh, const GridOptions& options);

    /// Ours, the undecomposed flow, and the peers. A peer is given up where it is not yet as near and takes twice as
    /// long as the fastest: its row says so.
    /// @returns a cell without name and dt in edges; without peers where ours or the undecomposed flow fails, and ours
    ///          says why.
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
    /// Place in tolerance_ladder of the tolerance of the cell before.
    std::map<Method, std::size_t> place_;
};

}  // namespace seamflow
