#pragma once

#include <cstddef>
#include <span>

#include "partition/index.h"
#include "solvers/direct/simd.h"

namespace seamflow {

/// A block of columns of L, row by row; below the diagonal are the entries of L, on it those of D, above it nothing of
/// use.
struct LdlPanel {
    double* values;
    /// Number of columns.
    Index width;
    /// The unknowns whose rows these are, ascending: first those of the columns.
    std::span<const Index> rows;
};

/// Takes what an earlier block contributes away from a block.
/// @param place the first of the earlier block's rows that belong to columns of the later one; `n_columns` do.
/// @param target_rows per unknown from rows[place] on of the earlier block: its row of the later one.
/// @param width see with_simd_width: the result is the same with any.
void subtract_update(const LdlPanel& earlier, Index place, Index n_columns, const Index* target_rows,
                     const LdlPanel& later, Index width = register_width());

/// Factorises a block from which all that earlier blocks contribute has been taken away.
/// @param width see with_simd_width: the result is the same with any.
/// @returns whether all of D is positive and finite.
bool factorise_panel(const LdlPanel& panel, Index width = register_width());

/// Eliminates a block's unknowns from three right-hand sides.
/// @param x all unknowns by 3, row by row.
void forward_substitute_panel(const LdlPanel& panel, double* x);

/// Solves for a block's unknowns, with those of its other rows given.
/// @param x all unknowns by 3, row by row.
void back_substitute_panel(const LdlPanel& panel, double* x);

}  // namespace seamflow
