#include "solvers/interface/dense_factor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "solvers/interface/power_of_two.h"
#include "solvers/wide.h"

namespace seamflow {

namespace {

/// Columns in a block, rows that are used at once, and how much of L that makes.
constexpr Index group = 4;
constexpr Index n_lanes = DenseFactor::lanes;
constexpr Index tile_size = group * n_lanes;
/// So many tiles before they are used, they are asked for: most factors come from outside the caches.
constexpr Index tiles_ahead = 96;

// By name, because compilers do not find sums in loops.
using Lanes [[gnu::vector_size(32)]] = float;
static_assert(sizeof(Lanes) == sizeof(float) * at(n_lanes));

inline void load(const float* from, Lanes& lanes)
{
    std::memcpy(&lanes, from, sizeof lanes);
}

inline void store(const Lanes& lanes, float* to)
{
    std::memcpy(to, &lanes, sizeof lanes);
}

/// Compilers leave out calls of functions that do nothing but this.
[[gnu::always_inline]] inline void prefetch_after(const float* tile)
{
    // The last ones ask for what is after the factor, which does no harm.
    const std::uintptr_t ahead = reinterpret_cast<std::uintptr_t>(tile) + at(tiles_ahead * tile_size) * sizeof(float);
    for (std::size_t byte = 0; byte < at(tile_size) * sizeof(float); byte += 64)
        __builtin_prefetch(reinterpret_cast<const void*>(ahead + byte));
}

/// One number for each column of a block.
struct Four {
    float of[group];
};

/// The sums of four registers each.
inline Four sums_of(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d)
{
    const Lanes ab = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11) +
                     __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
    const Lanes cd = __builtin_shufflevector(c, d, 0, 1, 2, 3, 8, 9, 10, 11) +
                     __builtin_shufflevector(c, d, 4, 5, 6, 7, 12, 13, 14, 15);
    Lanes all = __builtin_shufflevector(ab, cd, 0, 1, 4, 5, 8, 9, 12, 13) +
                __builtin_shufflevector(ab, cd, 2, 3, 6, 7, 10, 11, 14, 15);
    all += __builtin_shufflevector(all, all, 1, 0, 3, 2, 5, 4, 7, 6);
    return {{all[0], all[2], all[4], all[6]}};
}

/// Four columns of L, or fewer in the last block.
struct Block {
    const float* tiles;
    Index n_tiles;
    /// The first column.
    Index begin;

    /// The first row of the first tile.
    [[nodiscard]] Index top() const { return begin / n_lanes * n_lanes; }
    /// An entry of the block's own rows, row > column.
    [[nodiscard]] float own(Index row, Index column) const { return tiles[column * n_lanes + begin - top() + row]; }
};

inline Four own_rows(const Block& block, const float* v)
{
    Four rows;
    std::memcpy(&rows, v + block.begin, sizeof rows);
    return rows;
}

/// Adds sign · (the block) · factors to v.
template <int Sign>
inline void add_multiples(const Block& block, const Four& factors, float* v)
{
    constexpr auto sign = static_cast<float>(Sign);
    const float* tile = block.tiles;
    float* to = v + block.top();
    for (Index t = 0; t < block.n_tiles; ++t, tile += tile_size, to += n_lanes) {
        prefetch_after(tile);
        Lanes sums;
        load(to, sums);
        for (Index c = 0; c < group; ++c) {
            Lanes column;
            load(tile + c * n_lanes, column);
            sums += (sign * factors.of[c]) * column;
        }
        store(sums, to);
    }
}

/// The block, transposed, times v.
inline Four multiply_transposed(const Block& block, const float* v)
{
    Lanes sums[group] = {};
    const float* tile = block.tiles;
    for (Index t = 0; t < block.n_tiles; ++t, tile += tile_size) {
        prefetch_after(tile);
        Lanes values;
        load(v + block.top() + t * n_lanes, values);
        for (Index c = 0; c < group; ++c) {
            Lanes column;
            load(tile + c * n_lanes, column);
            sums[c] += column * values;
        }
    }
    return sums_of(sums[0], sums[1], sums[2], sums[3]);
}

/// L as it is stored.
struct Lower {
    const float* tiles;
    Index n;

    [[nodiscard]] Index n_groups() const { return (n + n_lanes - 1) / n_lanes; }

