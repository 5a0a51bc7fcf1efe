#pragma once

#include <vector>

#include "solvers/ldl_solver.h"

namespace seamflow {

/// Three columns of single-precision numbers, one after the other.
struct FloatColumns {
    float* x;
    float* y;
    float* z;
};

/// A small dense symmetric matrix S = L D Lᵀ in single precision, for many products with S and S⁻¹. S has any unit: it
/// is kept as scale() S₁, where single precision has room for S₁ and its inverse.
class DenseFactor {
  public:
    /// Takes a factorisation in double precision over.
    void take(const DenseLdl& factor);

    [[nodiscard]] Index n() const { return n_; }

    /// A power of two.
    [[nodiscard]] double scale() const { return scale_; }

    /// v becomes S₁ v; n numbers per column.
    void multiply(FloatColumns v) const;

    /// The two halves of that, S₁ = R Rᵀ with R = L √D₁: v becomes Rᵀ v, and R v.
    void multiply_by_root_transposed(FloatColumns v) const;
    void multiply_by_root(FloatColumns v) const;

    /// v becomes S₁⁻¹ v.
    void solve(FloatColumns v) const;

    /// The diagonal of S.
    [[nodiscard]] std::vector<double> diagonal() const;

  private:
    void add_multiple(Index column, float sign, FloatColumns v) const;
    void add_product(Index column, float sign, FloatColumns v) const;

    /// A column of L from the row below the diagonal on.
    [[nodiscard]] const float* below(Index column) const { return values_.data() + begin_of(column); }
    [[nodiscard]] float* below(Index column) { return values_.data() + begin_of(column); }
    [[nodiscard]] std::size_t begin_of(Index column) const
    {
        return at(column) * at(n_) - at(column) * (at(column) + 1) / 2;
    }

    Index n_ = 0;
    double scale_ = 1.0;
    /// L by columns, below the diagonal.
    std::vector<float> values_;
    /// √D₁, and the inverses of D₁.
    std::vector<float> root_;
    std::vector<float> inverse_;
};

}  // namespace seamflow
