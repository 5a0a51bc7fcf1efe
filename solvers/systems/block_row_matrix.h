#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "solvers/direct/simd.h"
#include "solvers/krylov/stopping_criterion.h"

namespace seamflow {

/// A large symmetric positive definite matrix A, by blocks of consecutive rows and in single precision, with conjugate
/// gradients for three columns at once. The preconditioner is an incomplete factorisation of each diagonal block that
/// changes nothing but the diagonal, (D + L) D⁻¹ (D + Lᵀ), L being the entries of A below the diagonal. With it, the
/// product with A follows from the solution with the preconditioner, and an iteration reads each entry once (Eisenstat,
/// Efficient Implementation of a Class of Preconditioned Conjugate Gradient Methods, 1981; Saad, Iterative Methods for
/// Sparse Linear Systems, 2003, 9.2.2). Sums are taken in a fixed order: the bits do not depend on how loops are run.
class BlockRowMatrix {
  public:
    /// Three columns and a column of zeros, so that a row fills a register.
    using Row = Eigen::Array4f;
    /// The three columns alone, which take less memory, for arrays whose rows are read only one after the other.
    class StoredRow {
      public:
        StoredRow() = default;
        // The members are single numbers: the compiler would keep arrays in memory.
        StoredRow(const Row& row)
        {
            SimdVector<float, 4> all;
            load(row.data(), all);
            for (int c = 0; c < 3; ++c)
                columns_[c] = all[c];
        }
        operator Row() const
        {
            Row row;
            store(SimdVector<float, 4>{columns_[0], columns_[1], columns_[2], 0.0F}, row.data());
            return row;
        }

      private:
        float columns_[3];
    };
    /// The most rows of a block.
    static constexpr Index most_rows = 1 << 16;
    /// The columns of each row of a block, ascending, without the diagonal. Rows of the identity have none.
    using Pattern = std::function<IndexLists(Index block)>;

    /// @param blocks #blocks + 1: the first row of each block, then the number of rows.
    /// @param pattern called once for each block, from several threads at the same time.
    /// @throws ComputationError if there are 2³¹ entries or more below the diagonals of the blocks, above them, or
    /// outside the blocks.
    BlockRowMatrix(std::vector<Index> blocks, const Pattern& pattern, const Executor& exec);

    [[nodiscard]] Index n_rows() const { return blocks_.back(); }

    /// A row, and the first row of its block.
    struct BlockRow {
        Index begin;
        Index row;
    };
    /// Runs body(BlockRow) for all rows, several blocks at the same time.
    /// @returns the sum of the results of body, of some matrix type.
    template <class Sum, class Body>
    Sum sum_of_rows(const Executor& exec, Body&& body) const;
    /// An off-diagonal entry.
    struct Entry {
        float& value;
        /// The same entry in double precision; null unless keep_exact has been called.
        double* exact;
    };
    /// Calls visit(column, entry) for the off-diagonal entries of a row.
    template <class Visit>
    void for_each_entry(const BlockRow& in_block, Visit&& visit);
    /// The entry of a row in this column, which must exist.
    Entry entry(const BlockRow& in_block, Index column);
    /// Stores each entry in double precision, too. The values in double precision are not yet set.
    void keep_exact();
    [[nodiscard]] bool keeps_exact() const { return keeps_exact_; }
    void set_diagonal(Index i, float value) { diagonal_[i] = value; }
    [[nodiscard]] float diagonal(Index i) const { return diagonal_[i]; }
    /// Sets row i of the residual, from which the iteration starts; to be called for all rows before `start`.
    void set_residual(Index i, const Row& row) { residual_[i] = row; }
    /// Row i of the solution, after the iteration.
    [[nodiscard]] Row increment(Index i) const { return increment_[i]; }

    /// Builds the preconditioner once all entries are set.
    void factorise(const Executor& exec);
    /// Scales the residual and initialises the iteration.
    /// @returns per column, the squared norm of the scaled residual, in the norm of the inverse preconditioner.
    Eigen::Array4d start(float scale, const Executor& exec);

    struct Result : IterationResult {
        /// The largest change of a row of the increment in the last iteration.
        double last_update = 0.0;
    };
    /// Solves A increment = residual, from increment = 0 on (after start).
    /// @param squared the result of start, for a residual of about 1 per row, so that squares fit in single precision.
    /// @param goal the fraction of the residual that may be left.
    Result iterate(const Eigen::Array4d& squared, double goal, int most_iterations, const Executor& exec);

