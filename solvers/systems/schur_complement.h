#pragma once

#include <cstddef>
#include <vector>

#include "solvers/direct/dense_factor.h"
#include "solvers/direct/ldl_solver.h"

namespace seamflow {

/// What a sub-mesh's equations are on Γ when its interior is eliminated: S = L_Γ D_Γ L_Γᵀ, the last block of the factor
/// of a NeumannSystem. Many products with S and S⁻¹ in single precision, and one with S in double precision.
class SchurComplement {
  public:
    /// Where the numbers in double precision are.
    enum class Storage {
        /// In the factor, which must live as long as they are used.
        Factor,
        /// In memory of this one's own.
        Copy,
    };

    SchurComplement() = default;
    SchurComplement(SchurComplement&&) = default;
    SchurComplement& operator=(SchurComplement&&) = default;

    /// What a copy takes, in bytes, for n vertices of Γ.
    [[nodiscard]] static std::size_t copy_bytes(Index n) { return packed_begin(n) * sizeof(double); }

    /// Takes over what is the last block of the factor now.
    void take(const LdlSolver::Factor& factor, Storage storage);

    /// Number of vertices on Γ.
    [[nodiscard]] Index n() const { return single_.n(); }

    /// S in single precision.
    [[nodiscard]] const DenseFactor& single() const { return single_; }

    /// result -= S x in double precision.
    /// @param x, result n() by 3.
    void subtract_product(const Eigen::Ref<const Points>& x, Eigen::Ref<Points> result) const;

  private:
    /// Where a row of a packed lower triangle begins.
    static std::size_t packed_begin(Index i) { return at(i) * (at(i) + 1) / 2; }
    /// A row of L, and then D.
    [[nodiscard]] const double* row(Index i) const { return rows_ + (is_packed_ ? packed_begin(i) : at(i) * at(n())); }

    DenseFactor single_;
    const double* rows_ = nullptr;
    bool is_packed_ = false;
    /// L below the diagonal and D on it, row by row.
    std::vector<double> packed_;
};

}  // namespace seamflow
