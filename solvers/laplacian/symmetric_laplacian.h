#pragma once

#include <compare>
#include <memory>
#include <span>
#include <vector>

#include "partition/index_lists.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// Two different vertices.
struct VertexPair {
    Index first = 0;
    Index second = 0;
    friend auto operator<=>(const VertexPair&, const VertexPair&) = default;
};

/// A product with factor · K at positions V.
struct StiffnessProduct {
    /// #V by 3: X.
    const Points& increments;
    /// #V by 3: receives factor · K (V + X), or factor · K X. The rows of K add up to zero: it is made of differences,
    /// and has no rounding error of the size of V.
    Points& result;
    bool of_increments_alone = false;
};

/// A Laplacian that is M⁻¹ K with M diagonal and positive and K symmetric and positive semi-definite: Δ_F with M = Σ‖e‖
/// / val, Δ_A and Δ_B with M the areas of the vertices, Δ_U with M their degrees. Assembled from faces, again and again
/// as the mesh moves.
class SymmetricLaplacian {
  public:
    virtual ~SymmetricLaplacian() = default;

    /// Whether `assemble` looks at the faces.
    [[nodiscard]] virtual bool uses_faces() const = 0;

    /// The entries of K off the diagonal in the order in which `assemble` meets them, each standing for two;
    /// repetitions are welcome.
    [[nodiscard]] virtual std::vector<VertexPair> pairs() const = 0;

    /// values[slots[i]] += factor · (contribution to the i-th of `pairs`), diagonal[v] = factor · K_vv, mass[v] = M_v.
    /// @param positions at least #V by 3.
    /// @param slots one place per pair. Pairs that are not wanted all point to one place that nobody reads.
    /// @param diagonal, mass #V.
    /// @param product may be nullptr.
    virtual void assemble(const Points& positions, double factor, std::span<const Index> slots,
                          std::span<double> values, std::span<double> diagonal, std::span<double> mass,
                          const StiffnessProduct* product = nullptr) = 0;

    /// mass[v] = M_v, alone.
    virtual void measure_mass(const Points& positions, std::span<double> mass) const = 0;
};

/// Whose contributions a SymmetricLaplacian adds up.
enum class Contributions {
    /// Those of the faces on both sides of Γ: right at all vertices of the sub-mesh.
    BothSides,
    /// Those of the own faces, half of an edge on Γ being either side's: over all sub-meshes they add up to the whole.
    OwnFaces,
};

/// Faces of a sub-mesh, and those beyond its Γ.
struct FacesOnBothSides {
    const IndexLists& own;
    const IndexLists& beyond;
    /// Of the own faces: see SubMesh::twin.
    std::span<const Index> twin;
    /// Of all vertices.
    Index n_vertices;
    Contributions contributions = Contributions::BothSides;
};

/// @param laplacian one that is symmetric.
/// @param faces their lists must outlive the result if it uses them, the twins need not.
std::unique_ptr<SymmetricLaplacian> make_symmetric_laplacian(const ScaledLaplacian& laplacian,
                                                             const FacesOnBothSides& faces);

/// The same with the K of certain positions whatever the mesh does, which is assembled once; M follows the mesh.
/// @param n_vertices of all.
/// @param positions at least n_vertices by 3; needed only during the call.
std::unique_ptr<SymmetricLaplacian> keep_stiffness(std::unique_ptr<SymmetricLaplacian> laplacian, Index n_vertices,
                                                   const Points& positions);

}  // namespace seamflow
