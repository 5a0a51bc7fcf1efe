#include "tests/support/undecomposed_step.h"

#include <limits>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "engine/constraints.h"
#include "engine/near_origin.h"
#include "engine/repeated_faces_left_out.h"
#include "tests/support/matrices.h"

namespace seamflow::test {

namespace {

constexpr Eigen::Index most_unknowns = 150;

/// I + dt Δ with the rows and columns of the vertices that move, and what the others contribute.
struct Equations {
    Eigen::MatrixXd A;
    Eigen::MatrixXd right_hand_side;
};

Equations equations_of(const Eigen::MatrixXd& laplacian, double time_step, const std::vector<Index>& moving,
                       const std::vector<Index>& fixed, const Points& from)
{
    const Eigen::MatrixXd rows = time_step * laplacian(moving, Eigen::all);
    Equations equations;
    equations.A = rows(Eigen::all, moving);
    equations.A.diagonal().array() += 1.0;
    equations.right_hand_side = Eigen::MatrixXd(from(moving, Eigen::all));
    if (!fixed.empty())
        equations.right_hand_side -= rows(Eigen::all, fixed) * Eigen::MatrixXd(from(fixed, Eigen::all));
    return equations;
}

}  // namespace

std::optional<UndecomposedStep> undecomposed_step(const PolygonMesh& mesh, const FlowOptions& options,
                                                  const Points& from)
{
    const Point offset = offset_of(mesh.vertices);
    PolygonMesh near = mesh;
    near.vertices.rowwise() -= offset;
    FlowOptions constraints = options;
    std::vector<std::string> remarks;
    Topology topology = make_constrained_topology(near, constraints, run_serially, remarks);
    const RepeatedFacesLeftOut left_out(near, topology, constraints);
    topology = make_constrained_topology(near, constraints, run_serially, remarks);
    near.vertices = from.rowwise() - offset;

    std::vector<Index> moving;
    std::vector<Index> fixed;
    for (Index v = 0; v < near.n_vertices(); ++v)
        (topology.moves(v) ? moving : fixed).push_back(v);
    if (moving.size() > most_unknowns)
        return {};
    UndecomposedStep step{.positions = from};
    if (moving.empty())
        return step;
    const auto [A, right_hand_side] = equations_of(dense_laplacian(options.laplacian, near, topology),
                                                   options.time_step, moving, fixed, near.vertices);
    if (!A.allFinite())
        return {};
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(A);
    const Eigen::MatrixXd inverse = factors.inverse();
    const Eigen::MatrixXd solution = factors.solve(right_hand_side);
    step.condition = A.cwiseAbs().rowwise().sum().maxCoeff() * inverse.cwiseAbs().rowwise().sum().maxCoeff();
    if (!(step.condition < 1e13) || !solution.allFinite())
        return {};
    const double epsilon = std::numeric_limits<double>::epsilon();
    const Eigen::MatrixXd terms = A.cwiseAbs() * solution.cwiseAbs() + right_hand_side.cwiseAbs();
    step.rounding = 10.0 * static_cast<double>(moving.size()) * epsilon * (inverse.cwiseAbs() * terms).maxCoeff() +
                    4.0 * epsilon * from.cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < moving.size(); ++i)
        step.positions.row(moving[i]) = Point(solution.row(static_cast<Eigen::Index>(i))) + offset;
    return step;
}

}  // namespace seamflow::test
