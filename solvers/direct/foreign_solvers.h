#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "partition/errors.h"
#include "solvers/direct/direct_solver.h"
#include "solvers/sparse/sparse_pattern.h"

/// Foreign solvers: solvers of other libraries behind the interface of direct solvers. Their factors are in the
/// libraries' own memory. In builds without CHOLMOD and UMFPACK (see gpl_parts), their functions throw
/// std::logic_error.
namespace seamflow {

/// CHOLMOD's LLᵀ of symmetric matrices by dense blocks, in the given order of the unknowns.
/// @param upper the entries on and above the diagonal, the whole diagonal among them.
/// @throws ComputationError if CHOLMOD fails (memory).
std::unique_ptr<DirectSolver> make_cholmod_llt(SparsePattern upper, CholmodWorkspace& workspace);

/// LU by UMFPACK. Pivots are taken from the diagonal; if these would lose nearly all digits, the largest entry of each
/// column is the pivot, and solutions are refined. A factor is nearly singular if the smallest pivot is nevertheless
/// below 1e-13 of the largest. Its size is an upper bound for most matrices, as long as diagonal pivots suffice.
/// @param pattern must outlive the solver.
/// @throws ComputationError if UMFPACK fails (memory).
std::unique_ptr<DirectSolver> make_umfpack_lu(const SparsePattern& pattern);

/// LU by Eigen, with the largest pivot of each column; solutions are refined. A factor is nearly singular if the
/// smallest pivot is below 1e-13 of the largest. Its size is known once there is a factor.
/// @throws ComputationError if Eigen fails (memory).
std::unique_ptr<DirectSolver> make_eigen_lu(const SparsePattern& pattern);

/// The ratio of the smallest pivot to the largest below which a solution has three digits or less.
constexpr double least_condition = 1e-13;

/// Views of a pattern's own arrays, which must outlive this; copies if SuiteSparse takes longer integers.
template <class Integer>
class PatternView {
  public:
    explicit PatternView(const SparsePattern& pattern)
        : offsets_(view(pattern.column_offsets, copied_offsets_))
        , rows_(view(pattern.rows, copied_rows_))
    {
    }
    PatternView(const PatternView&) = delete;
    PatternView& operator=(const PatternView&) = delete;

    [[nodiscard]] const Integer* offsets() const { return offsets_; }
    [[nodiscard]] const Integer* rows() const { return rows_; }

  private:
    static const Integer* view(const std::vector<Index>& own, std::vector<Integer>& copy)
    {
        if constexpr (std::is_same_v<Integer, Index>)
            return own.data();
        copy.assign(own.begin(), own.end());
        return copy.data();
    }

    std::vector<Integer> copied_offsets_;
    std::vector<Integer> copied_rows_;
    const Integer* offsets_;
    const Integer* rows_;
};

[[noreturn]] inline void throw_out_of_memory(const std::string& task)
{
    throw ComputationError("out of memory in the " + task + " of the system: use more sub-meshes");
}

[[noreturn]] inline void throw_singular()
{
    throw ComputationError("the system is singular: use a smaller time step, or another Laplacian");
}

[[noreturn]] inline void throw_failure(const std::string& library, const std::string& task, long status)
{
    throw ComputationError(library + "'s " + task + " failed with status " + std::to_string(status));
}

}  // namespace seamflow
