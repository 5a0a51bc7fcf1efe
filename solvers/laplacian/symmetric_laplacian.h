#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "partition/index_lists.h"
#include "solvers/laplacian/edge_lists.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/given_stiffness.h"
#include "solvers/laplacian/laplacian.h"
#include "solvers/laplacian/stiffness_product.h"

namespace seamflow {

/// A face with more corners gets auxiliary unknowns (see SymmetricLaplacian), if these are wanted; with fewer corners,
/// the entries of its K are cheaper.
inline constexpr std::size_t most_corners_without_auxiliary = 64;

/// The squared difference of the data of two vertices.
using SquaredDifference = std::function<double(Index v, Index w)>;

/// A Laplacian that is M⁻¹ K with M diagonal and positive and K symmetric and positive semi-definite: Δ_F (Fujiwara)
/// with M the mean length of the edges at each vertex, Δ_A (AlexaWardetzky) and Δ_B (VirtualRefinement) with M the
/// areas of the vertices, Δ_U (Uniform) with M their degrees times h²/4. Assembled from faces, repeatedly as the mesh
/// moves.
///
/// K of a face of n corners has n² entries. With auxiliary unknowns Y of some faces it is S - C D⁻¹ Cᵀ, a few numbers
/// for each corner, where D is diagonal, of either sign. Then the matrices are those of
///
///     | M + dt S   dt C | | X |   | B |
///     |  dt Cᵀ     dt D | | Y | = | 0 |   with  (M + dt K) X = B,
///
/// which is quasi-definite: L D Lᵀ exists in any order, with pivots of the signs of the diagonal (Vanderbei 1995).
class SymmetricLaplacian {
  public:
    virtual ~SymmetricLaplacian() = default;

    /// Whether `assemble` uses the faces.
    [[nodiscard]] virtual bool uses_faces() const = 0;

    /// The off-diagonal entries of K in the order in which `assemble` adds them. Each pair stands for two entries, and
    /// may be repeated.
    [[nodiscard]] virtual std::vector<VertexPair> pairs() const = 0;

    /// The number of auxiliary unknowns, which are numbered after the vertices. In `pairs` they are the second of a
    /// pair; the pairs of one auxiliary unknown are consecutive.
    [[nodiscard]] virtual Index n_auxiliary() const { return 0; }

    /// values[slots[i]] += factor · (contribution to the i-th of `pairs`), diagonal[v] = factor · K_vv (or S_vv, or
    /// D_vv), mass[v] = M_v, and mass = 0 for auxiliary unknowns.
    /// @param positions at least #V by 3.
    /// @param slots one index of `values` per pair. The slots of unwanted pairs are all one index that is never read.
    /// @param diagonal, mass #V + n_auxiliary().
    /// @param product may be nullptr.
    virtual void assemble(const Points& positions, double factor, std::span<const Index> slots,
                          std::span<double> values, std::span<double> diagonal, std::span<double> mass,
                          const StiffnessProduct* product = nullptr) = 0;

    /// Computes only mass[v] = M_v.
    virtual void measure_mass(const Points& positions, std::span<double> mass) const = 0;

    /// Recomputes the kept K, or K and M, at other positions, at least #V by 3 (see keep_stiffness).
    virtual void set_reference(const Points&) {}

    /// Replaces the kept K and M by given ones, which depend on no positions. Only for sums over faces that keep K and
    /// M, without auxiliary unknowns.
    /// @param local_to_global the numbers of all local vertices in the whole mesh.
    virtual void give([[maybe_unused]] const GivenStiffness& given,
                      [[maybe_unused]] std::span<const Index> local_to_global)
    {
    }

    /// Calls action(n) for each face, or edge, in order, n being the number of consecutive `pairs` that belong to it.
    virtual void for_each_element(const std::function<void(std::size_t n)>& action) const = 0;

    /// Multiplies the kept K of every face, or edge, by 1 / (1 + the largest squared difference of two of its
    /// vertices): the diffusivity of Perona and Malik (Scale-Space and Edge Detection Using Anisotropic Diffusion,
    /// 1990).
    virtual void weigh(const SquaredDifference&) {}
};

/// Makes a symmetric Laplacian.
/// @param laplacian a symmetric one.
/// @param faces the arrays of their lists must outlive the result if it uses them; the twins need not.
/// @param most_corners own faces with more corners have auxiliary unknowns.
std::unique_ptr<SymmetricLaplacian>
make_symmetric_laplacian(const ScaledLaplacian& laplacian, const FacesOnBothSides& faces,
                         std::size_t most_corners = std::numeric_limits<std::size_t>::max());

}  // namespace seamflow
