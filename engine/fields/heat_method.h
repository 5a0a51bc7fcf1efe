#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "engine/tasks/progress.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/systems/neumann_system.h"

namespace seamflow {

/// (M + dt K) X = M D on a whole mesh with Δ_B (Laplacian::VirtualRefinement), in double precision: X is tiny far from
/// the sources, and yet has correct digits. One factorisation for each dt, which is kept.
class HeatSolver {
  public:
    /// @param topology whose moving vertices have equations.
    HeatSolver(const PolygonMesh& mesh, const Topology& topology, const Executor& exec);

    /// @param data #V: D. @returns #V: X; 0 at vertices without an equation.
    /// @throws ComputationError if the equations are singular to rounding; Cancelled.
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& data, double time_step, const Progress& progress);

  private:
    struct KeptFactor {
        double time_step;
        NeumannSystem::Factor factor;
    };

    Index n_vertices_;
    std::optional<NeumannSystem> system_;
    /// Per local vertex of the system: its number in the mesh, and its position.
    std::vector<Index> vertices_;
    Points positions_ = Points(0, 3);
    SolverWorkspace workspace_;
    std::vector<KeptFactor> factors_;
};

/// The heat method of Crane, Weischedel and Wardetzky (2013) on one component of a surface.
class HeatMethod {
  public:
    /// @param surface in units in which the median edge is about 1. @param faces of the component, ascending.
    HeatMethod(const PolygonMesh& surface, std::span<const Index> faces, const Executor& exec);
    HeatMethod(const HeatMethod&) = delete;
    HeatMethod& operator=(const HeatMethod&) = delete;

    /// The vertices of the component, as numbers in the surface, ascending.
    [[nodiscard]] const std::vector<Index>& vertices() const { return vertices_; }

    /// The distances from the nearest source.
    /// @param from vertices of the surface; only those of the component are sources: at least one.
    /// @returns the distance of each of vertices().
    /// @throws as HeatSolver::solve.
    Eigen::VectorXd distance(std::span<const Index> from, const Progress& progress);

  private:
    /// #V: the logarithm of the heat, where there is any. The heat is the mean, up to a factor, of the heat with an
    /// insulating boundary and of that with a boundary at temperature 0 except at sources, because the effects of the
    /// two boundaries nearly cancel (section 3.4 of Crane and others).
    Eigen::VectorXd logarithm_of_heat(std::span<const Index> from, const Progress& progress);

    std::vector<Index> vertices_;
    PolygonMesh mesh_;
    Topology topology_;
    /// The mean edge length, and the diagonal of the bounding box.
    double edge_;
    double diagonal_;
    /// The equation with an insulating boundary.
    std::optional<HeatSolver> insulated_;
    /// The equation with the boundary at temperature 0, made for the first sources of which none is on the boundary.
    std::optional<HeatSolver> cooled_;
};

}  // namespace seamflow
