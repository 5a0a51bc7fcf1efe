#include "tests/support/undecomposed_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "engine/setup/automatic_choices.h"
#include "engine/surface/constraints.h"
#include "engine/surface/flowing_mesh.h"
#include "engine/surface/origin_offset.h"
#include "tests/support/matrices.h"

namespace seamflow::test {

namespace {

constexpr Eigen::Index most_unknowns = 150;

/// Who moves and who does not.
struct Vertices {
    std::vector<Index> moving;
    std::vector<Index> fixed;
};

/// I + dt Δ, the rows and columns of the vertices that move, and what the others contribute; the largest coefficient of
/// each row is 1.
struct Equations {
    Eigen::MatrixXd matrix;
    Eigen::MatrixXd right_hand_side;
};

Equations equations_of(const Eigen::MatrixXd& laplacian, double time_step, const Vertices& vertices, const Points& from)
{
    const auto& [moving, fixed] = vertices;
    const Eigen::MatrixXd rows = time_step * laplacian(moving, Eigen::all);
    Equations equations{rows(Eigen::all, moving), from(moving, Eigen::all)};
    equations.matrix.diagonal().array() += 1.0;
    if (!fixed.empty())
        equations.right_hand_side -= rows(Eigen::all, fixed) * Eigen::MatrixXd(from(fixed, Eigen::all));
    const Eigen::VectorXd largest = equations.matrix.cwiseAbs().rowwise().maxCoeff();
    equations.matrix.array().colwise() /= largest.array();
    equations.right_hand_side.array().colwise() /= largest.array();
    return equations;
}

/// @param mesh at the positions before the step.
Points solve(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options, const Vertices& vertices,
             double* condition)
{
    const auto [matrix, right_hand_side] =
        equations_of(dense_laplacian(options.laplacian, mesh, topology), options.time_step, vertices, mesh.vertices);
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(matrix);
    Eigen::MatrixXd solution = factors.solve(right_hand_side);
    solution += factors.solve(right_hand_side - matrix * solution);
    if (condition != nullptr)
        *condition =
            matrix.cwiseAbs().rowwise().sum().maxCoeff() * factors.inverse().cwiseAbs().rowwise().sum().maxCoeff();
    Points positions = mesh.vertices;
    for (std::size_t i = 0; i < vertices.moving.size(); ++i)
        positions.row(vertices.moving[i]) = solution.row(static_cast<Eigen::Index>(i));
    return positions;
}

}  // namespace

std::optional<UndecomposedStep> undecomposed_step(const PolygonMesh& mesh, const FlowOptions& options,
                                                  const Points& from)
{
    const Point offset = origin_offset(mesh);
    PolygonMesh given = mesh;
    FlowingMesh flowing(given);
    std::vector<Remark> remarks;
    Topology topology = make_topology(flowing.mesh());
    FlowOptions of_joined = options;
    if (!need_of_junctions(options).empty())
        of_joined.motion.junctions = Junctions::Hold;
    flowing.weld_seams(topology, of_joined.motion, run_serially);
    constrain(topology, flowing.mesh(), of_joined.motion, of_joined.laplacian, false, run_serially, remarks);
    if (!options.report.keep_gaps && flowing.leave_out_repeated_faces(topology)) {
        topology = make_topology(flowing.mesh());
        constrain(topology, flowing.mesh(), of_joined.motion, of_joined.laplacian, false, run_serially, remarks);
    }
    PolygonMesh near = flowing.mesh();
    near.vertices = from.rowwise() - offset;

    Vertices vertices;
    for (Index v = 0; v < near.n_vertices(); ++v)
        (topology.moves(v) ? vertices.moving : vertices.fixed).push_back(v);
    if (vertices.moving.size() > most_unknowns)
        return {};
    UndecomposedStep step{.positions = from};
    if (vertices.moving.empty())
        return step;
    Points positions = solve(near, topology, options, vertices, &step.condition);
    flowing.take_along(positions);
    step.rounding = 1e-12 * from.cwiseAbs().maxCoeff();
    RandomNumbers random(1);
    for (int i = 0; i < 3; ++i) {
        PolygonMesh other = near;
        perturb(other.vertices, random);
        Points perturbed = solve(other, topology, options, vertices, nullptr);
        flowing.take_along(perturbed);
        step.rounding = std::max(step.rounding, 100.0 * (perturbed - positions).cwiseAbs().maxCoeff());
    }
    if (!(step.condition < 1e13) || !std::isfinite(step.rounding))
        return {};
    step.positions = positions.rowwise() + offset;
    return step;
}

void perturb(Points& positions, RandomNumbers& random)
{
    for (double& coordinate : positions.reshaped())
        coordinate *= 1.0 + 4.0 * std::numeric_limits<double>::epsilon() * random.symmetric();
}

}  // namespace seamflow::test
