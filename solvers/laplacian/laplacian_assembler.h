#pragma once

#include <memory>
#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "solvers/laplacian/edge_lists.h"
#include "solvers/laplacian/laplacian.h"
#include "solvers/sparse/sparse_pattern.h"

namespace seamflow {

/// Adds one Laplacian to the values of a matrix, repeatedly as the mesh moves. The entries, and the order in which they
/// are added, depend on the faces alone: `entries` lists them once, and `add` then finds each value's index in a list
/// of slots made from them, without searching.
class LaplacianAssembler {
  public:
    virtual ~LaplacianAssembler() = default;

    /// The entries in the order in which `add` adds them, maybe repeated.
    [[nodiscard]] virtual std::vector<MatrixEntry> entries() const = 0;

    /// values[slots[i]] += factor · (contribution to the i-th of `entries`).
    /// @param positions at least #V by 3.
    /// @param slots one index of `values` per entry. The slots of unwanted entries are all one index that is never
    /// read.
    virtual void add(const Points& positions, double factor, std::span<const Index> slots,
                     std::span<double> values) = 0;

    /// M_v at the positions last added: row v times M_v is the sum of the contributions of edges or faces.
    [[nodiscard]] virtual double mass(Index v) const = 0;
};

/// The assembler of one Laplacian on the own faces, whose arrays must outlive it.
/// @param stiffness_at at least #V by 3: the positions whose K a symmetric Laplacian keeps while M follows the mesh;
///        needed only during the call. nullptr: K also follows the mesh.
std::unique_ptr<LaplacianAssembler> make_assembler(const ScaledLaplacian& laplacian, const FacesOnBothSides& faces,
                                                   const Points* stiffness_at = nullptr);

/// The assembler of Δ_P (see PtackovaVelho).
std::unique_ptr<LaplacianAssembler> make_two_ring_assembler(const FacesOnBothSides& faces);

}  // namespace seamflow
