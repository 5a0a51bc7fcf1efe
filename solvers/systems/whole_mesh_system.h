#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "partition/loop.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/krylov/stopping_criterion.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// The backward Euler step of a whole mesh, (M + dt K)(Vᵏ⁺¹ - Vᵏ) = -dt K Vᵏ, by conjugate gradients: no sub-meshes, no
/// factorisation. The matrix and the vectors of an iteration are in single precision; the residual is measured anew in
/// double precision, from the geometry, so that rounding limits no tolerance. Three columns are iterated at once. Sums
/// are taken in a fixed order: the bits do not depend on how loops are run. For symmetric Laplacians.
class WholeMeshSystem {
  public:
    /// @param mesh, topology must outlive the system. Vertices that do not move have no row.
    /// @throws ComputationError if there are 2³¹ coefficients or more; OptionError for a Laplacian without symmetry.
    WholeMeshSystem(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian, const Loop& loop);
    WholeMeshSystem(const WholeMeshSystem&) = delete;
    WholeMeshSystem& operator=(const WholeMeshSystem&) = delete;

    /// How a step ended.
    struct Result : IterationResult {
        /// Estimated largest distance of a vertex from where the exact step has it, in units of length.
        double distance = 0.0;
    };

    /// Takes a step.
    /// @param before #V by 3: Vᵏ. @param time_step dt, in length².
    /// @param stop relative to the residual of Vᵏ⁺¹ = Vᵏ, in the norm of the inverse of the diagonal.
    /// @param after #V by 3: receives Vᵏ⁺¹; what does not move stays.
    Result step(const Points& before, double time_step, const IterationStop& stop, Points& after, const Loop& loop);

  private:
    /// Three columns, and one that is zero, so that a row is a register.
    using Row = Eigen::Array4f;
    using Rows = std::vector<Row>;
    /// Of the iteration: the residual, the direction, its product with the matrix, the solution.
    struct Iterates {
        Rows residual;
        Rows direction;
        Rows product;
        Rows increment;
    };
    /// Factors that make numbers without dimension, near 1, which single precision can hold: √dt is the unit of length.
    struct Units {
        double stiffness = 0.0;
        double mass = 0.0;
        double length = 0.0;
    };
    /// Iterations in single precision from one residual.
    struct Pass : IterationResult {
        /// The largest distance that the last one moved a vertex.
        double last_update = 0.0;
        /// What residual and increment are multiplied by.
        double scale = 1.0;
    };

    Eigen::Array4d assemble(const Points& before, const Loop& loop);
    void measure(const Points& before, const Points& after, const Loop& loop);
    [[nodiscard]] Eigen::Array4d squared_residual(const Loop& loop) const;
    Eigen::Array4d multiply(const Loop& loop);
    static double distance_after(const Pass& pass);
    Pass iterate(double goal, int most_iterations, const Loop& loop);

    const PolygonMesh* mesh_;
    const Topology* topology_;
    Laplacian laplacian_;
    /// That of this step.
    Units units_;
    /// The matrix by rows, without its diagonal, which stands apart.
    std::vector<Index> offsets_;
    std::vector<Index> columns_;
    std::vector<float> values_;
    std::vector<float> diagonal_;
    Iterates iterates_;
};

}  // namespace seamflow
