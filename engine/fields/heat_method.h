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

/// (M + dt K) X = M D on a whole mesh with Δ_B, in double precision: far from all heat X is tiny, and yet has correct
/// digits. One factorisation for each dt, which is kept.
class HeatEquation {
  public:
    /// @param topology with the vertices that have equations.
    HeatEquation(const PolygonMesh& mesh, const Topology& topology, const Executor& exec);

    /// @param data #V: D. @returns #V: X; 0 where there is no equation.
    /// @throws ComputationError where the equations are singular to rounding; Cancelled.
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& data, double time_step, const Progress& progress);

  private:
    struct KeptFactor {
        double time_step;
        NeumannSystem::Factor factor;
    };

    Index n_vertices_;
    std::optional<NeumannSystem> system_;
    std::vector<Index> vertices_;
    Points positions_ = Points(0, 3);
    SolverWorkspace workspace_;
    std::vector<KeptFactor> factors_;
};

/// The heat method of Crane, Weischedel and Wardetzky (2013) on the part of a surface that faces connect.
class HeatMethod {
  public:
    /// @param surface near whose median edge 1 is the unit of length. @param faces those of the part, ascending.
    HeatMethod(const PolygonMesh& surface, std::span<const Index> faces, const Executor& exec);
    HeatMethod(const HeatMethod&) = delete;
    HeatMethod& operator=(const HeatMethod&) = delete;

    /// Those of the surface, ascending.
    [[nodiscard]] const std::vector<Index>& vertices() const { return vertices_; }

    /// @param from vertices of the surface, of which those of the part count: one at least.
    /// @returns the distance of each of vertices().
    /// @throws as HeatEquation::solve.
    Eigen::VectorXd distance(std::span<const Index> from, const Progress& progress);

  private:
    /// The logarithm of the heat, where there is any: of the mean of those with a boundary that lets none through and
    /// with one that takes all except at sources, which leaves the least of the boundary's own effect (section 3.4
    /// there).
    Eigen::VectorXd logarithm_of_heat(std::span<const Index> from, const Progress& progress);

    std::vector<Index> vertices_;
    PolygonMesh mesh_;
    Topology topology_;
    double edge_;
    double diagonal_;
    std::optional<HeatEquation> insulated_;
    /// Made for the first sources of which none is on the boundary.
    std::optional<HeatEquation> cooled_;
};

}  // namespace seamflow
