#include "solvers/direct/dense_factor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "solvers/direct/simd.h"

namespace seamflow {

namespace {

/// The number of columns of a block, of rows that are processed at once, and of entries of L in a tile of these rows
/// and columns.
constexpr Index block_width = 4;
constexpr Index n_lanes = DenseFactor::lanes;
constexpr Index tile_size = block_width * n_lanes;
/// The distance, in tiles, at which tiles are prefetched before their use: most factors are outside the caches.
constexpr Index tiles_ahead = 96;

using Lanes = SimdVector<float, n_lanes>;

/// A prefetch at a distance after a tile. Compilers omit calls of functions that contain only a prefetch.
[[gnu::always_inline]] inline void prefetch_after(const float* tile)
{
    // The last tiles prefetch memory after the factor, which does no harm.
    const std::uintptr_t ahead =
        reinterpret_cast<std::uintptr_t>(tile) + usize(tiles_ahead * tile_size) * sizeof(float);
    for (std::size_t byte = 0; byte < usize(tile_size) * sizeof(float); byte += 64)
        __builtin_prefetch(reinterpret_cast<const void*>(ahead + byte));
}

/// One number for each column of a block.
struct FourSums {
    float of[block_width];
};

/// Four sums for each of three vectors.
struct Fours {
    FourSums x;
    FourSums y;
    FourSums z;
};

/// Some rows of three vectors. All three vectors are multiplied with a tile at once: this needs a third of the loops,
/// whose ends processors do not predict.
struct Rows {
    Lanes x{};
    Lanes y{};
    Lanes z{};

    [[gnu::always_inline]] void load_from(const FloatColumns& v, Index first)
    {
        load(v.x + first, x);
        load(v.y + first, y);
        load(v.z + first, z);
    }
    [[gnu::always_inline]] void store_to(const FloatColumns& v, Index first) const
    {
        store(x, v.x + first);
        store(y, v.y + first);
        store(z, v.z + first);
    }
    [[gnu::always_inline]] void add_products(const Lanes& column, const Rows& rows)
    {
        x += column * rows.x;
        y += column * rows.y;
        z += column * rows.z;
    }
    [[gnu::always_inline]] void add_multiples(float of_x, float of_y, float of_z, const Lanes& column)
    {
        x += of_x * column;
        y += of_y * column;
        z += of_z * column;
    }
};

/// The sum of each of four registers.
inline FourSums sums_of(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d)
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

/// Four columns of L; fewer in the last block.
struct Block {
    const float* tiles;
    Index n_tiles;
    /// The number of the first column.
    Index begin;

    /// The number of the first row of the first tile.
    [[nodiscard]] Index top() const { return begin / n_lanes * n_lanes; }
    /// An entry of L in the rows of the block's diagonal. Row and column are counted from the block's first; row >
    /// column.
    [[nodiscard]] float own(Index row, Index column) const { return tiles[column * n_lanes + begin - top() + row]; }
};

/// The entries of v in the block's own rows.
inline FourSums own_rows(const Block& block, const float* v)
{
    FourSums rows;
    std::memcpy(&rows, v + block.begin, sizeof rows);
    return rows;
}

inline void store_own_rows(const Block& block, const FourSums& rows, float* v)
{
    std::memcpy(v + block.begin, &rows, sizeof rows);
}

inline FourSums negative(FourSums rows)
{
    for (float& row : rows.of)
        row = -row;
    return rows;
}

/// Adds the block times the factors to v.
inline void add_multiples(const Block& block, const Fours& factors, const FloatColumns& v)
{
    const auto& [x, y, z] = factors;
    const float* tile = block.tiles;
    Index row = block.top();
    for (Index t = 0; t < block.n_tiles; ++t, tile += tile_size, row += n_lanes) {
        prefetch_after(tile);
        Rows sums;
        sums.load_from(v, row);
        Lanes column;
        load(tile, column);
        sums.add_multiples(x.of[0], y.of[0], z.of[0], column);
        load(tile + n_lanes, column);
        sums.add_multiples(x.of[1], y.of[1], z.of[1], column);
        load(tile + 2 * n_lanes, column);
        sums.add_multiples(x.of[2], y.of[2], z.of[2], column);
        load(tile + 3 * n_lanes, column);
        sums.add_multiples(x.of[3], y.of[3], z.of[3], column);
        sums.store_to(v, row);
    }
}

/// The block, transposed, times v. The rows are processed from the last to the first, because the block's own rows may
/// just have been computed.
inline Fours multiply_transposed(const Block& block, const FloatColumns& v)
{
    Rows a, b, c, d;
    for (Index t = block.n_tiles; t-- > 0;) {
        const float* tile = block.tiles + t * tile_size;
        prefetch_after(tile);
        Rows rows;
        rows.load_from(v, block.top() + t * n_lanes);
        Lanes column;
        load(tile, column);
        a.add_products(column, rows);
        load(tile + n_lanes, column);
        b.add_products(column, rows);
        load(tile + 2 * n_lanes, column);
        c.add_products(column, rows);
        load(tile + 3 * n_lanes, column);
        d.add_products(column, rows);
    }
    return {sums_of(a.x, b.x, c.x, d.x), sums_of(a.y, b.y, c.y, d.y), sums_of(a.z, b.z, c.z, d.z)};
}

/// L in its stored form.
struct Lower {
    const float* tiles;
    Index n;

