#pragma once

namespace seamflow {

/// Which edge of a sub-mesh stands for ‖e‖ in k_max = π / ‖e‖.
enum class PEdge {
    /// The shortest edge if it has at least a tenth of the length of Percentile. A shorter edge is that of a sliver:
    /// then Percentile is used.
    Automatic,
    /// The shortest edge, as in the paper. One sliver makes p* huge.
    Minimum,
    /// The edge than which 5 % of all edges are shorter.
    Percentile,
    /// The mean length over half-edges.
    Mean,
};

}  // namespace seamflow
