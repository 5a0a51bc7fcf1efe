#pragma once

#include <vector>

#include "solvers/direct/ldl_solver.h"

namespace seamflow {

/// So many single-precision numbers, in whole cache lines.
class AlignedFloats {
  public:
    /// Makes room for n at least. All are 0 afterwards.
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

/// Three columns of n numbers. Each has room for DenseFactor::room(n), 0 from the n-th on.
struct FloatColumns {
    float* x;
    float* y;
    float* z;
};

/// Three columns one after the other.
/// @param room numbers for each.
inline FloatColumns columns_at(float* begin, std::size_t room)
{
    return {begin, begin + room, begin + 2 * room};
}

/// A small dense symmetric matrix S = L D Lᵀ in single precision, for many products with S and S⁻¹. S has any unit: it
/// is kept as scale() S₁, where single precision has room for S₁ and its inverse.
///
/// Products are fastest where columns begin at whole registers, as those one after the other in AlignedFloats do.
class DenseFactor {
  public:
    /// Rows that are used at once.
    static constexpr Index lanes = 8;

    /// How many numbers a column of n has room for.
    [[nodiscard]] static std::size_t room(Index n) { return at((n + lanes - 1) / lanes * lanes); }

    /// Takes a factorisation over.
    /// @param scale by which the factor is to be multiplied: see LdlFactor::scale.
    template <class Number>
    void take(const DenseLdl<Number>& factor, double scale);

    [[nodiscard]] Index n() const { return n_; }

    /// A power of two.
    [[nodiscard]] double scale() const { return scale_; }

    /// result, which is elsewhere, becomes S₁ v, and v becomes Rᵀ v with R = L √D₁, so that S₁ = R Rᵀ.
    void multiply(FloatColumns v, FloatColumns result) const;

    /// v becomes S₁⁻¹ v.
    /// @param scratch receives nothing of use.
    void solve(FloatColumns v, FloatColumns scratch) const;

    /// Asks for what the next product begins with: most factors come from outside the caches.
    void prefetch() const;

    /// The diagonal of S.
    [[nodiscard]] const std::vector<double>& diagonal() const { return diagonal_; }

  private:
    Index n_ = 0;
    double scale_ = 1.0;
    /// L without its diagonal by blocks of four columns, each from the group of eight rows on that its own are in:
    /// for every eight rows the four columns, one after the other, with zeros in the upper triangle.
    AlignedFloats lower_;
    /// √D₁, and the inverses of D₁; with zeros as far as there is room.
    std::vector<float> root_;
    std::vector<float> inverse_;
    std::vector<double> diagonal_;
};

}  // namespace seamflow