  private:
    template <class Value>
    using Buffer = std::unique_ptr<Value[]>;
    /// A column within a block, counted from the first row of the block.
    using Inner = std::uint16_t;
    /// The entries of each row on one side: below the diagonal, above the diagonal, or outside the block.
    template <class Column>
    struct Entries {
        std::vector<Index> begin;
        Buffer<Column> columns;
        Buffer<float> values;
        /// The values in double precision; empty unless keep_exact has been called.
        Buffer<double> exact;

        /// Multiplies by the entries. The class keeps plain pointers: the compiler assumes that writing a row may
        /// change any member.
        class Product {
          public:
            explicit Product(const Entries& entries)
                : begin_(entries.begin.data())
                , columns_(entries.columns.get())
                , values_(entries.values.get())
            {
            }

            /// @param rows one row per column of A.
            void subtract_from(Row& sum, Index i, const Row* rows) const
            {
                const Index end = begin_[i + 1];
                for (Index e = begin_[i]; e < end; ++e)
                    sum -= values_[e] * rows[columns_[e]];
            }

          private:
            const Index* begin_;
            const Column* columns_;
            const float* values_;
        };

        Entry entry(Index e) { return {values[e], exact ? &exact[e] : nullptr}; }

        /// The index in `columns` of a column of row i; -1 if row i has no such entry.
        Index find(Index i, Column column) const
        {
            const Column* const end = columns.get() + begin[i + 1];
            const Column* const first = columns.get() + begin[i];
            const Column* const found = std::lower_bound(first, end, column);
            return found != end && *found == column ? static_cast<Index>(found - columns.get()) : -1;
        }
    };

    /// Runs body(block, begin, end) for the rows of each block.
    template <class Body>
    void for_each_block(const Executor& exec, Body&& body) const
    {
        for_each(exec, static_cast<Index>(blocks_.size()) - 1,
                 [&](Index block) { body(block, blocks_[block], blocks_[block + 1]); });
    }
    /// The sum of body(begin, end) over the blocks.
    template <class Sum, class Body>
    Sum sum_of_blocks(const Executor& exec, Body&& body) const
    {
        std::vector<Sum> parts(blocks_.size(), Sum::Zero());
        for_each_block(exec, [&](Index block, Index begin, Index end) { parts[block] = body(begin, end); });
        Sum sum = Sum::Zero();
        for (const Sum& part : parts)
            sum += part;
        return sum;
    }

    void solve_upper(const Row& alpha, const Row& beta, const Executor& exec);
    Eigen::Array4d solve_lower(const Executor& exec);
    Eigen::Array4d update_residual(const Row& alpha, const Executor& exec);

    std::vector<Index> blocks_;
    /// The entries below and above the diagonal within a block. Their columns are counted from the first row of the
    /// block.
    Entries<Inner> lower_;
    Entries<Inner> upper_;
    /// Entries whose columns are in other blocks; the preconditioner leaves them out.
    Entries<Index> outer_;
    bool keeps_exact_ = false;
    Buffer<float> diagonal_;
    /// The diagonal D of the incomplete factorisation (D + L) D⁻¹ (D + Lᵀ) of each block.
    Buffer<float> pivot_;
    /// The vectors of the iteration: (D + L)⁻¹ r, r being the residual; the direction p; t = (D + Lᵀ)⁻¹ p; q - t with q
    /// = (D + L)⁻¹ A t; the solution.
    Buffer<StoredRow> residual_;
    Buffer<StoredRow> direction_;
    Buffer<Row> step_;
    Buffer<Row> product_;
    Buffer<StoredRow> increment_;
};

template <class Sum, class Body>
Sum BlockRowMatrix::sum_of_rows(const Executor& exec, Body&& body) const
{
    return sum_of_blocks<Sum>(exec, [&](Index begin, Index end) {
        Sum sum = Sum::Zero();
        for (Index i = begin; i < end; ++i)
            sum += body(BlockRow{begin, i});
        return sum;
    });
}

template <class Visit>
void BlockRowMatrix::for_each_entry(const BlockRow& in_block, Visit&& visit)
{
    const Index i = in_block.row;
    for (Entries<Inner>* part : {&lower_, &upper_})
        for (Index e = part->begin[i]; e < part->begin[i + 1]; ++e)
            visit(in_block.begin + part->columns[e], part->entry(e));
    for (Index e = outer_.begin[i]; e < outer_.begin[i + 1]; ++e)
        visit(outer_.columns[e], outer_.entry(e));
}

}  // namespace seamflow
