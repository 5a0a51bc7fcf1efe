#pragma once

#include <cstddef>
#include <span>

#include "partition/index.h"
#include "solvers/direct/simd.h"

namespace seamflow {

/// A block of columns of L, row by row: L below the diagonal, D on it, unused entries above it. Numbers are float or
/// double.
template <class Number>
struct LdlPanel {
    Number* values;
    /// Number of columns.
    Index width;
    /// The unknowns of the rows, ascending: first those of the columns.
    std::span<const Index> rows;
};

/// Subtracts an earlier block's contribution from a block.
/// @param place the first of the `n_columns` rows of the earlier block that belong to columns of the later one.
/// @param target_rows per unknown of the earlier block from rows[place] on: its row in the later one.
/// @param width see with_simd_width: the result is the same with any.
template <class Number>
void subtract_update(const LdlPanel<Number>& earlier, Index place, Index n_columns, const Index* target_rows,
                     const LdlPanel<Number>& later, Index width = register_width());

/// Factorises a block from which all earlier contributions have been subtracted.
/// @param width see with_simd_width: the result is the same with any.
/// @returns whether D is finite and nowhere 0.
template <class Number>
bool factorise_panel(const LdlPanel<Number>& panel, Index width = register_width());

/// Numbers in a row: three right-hand sides and an unused one, so that rows fill registers.
constexpr Index ldl_row = 4;
/// The same of many right-hand sides, for each of which a factor is read from memory less often.
constexpr Index wide_ldl_row = 16;

/// Eliminates a block's unknowns from right-hand sides.
/// @tparam Length ldl_row; in double precision wide_ldl_row, too: each column is then as with that.
/// @param x all unknowns by Length, row by row.
template <Index Length, class Number>
void forward_substitute_panel(const LdlPanel<Number>& panel, Number* x);

/// Solves for a block's unknowns, with those of its other rows given.
/// @tparam Length as above. @param x as above.
template <Index Length, class Number>
void back_substitute_panel(const LdlPanel<Number>& panel, Number* x);

}  // namespace seamflow
