#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solvers/geometry.h"
#include "solvers/laplacian/laplacian.h"
#include "solvers/sparse_pattern.h"

namespace seamflow {

/// Adds one Laplacian to the values of a matrix, again and again as the mesh moves. Which entries it touches, and in
/// which order, depends on the faces alone: `entries` lists them once, and `add` then finds each value's place in a
/// list of slots made from them, without searching.
class LaplacianAssembler {
  public:
    virtual ~LaplacianAssembler() = default;

    /// The entries in the order in which `add` meets them; repetitions are welcome.
    [[nodiscard]] virtual std::vector<MatrixEntry> entries() const = 0;

    /// values[slots[i]] += factor · (contribution to the i-th of `entries`).
    /// @param positions at least #V by 3.
    /// @param slots one place per entry. Entries that are not wanted all point to one place that nobody reads.
    virtual void add(const Points& positions, double factor, std::span<const Index> slots,
                     std::span<double> values) = 0;
};

/// The assembler of one Laplacian on the given faces, which must outlive it.
std::unique_ptr<LaplacianAssembler> make_assembler(Laplacian laplacian, const FaceView& faces);

/// A Laplacian as a matrix.
struct LaplacianMatrix {
    SparsePattern pattern;
    /// One per entry of the pattern, in 1/length².
    std::vector<double> values;
};

/// The Laplacian of all vertices, boundary vertices included (there with the paper's half-edge weights; a flow that
/// holds the boundary fixed never uses these rows). Rows sum to zero.
LaplacianMatrix laplacian_matrix(Laplacian laplacian, const FaceView& faces, const Points& positions);

}  // namespace seamflow
