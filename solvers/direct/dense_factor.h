#pragma once

#include <vector>

#include "solvers/direct/ldl_solver.h"

namespace seamflow {

/// Single-precision numbers in whole cache lines.
class AlignedFloats {
  public:
    /// Makes room for at least n numbers. All are 0 afterwards.
    void assign(std::size_t n) { lines_.assign((n + line - 1) / line, {}); }

    [[nodiscard]] std::size_t size() const { return lines_.size() * line; }
    [[nodiscard]] float* data() { return reinterpret_cast<float*>(lines_.data()); }
    [[nodiscard]] const float* data() const { return reinterpret_cast<const float*>(lines_.data()); }

  private:
    static constexpr std::size_t line = 16;
    struct alignas(line * sizeof(float)) Line {
        float numbers[line] = {};
    };
    std::vector<Line> lines_;
};

/// Three columns of n numbers, each padded with zeros to DenseFactor::room(n).
struct FloatColumns {
    float* x;
    float* y;
    float* z;
};

/// Three consecutive columns.
/// @param room numbers per column.
inline FloatColumns columns_at(float* begin, std::size_t room)
{
    return {begin, begin + room, begin + 2 * room};
}

/// A small dense symmetric matrix S = L D Lᵀ in single precision, for many products with S and S⁻¹. S may have any
/// unit: it is stored as scale() S₁, so that S₁ and its inverse fit in single precision.
///
/// Products are fastest if columns are aligned to registers, as consecutive columns in AlignedFloats are.
class DenseFactor {
  public:
    /// The number of rows processed at once.
    static constexpr Index lanes = 8;

    /// The padded length of a column of n numbers.
    [[nodiscard]] static std::size_t room(Index n) { return usize((n + lanes - 1) / lanes * lanes); }

    /// Takes over a factorisation.
    /// @param scale the factor is multiplied by this: see LdlFactor::scale.
    template <class Number>
    void take(const DenseLdl<Number>& factor, double scale);

    [[nodiscard]] Index n() const { return n_; }

    /// The scale of S, a power of two.
    [[nodiscard]] double scale() const { return scale_; }

    /// result, not aliasing v, becomes S₁ v, and v becomes Rᵀ v with R = L √D₁, so that S₁ = R Rᵀ.
    void multiply(FloatColumns v, FloatColumns result) const;

    /// v becomes S₁⁻¹ v.
    /// @param scratch is overwritten.
    void solve(FloatColumns v, FloatColumns scratch) const;

    /// Prefetches the first data of the next product: most factors are outside the caches.
    void prefetch() const;

    /// The diagonal of S.
    [[nodiscard]] const std::vector<double>& diagonal() const { return diagonal_; }

  private:
    Index n_ = 0;
    double scale_ = 1.0;
    /// L without its diagonal in blocks of four columns. Each block begins at the eight rows that contain its diagonal:
    /// for every eight rows the four columns, one after the other, with zeros in the upper triangle.
    AlignedFloats lower_;
    /// √D₁ and the inverse of D₁, padded with zeros. D₁ is the D of S₁.
    std::vector<float> root_;
    std::vector<float> inverse_;
    std::vector<double> diagonal_;
};

}  // namespace seamflow
