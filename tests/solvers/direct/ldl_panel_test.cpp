#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "solvers/direct/ldl_panel.h"
#include "tests/support/random_matrices.h"
#include "tests/support/relative.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// A block with numbers of its own.
template <class Number>
struct Block {
    Index width;
    std::vector<Index> rows;
    std::vector<Number> values;

    LdlPanel<Number> panel() { return {values.data(), width, rows}; }

    /// Row by row what is on and below the diagonal, and so of use.
    [[nodiscard]] std::vector<Number> lower() const
    {
        std::vector<Number> lower;
        for (std::size_t row = 0; row < rows.size(); ++row) {
            const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row * usize(width));
            lower.insert(lower.end(), begin,
                         begin + std::min(static_cast<std::ptrdiff_t>(row) + 1, std::ptrdiff_t{width}));
        }
        return lower;
    }
};

/// @param rows ascending, the block's own among them.
template <class Number>
Block<Number> random_block(Index width, std::vector<Index> rows, RandomNumbers& random)
{
    Block<Number> block{width, std::move(rows), {}};
    block.values.resize(usize(width) * block.rows.size());
    std::generate(block.values.begin(), block.values.end(), [&] { return static_cast<Number>(random.symmetric()); });
    for (Index c = 0; c < width; ++c)
        block.values[usize(c) * usize(width + 1)] = 2 * static_cast<Number>(block.rows.size());
    return block;
}

/// Some of the numbers from begin to end, ascending.
std::vector<Index> some_of(Index begin, Index end, RandomNumbers& random)
{
    std::vector<Index> some;
    for (Index i = begin; i < end; ++i)
        if (random.below(3) > 0)
            some.push_back(i);
    return some;
}

/// Those widths of registers that this machine has.
std::vector<Index> widths()
{
    std::vector<Index> widths;
    for (Index width = 2; width <= register_width(); width *= 2)
        widths.push_back(width);
    return widths;
}

/// By the definition: an earlier block's rows times D Lᵀ of some of them.
template <class Number>
void subtract_by_definition(const LdlPanel<Number>& earlier, Index place, Index n_columns,
                            const std::vector<Index>& targets, const LdlPanel<Number>& later)
{
    const auto entry = [&](Index row, Index column) { return earlier.values[row * earlier.width + column]; };
    for (Index i = 0; i < static_cast<Index>(targets.size()); ++i)
        for (Index t = 0; t < std::min(n_columns, i + 1); ++t)
            for (Index c = 0; c < earlier.width; ++c)
                later.values[targets[i] * later.width + targets[t]] -=
                    entry(place + i, c) * entry(c, c) * entry(place + t, c);
}

/// How far results may be from what exact arithmetic would give, relative to 1.
template <class Number>
constexpr double rounding_of_panels = 1e4 * std::numeric_limits<Number>::epsilon();

}  // namespace

TEST_CASE_TEMPLATE(
    "blocks take away from later ones what they contribute, with the same bits in registers of any width", Number,
    float, double)
{
    RandomNumbers random(7);
    for (int round = 0; round < 300; ++round) {
        const Index earlier_width = 1 + random.below(80);
        const Index later_width = 1 + random.below(40);
        const Index n_below = random.below(30);
        const std::vector<Index> columns = some_of(0, later_width, random);
        if (columns.empty())
            continue;
        std::vector<Index> targets = columns;
        const std::vector<Index> below = some_of(later_width, later_width + n_below, random);
        targets.insert(targets.end(), below.begin(), below.end());

        const Index place = earlier_width + random.below(3);
        std::vector<Index> earlier_rows(usize(place) + targets.size());
        std::iota(earlier_rows.begin(), earlier_rows.end(), 0);
        Block<Number> earlier = random_block<Number>(earlier_width, earlier_rows, random);
        std::vector<Index> later_rows(later_width + n_below);
        std::iota(later_rows.begin(), later_rows.end(), 0);
        const Block<Number> before = random_block<Number>(later_width, later_rows, random);

        Block<Number> expected = before;
        const auto n_columns = static_cast<Index>(columns.size());
        subtract_by_definition(earlier.panel(), place, n_columns, targets, expected.panel());
        Block<Number> first = before;
        subtract_update(earlier.panel(), place, n_columns, targets.data(), first.panel(), 2);
        const std::vector<Number> result = first.lower();
        const std::vector<Number> wanted = expected.lower();
        for (std::size_t i = 0; i < result.size(); ++i)
            CHECK(std::abs(result[i] - wanted[i]) <= 1e3 * rounding_of_panels<Number>);
        for (const Index width : widths()) {
            Block<Number> later = before;
            subtract_update(earlier.panel(), place, n_columns, targets.data(), later.panel(), width);
            CHECK(later.lower() == result);
        }
    }
}

TEST_CASE_TEMPLATE("a block is factorised with the same bits in registers of any width", Number, float, double)
{
    RandomNumbers random(8);
    for (int round = 0; round < 100; ++round) {
        const Index width = 1 + random.below(60);
        std::vector<Index> rows(width + random.below(30));
        std::iota(rows.begin(), rows.end(), 0);
        const Block<Number> before = random_block<Number>(width, rows, random);
        Block<Number> first = before;
        REQUIRE(factorise_panel(first.panel(), 2));
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (Index column = 0; column <= std::min(static_cast<Index>(i), width - 1); ++column) {
                const auto entry = [&](std::size_t row, Index c) {
                    return first.values[row * usize(width) + usize(c)];
                };
                double sum = 0.0;
                for (Index c = 0; c <= column; ++c)
                    sum += (static_cast<Index>(i) == c ? 1.0 : entry(i, c)) * entry(usize(c), c) *
                           (column == c ? 1.0 : entry(usize(column), c));
                CHECK(std::abs(sum - before.values[i * usize(width) + usize(column)]) <=
                      1e2 * rounding_of_panels<Number>);
            }
        for (const Index of_registers : widths()) {
            Block<Number> block = before;
            REQUIRE(factorise_panel(block.panel(), of_registers));
            CHECK(block.lower() == first.lower());
        }
    }
}

TEST_CASE_TEMPLATE("a pivot of zero will not do, wherever it comes", Number, float, double)
{
    for (Index width = 1; width <= 12; ++width)
        for (Index zero = 0; zero < width; ++zero) {
            Block<Number> block{width, std::vector<Index>(width),
                                std::vector<Number>(usize(width) * usize(width), Number{})};
            std::iota(block.rows.begin(), block.rows.end(), 0);
            for (Index c = 0; c < width; ++c)
                block.values[usize(c) * usize(width + 1)] = c == zero ? Number{0} : Number{1};
            for (const Index of_registers : widths()) {
                Block<Number> copy = block;
                CHECK_FALSE(factorise_panel(copy.panel(), of_registers));
            }
        }
}
