#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian.h"
#include "solvers/sparse/sparse_pattern.h"

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

    /// M_v of the positions last added: row v times this is the sum of what edges or faces contribute.
    [[nodiscard]] virtual double mass(Index v) const = 0;
};

/// The assembler of one Laplacian on the given faces, which must outlive it.
std::unique_ptr<LaplacianAssembler> make_assembler(Laplacian laplacian, const FaceView& faces);

}  // namespace seamflow
