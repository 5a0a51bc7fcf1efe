#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/krylov/stopping_criterion.h"
#include "solvers/laplacian/flow_terms.h"
#include "solvers/laplacian/given_stiffness.h"
#include "solvers/laplacian/laplacian.h"
#include "solvers/systems/block_row_matrix.h"
#include "solvers/systems/screening.h"
#include "solvers/systems/whole_mesh_rows.h"

namespace seamflow {

/// The backward Euler step of a whole mesh, (M + dt K)(Vᵏ⁺¹ - Vᵏ) = -dt K Vᵏ, by conjugate gradients: no sub-meshes, no
/// factorisation. The matrix and the vectors of an iteration are in single precision. For tolerances that need it, the
/// residual is recomputed in double precision with entries that are stored beside the matrix, so that rounding limits
/// no tolerance. Three columns are iterated at once. Sums are taken in a fixed order: the bits do not depend on how
/// loops are run. For symmetric Laplacians (K and M are their stiffness and mass matrices). An attachment to V⁰ adds dt
/// M w to the diagonal and dt M w (V⁰ - Vᵏ) to the right-hand side. If terms keep M, all steps have the matrix of V⁰.
/// Arrays are by vertices, as in the mesh, or by rows: in the order of the rows of the matrix, which is another one
/// (see WholeMeshRows).
class WholeMeshSystem {
  public:
    /// @param mesh, topology must outlive the system. Vertices that do not move have no row.
    /// @param terms keeping both M and K, or neither.
    /// @param is_applied_again whether `apply` will be called.
    /// @throws ComputationError if there are 2³¹ coefficients or more (see BlockRowMatrix).
    WholeMeshSystem(const PolygonMesh& mesh, const Topology& topology, const ScaledLaplacian& laplacian,
                    const FlowTerms& terms, const Executor& exec, bool is_applied_again = false);
    WholeMeshSystem(const WholeMeshSystem&) = delete;
    WholeMeshSystem& operator=(const WholeMeshSystem&) = delete;

    /// Uses given K and M in place of those of the Laplacian. To be called before the first step, only where terms keep
    /// M. The given ones must outlive the system.
    void give(const GivenStiffness& given) { given_ = &given; }

    /// How a step ended.
    struct Result : IterationResult {
        /// The estimated largest distance of a vertex to its position in the exact step, in units of length.
        double distance = 0.0;
    };

    /// Takes a step.
    /// @param before #V by 3: Vᵏ. @param time_step dt, in length².
    /// @param stop relative to the residual at Vᵏ⁺¹ = Vᵏ, in the norm of the inverse of the preconditioner.
    /// @param after #V by 3, in other memory than Vᵏ: receives Vᵏ⁺¹; fixed vertices keep their positions.
    /// @param guess #V by 3: iterations begin with it if its residual is smaller than that of Vᵏ; may be null. Not used
    /// in flows that keep M. @throws OptionError for an unsymmetric Laplacian.
    Result step(const Points& before, double time_step, const IterationStop& stop, Points& after, const Executor& exec,
                const Points* guess = nullptr);

    /// Applies the last step to other data, with the same matrix and without the pull to V⁰. Only for systems
    /// constructed with is_applied_again, and while the input of the last step exists.
    /// @param data #V by 3: D, which is 0 where vertices do not move.
    /// @param stop relative to the residual at 0. @param result #V by 3, in other memory than D and Vᵏ.
    Result apply(const Points& data, const IterationStop& stop, Points& result, const Executor& exec);

  private:
    /// Factors that make numbers dimensionless and near 1, to fit in single precision: √dt is the unit of length.
    struct Units {
        double stiffness = 0.0;
        double mass = 0.0;
        double length = 0.0;
    };
    /// Two sums of squares per column, each square divided by the diagonal entry: of the rounding errors of the
    /// residual, and of the residual.
    struct Sizes {
        Eigen::Array4d rounding;
        Eigen::Array4d residual;
    };
    /// The beginning of a pass: iterations in single precision from one residual on.
    struct PassStart {
        /// The scale of residual and increment in the pass.
        double scale = 1.0;
        /// Per column, the squared norm of the scaled residual, in the norm of the inverse of the preconditioner.
        Eigen::Array4d squared = Eigen::Array4d::Zero();
        /// The norm of the residual over all columns, in the same norm.
        double norm = 0.0;
    };

    /// The input of `solve`.
    struct Beginning {
        /// The squared norm of the residual: the sum of its squares, each divided by the diagonal entry.
        double squared;
        /// V, by rows.
        const Points& of_rows;
        /// By rows: V, or the data that the step is applied to.
        const Points& data;
        /// By vertices: Vᵏ of a step, in which an attachment pulls to V⁰. Null if the step is applied to other data.
        const Points* before;
        /// Whether iterations begin with the solution in after_, by rows; if not, they begin with V.
        bool is_in_rows;
        /// Iterations begin with the guess instead if its residual is smaller; may be null.
        const Points* guess = nullptr;
    };

    void list_by_rows(const Points& by_vertices, Points& by_rows, const Executor& exec) const;
    void take_units(double time_step);
    Sizes assemble(const Points& of_rows, const Executor& exec);
    void keep_exact();
    double measure(const Points& of_rows, const Points& data, bool is_pulled, const Executor& exec);
    Result step_with_kept_matrix(const Points& before, const IterationStop& stop, Points& after, const Executor& exec);
    Result solve(const Beginning& beginning, const IterationStop& stop, Points& after, const Executor& exec);
    /// dt w s in row i, s being the step scale.
    [[nodiscard]] double screening(Index i) const { return time_step_ * screening_.weight(i); }
    PassStart start_pass(double squared, const Executor& exec);
    [[nodiscard]] double farthest_move(const Executor& exec) const;
    void write_without_row(const Points* before, Points& after, const Executor& exec) const;
    static double estimate_distance_after(const BlockRowMatrix::Result& pass, double length, double before_pass,
                                          double left, double distance_before);

    const PolygonMesh* mesh_;
    const Topology* topology_;
    ScaledLaplacian laplacian_;
    /// The given K and M; null: those of the Laplacian.
    const GivenStiffness* given_ = nullptr;
    /// The units of the present step.
    Units units_;
    double time_step_ = 0.0;
    WholeMeshRows rows_;
    BlockRowMatrix matrix_;
    /// The V of the last step.
    const Points* before_ = nullptr;
    /// By rows: whether the vertex moves; and its position after the step so far, if the residual is recomputed.
    std::vector<std::uint8_t> moves_;
    Points after_ = Points(0, 3);
    /// The attachment, by rows.
    Screening screening_;
    /// By rows: M in the unit of the matrix. Only for `apply`, and to recompute residuals.
    std::vector<double> masses_;
    /// By rows: D. For `apply`; with a kept matrix, D is Vᵏ.
    Points data_ = Points(0, 3);
    /// For a kept matrix: whether all steps have the same matrix; V⁰, by vertices and by rows; and whether the matrix
    /// for the time step exists.
    bool keeps_matrix_ = false;
    bool has_matrix_ = false;
    Points kept_ = Points(0, 3);
    Points kept_of_rows_ = Points(0, 3);
};

}  // namespace seamflow