    /// The number of groups of n_lanes rows.
    [[nodiscard]] Index n_groups() const { return (n + n_lanes - 1) / n_lanes; }

    /// The number of tiles before a block.
    [[nodiscard]] Index tiles_before(Index begin) const
    {
        const Index whole = begin / n_lanes;
        const Index in_whole = n_lanes / block_width * (whole * n_groups() - whole * (whole - 1) / 2);
        return in_whole + (begin % n_lanes) / block_width * (n_groups() - whole);
    }
    [[nodiscard]] Block block(Index begin) const
    {
        return {tiles + usize(tiles_before(begin)) * usize(tile_size), n_groups() - begin / n_lanes, begin};
    }
    /// The first column of the last block; negative if there is none.
    [[nodiscard]] Index last_block() const { return (n + block_width - 1) / block_width * block_width - block_width; }
};

/// result += R Rᵀ v and v = Rᵀ v, where R is L with scaled columns. A block is used for both products while it is in
/// the caches.
SEAMFLOW_WIDE void multiply_twice(Lower lower, const float* scales, FloatColumns v, FloatColumns result)
{
    for (Index begin = 0; begin < lower.n; begin += block_width) {
        const Block block = lower.block(begin);
        Fours factors = multiply_transposed(block, v);
        const auto scale = [&](float* from, FourSums& products, float* to) {
            for (Index c = 0; c < block_width; ++c) {
                from[begin + c] = scales[begin + c] * (from[begin + c] + products.of[c]);
                products.of[c] = scales[begin + c] * from[begin + c];
                to[begin + c] += products.of[c];
            }
        };
        scale(v.x, factors.x, result.x);
        scale(v.y, factors.y, result.y);
        scale(v.z, factors.z, result.z);
        add_multiples(block, factors, result);
    }
}

/// result = L⁻¹ v; v is overwritten.
SEAMFLOW_WIDE void forward_substitute(Lower lower, FloatColumns v, FloatColumns result)
{
    for (Index begin = 0; begin < lower.n; begin += block_width) {
        const Block block = lower.block(begin);
        const auto solve = [&](const float* from, float* to) {
            FourSums rows = own_rows(block, from);
            for (Index row = 1; row < block_width; ++row)
                for (Index c = 0; c < row; ++c)
                    rows.of[row] -= block.own(row, c) * rows.of[c];
            store_own_rows(block, rows, to);
            return negative(rows);
        };
        const Fours factors = {solve(v.x, result.x), solve(v.y, result.y), solve(v.z, result.z)};
        add_multiples(block, factors, v);
    }
}

/// result = L⁻ᵀ v; result must be 0 before.
SEAMFLOW_WIDE void back_substitute(Lower lower, FloatColumns v, FloatColumns result)
{
    for (Index begin = lower.last_block(); begin >= 0; begin -= block_width) {
        const Block block = lower.block(begin);
        const auto solve = [&](const float* from, const FourSums& products, float* to) {
            FourSums rows = own_rows(block, from);
            for (Index c = block_width - 1; c >= 0; --c) {
                rows.of[c] -= products.of[c];
                for (Index row = c + 1; row < block_width; ++row)
                    rows.of[c] -= block.own(row, c) * rows.of[row];
            }
            store_own_rows(block, rows, to);
        };
        // The contribution of the block's own rows is still 0.
        const Fours products = multiply_transposed(block, result);
        solve(v.x, products.x, result.x);
        solve(v.y, products.y, result.y);
        solve(v.z, products.z, result.z);
    }
}

SEAMFLOW_WIDE void multiply_by_diagonal(const std::vector<float>& diagonal, FloatColumns v)
{
    for (float* column : {v.x, v.y, v.z})
        for (std::size_t i = 0; i < diagonal.size(); ++i)
            column[i] *= diagonal[i];
}

void set_zero(const FloatColumns& v, std::size_t n)
{
    std::fill_n(v.x, n, 0.0F);
    std::fill_n(v.y, n, 0.0F);
    std::fill_n(v.z, n, 0.0F);
}

}  // namespace

template <class Number>
void DenseFactor::take(const DenseLdl<Number>& factor, double scale)
{
    n_ = static_cast<Index>(factor.rows());
    const Eigen::VectorXd pivots = factor.diagonal().template cast<double>();
    const double unit = n_ > 0 ? power_of_two_near(pivots.maxCoeff()) : 1.0;
    scale_ = scale * unit;
    root_.assign(room(n_), 0.0F);
    inverse_.assign(room(n_), 0.0F);
    diagonal_.resize(n_);
    for (Index row = 0; row < n_; ++row) {
        const double pivot = pivots[row] / unit;
        root_[row] = static_cast<float>(std::sqrt(pivot));
        inverse_[row] = static_cast<float>(1.0 / pivot);
        diagonal_[row] = scale * (pivots[row] + factor.row(row).head(row).template cast<double>().cwiseAbs2().dot(
                                                    pivots.head(row).transpose()));
    }
    Lower lower{nullptr, n_};
    lower_.assign(usize(lower.tiles_before(static_cast<Index>(room(n_)))) * usize(tile_size));
    lower.tiles = lower_.data();
    for (Index begin = 0; begin < n_; begin += block_width) {
        const Block block = lower.block(begin);
        float* const entries = lower_.data() + (block.tiles - lower.tiles);
        for (Index row = begin + 1; row < n_; ++row) {
            const Index below = row - block.top();
            float* const first = entries + below / n_lanes * tile_size + below % n_lanes;
            for (Index c = 0; c < std::min(block_width, row - begin); ++c)
                first[c * n_lanes] = static_cast<float>(factor(row, begin + c));
        }
    }
}

template void DenseFactor::take(const DenseLdl<float>&, double);
template void DenseFactor::take(const DenseLdl<double>&, double);

void DenseFactor::prefetch() const
{
    const std::size_t n = std::min(lower_.size(), usize(tiles_ahead) * usize(tile_size));
    for (std::size_t i = 0; i < n; i += 64 / sizeof(float))
        __builtin_prefetch(lower_.data() + i);
}

void DenseFactor::multiply(FloatColumns v, FloatColumns result) const
{
    set_zero(result, root_.size());
    multiply_twice({lower_.data(), n_}, root_.data(), v, result);
}

void DenseFactor::solve(FloatColumns v, FloatColumns scratch) const
{
    forward_substitute({lower_.data(), n_}, v, scratch);
    multiply_by_diagonal(inverse_, scratch);
    set_zero(v, inverse_.size());
    back_substitute({lower_.data(), n_}, scratch, v);
}

}  // namespace seamflow
