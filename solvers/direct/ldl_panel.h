#pragma once

#include <cstddef>
#include <span>

#include "partition/index.h"
#include "solvers/direct/simd.h"

namespace seamflow {

/// A panel: a block of columns of L, row by row, with L below the diagonal, D on it, unused entries above it. Numbers
/// are float or double.
template <class Number>
struct LdlPanel {
    Number* values;
    /// Number of columns.
    Index width;
    /// The unknowns of the rows, ascending: first the unknowns of the columns.
    std::span<const Index> rows;
};

/// Subtracts the contribution of an earlier panel from a later one.
/// @param row_index the index of the first of the `n_columns` rows of the earlier panel that belong to columns of the
/// later one.
/// @param target_rows per unknown of the earlier panel from rows[row_index] on: the index of its row in the later one.
/// @param width of a register, in double-precision numbers: 2, 4 or 8. The result is the same with any.
template <class Number>
void subtract_update(const LdlPanel<Number>& earlier, Index row_index, Index n_columns, const Index* target_rows,
                     const LdlPanel<Number>& later, Index width = register_width());

/// Factorises a panel from which the contributions of all earlier panels have been subtracted.
/// @param width of a register, in double-precision numbers: 2, 4 or 8. The result is the same with any.
/// @returns whether D is finite and nowhere 0.
template <class Number>
bool factorise_panel(const LdlPanel<Number>& panel, Index width = register_width());

/// Numbers in a row: three right-hand sides and an unused one, so that rows fill registers.
constexpr Index ldl_row = 4;
/// Numbers in a row of many right-hand sides. With these, a factor is read from memory less often.
constexpr Index wide_ldl_row = 16;

/// Eliminates a panel's unknowns from right-hand sides.
/// @tparam Length ldl_row; or wide_ldl_row, in double precision, with the same result for each column.
/// @param x all unknowns by Length, row by row.
template <Index Length, class Number>
void forward_substitute_panel(const LdlPanel<Number>& panel, Number* x);

/// Solves for the unknowns of a panel's columns, given the unknowns of its other rows.
/// @tparam Length as for forward_substitute_panel. @param x all unknowns by Length, row by row.
template <Index Length, class Number>
void back_substitute_panel(const LdlPanel<Number>& panel, Number* x);

}  // namespace seamflow