    /// How many tiles there are before a block.
    [[nodiscard]] Index tiles_before(Index begin) const
    {
        const Index whole = begin / n_lanes;
        const Index in_whole = n_lanes / group * (whole * n_groups() - whole * (whole - 1) / 2);
        return in_whole + (begin % n_lanes) / group * (n_groups() - whole);
    }
    [[nodiscard]] Block block(Index begin) const
    {
        return {tiles + at(tiles_before(begin)) * at(tile_size), n_groups() - begin / n_lanes, begin};
    }
    /// Below 0 where there is none.
    [[nodiscard]] Index last_block() const { return (n + group - 1) / group * group - group; }
};

/// result = Lᵀ v.
SEAMFLOW_WIDE void multiply_by_transposed(Lower lower, FloatColumns v, FloatColumns result)
{
    const auto multiply = [](const Block& block, const float* from, float* to) {
        const Four products = multiply_transposed(block, from);
        for (Index c = 0; c < group; ++c)
            to[block.begin + c] = from[block.begin + c] + products.of[c];
    };
    for (Index begin = 0; begin < lower.n; begin += group) {
        const Block block = lower.block(begin);
        multiply(block, v.x, result.x);
        multiply(block, v.y, result.y);
        multiply(block, v.z, result.z);
    }
}

/// Adds (L - 1) v to the result.
SEAMFLOW_WIDE void add_product(Lower lower, FloatColumns v, FloatColumns result)
{
    for (Index begin = 0; begin < lower.n; begin += group) {
        const Block block = lower.block(begin);
        add_multiples<1>(block, own_rows(block, v.x), result.x);
        add_multiples<1>(block, own_rows(block, v.y), result.y);
        add_multiples<1>(block, own_rows(block, v.z), result.z);
    }
}

/// result = L⁻¹ v; of v nothing of use remains.
SEAMFLOW_WIDE void eliminate(Lower lower, FloatColumns v, FloatColumns result)
{
    const auto solve = [](const Block& block, float* from, float* to) {
        Four rows = own_rows(block, from);
        for (Index row = 1; row < group; ++row)
            for (Index c = 0; c < row; ++c)
                rows.of[row] -= block.own(row, c) * rows.of[c];
        std::memcpy(to + block.begin, &rows, sizeof rows);
        add_multiples<-1>(block, rows, from);
    };
    for (Index begin = 0; begin < lower.n; begin += group) {
        const Block block = lower.block(begin);
        solve(block, v.x, result.x);
        solve(block, v.y, result.y);
        solve(block, v.z, result.z);
    }
}

/// result = L⁻ᵀ v, where it is 0 before.
SEAMFLOW_WIDE void substitute_back(Lower lower, FloatColumns v, FloatColumns result)
{
    const auto solve = [](const Block& block, const float* from, float* to) {
        // What the own rows would contribute is 0 as yet.
        const Four products = multiply_transposed(block, to);
        Four rows = own_rows(block, from);
        for (Index c = group - 1; c >= 0; --c) {
            rows.of[c] -= products.of[c];
            for (Index row = c + 1; row < group; ++row)
                rows.of[c] -= block.own(row, c) * rows.of[row];
        }
        std::memcpy(to + block.begin, &rows, sizeof rows);
    };
    for (Index begin = lower.last_block(); begin >= 0; begin -= group) {
        const Block block = lower.block(begin);
        solve(block, v.x, result.x);
        solve(block, v.y, result.y);
        solve(block, v.z, result.z);
    }
}

SEAMFLOW_WIDE void multiply_by_diagonal(const std::vector<float>& diagonal, FloatColumns v)
{
    for (float* column : {v.x, v.y, v.z})
        for (std::size_t i = 0; i < diagonal.size(); ++i)
            column[i] *= diagonal[i];
}

void copy(const FloatColumns& from, std::size_t n, const FloatColumns& to)
{
    std::copy_n(from.x, n, to.x);
    std::copy_n(from.y, n, to.y);
    std::copy_n(from.z, n, to.z);
}

void set_zero(const FloatColumns& v, std::size_t n)
{
    std::fill_n(v.x, n, 0.0F);
    std::fill_n(v.y, n, 0.0F);
    std::fill_n(v.z, n, 0.0F);
}

}  // namespace

void DenseFactor::take(const DenseLdl& factor)
{
    n_ = static_cast<Index>(factor.rows());
    scale_ = n_ > 0 ? power_of_two_near(factor.diagonal().maxCoeff()) : 1.0;
    root_.assign(room(n_), 0.0F);
    inverse_.assign(room(n_), 0.0F);
    diagonal_.resize(at(n_));
    const Eigen::VectorXd pivots = factor.diagonal();
    for (Index row = 0; row < n_; ++row) {
        const double pivot = pivots[row] / scale_;
        root_[at(row)] = static_cast<float>(std::sqrt(pivot));
        inverse_[at(row)] = static_cast<float>(1.0 / pivot);
        diagonal_[at(row)] = pivots[row] + factor.row(row).head(row).cwiseAbs2().dot(pivots.head(row));
    }
    Lower lower{nullptr, n_};
    lower_.assign(at(lower.tiles_before(static_cast<Index>(room(n_)))) * at(tile_size));
    lower.tiles = lower_.data();
    for (Index begin = 0; begin < n_; begin += group) {
        const Block block = lower.block(begin);
        float* const entries = lower_.data() + (block.tiles - lower.tiles);
        for (Index row = begin + 1; row < n_; ++row) {
            const Index below = row - block.top();
            float* const first = entries + below / n_lanes * tile_size + below % n_lanes;
            for (Index c = 0; c < std::min(group, row - begin); ++c)
                first[c * n_lanes] = static_cast<float>(factor(row, begin + c));
        }
    }
}

void DenseFactor::prefetch() const
{
    const std::size_t n = std::min(lower_.size(), at(tiles_ahead) * at(tile_size));
    for (std::size_t i = 0; i < n; i += 64 / sizeof(float))
        __builtin_prefetch(lower_.data() + i);
}

void DenseFactor::multiply(FloatColumns v, FloatColumns scratch) const
{
    multiply_by_root_transposed(v, scratch);
    multiply_by_root(scratch, v);
}

void DenseFactor::multiply_by_root_transposed(FloatColumns v, FloatColumns result) const
{
    multiply_by_transposed({lower_.data(), n_}, v, result);
    multiply_by_diagonal(root_, result);
}

void DenseFactor::multiply_by_root(FloatColumns v, FloatColumns result) const
{
    multiply_by_diagonal(root_, v);
    copy(v, root_.size(), result);
    add_product({lower_.data(), n_}, v, result);
}

void DenseFactor::solve(FloatColumns v, FloatColumns scratch) const
{
    eliminate({lower_.data(), n_}, v, scratch);
    multiply_by_diagonal(inverse_, scratch);
    set_zero(v, inverse_.size());
    substitute_back({lower_.data(), n_}, scratch, v);
}

}  // namespace seamflow
