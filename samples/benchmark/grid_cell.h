#pragma once

#include <array>
#include <cstddef>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "samples/benchmark/method_rows.h"
#include "samples/benchmark/table.h"

namespace seamflow {

/// The candidates for a tolerance of equal accuracy, from loose to tight.
inline constexpr std::array tolerance_ladder{1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5,
                                             1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8};

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
    /// None: nor is the undecomposed flow.
    std::vector<Method> peers;
    /// How often ours and the peers with similar times are run, in turns; the medians count.
    int turns = 3;
    /// Of iterative peers; empty: the loosest with which they are as near as ours.
    std::optional<double> tolerance = {};
    /// Whether a peer is abandoned if it is not yet as near as ours and takes twice as long as the fastest: its row
    /// reports this.
    bool abandons_slower = true;
};

/// Runs the cells of one mesh, in turn.
class GridRunner {
  public:
    /// @param mesh, options must outlive this.
    GridRunner(const PolygonMesh& mesh, const GridOptions& options);

    /// Ours, the undecomposed flow, and the peers.
    /// @returns a cell without name and dt in edges; without peers if ours or the undecomposed flow fails; the row of
    ///          ours then has the reason.
    GridCell run(const FlowOptions& flow);

    /// With the undecomposed flow of the last cell.
    [[nodiscard]] const MethodRows& rows() const { return rows_; }

  private:
    Row run_peer(Method peer, const GridCell& cell, const FlowOptions& flow);
    Row run_iterative(Method peer, const GridCell& cell, const FlowOptions& flow);
    void repeat(GridCell& cell) const;

    const GridOptions& options_;
    MethodRows rows_;
    /// Index in tolerance_ladder of the tolerance of the previous cell.
    std::map<Method, std::size_t> place_;
};

/// The table of cells, a line for each method.
Table cell_table(std::ostream& out);
void add_cell(Table& table, const GridCell& cell);

/// Prints a table of the ratios in Markdown, with a line for each mesh and a column for each time step with all numbers
/// of steps; and the cells in which ours is not the fastest, with the margins.
/// @param cells mesh by mesh, for each dt by dt.
void print_grid_summary(std::ostream& out, const std::vector<GridCell>& cells);

}  // namespace seamflow
