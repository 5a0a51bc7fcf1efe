#include <cmath>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "partition/errors.h"
#include "samples/meshes/random_numbers.h"
#include "solvers/conditions/adapted_robin.h"
#include "solvers/conditions/dirichlet.h"
#include "solvers/conditions/predicted_side.h"
#include "solvers/conditions/remainder.h"
#include "solvers/systems/general_system.h"
#include "solvers/systems/sub_mesh_system.h"
#include "tests/support/conditions.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/flows.h"
#include "tests/support/heap.h"
#include "tests/support/matrices.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

constexpr double system_time_step = 0.01;
constexpr double system_p = 3.0;

FacesOnBothSides faces_of_sub_mesh(const SubMesh& sub_mesh)
{
    return {sub_mesh.face_vertices, {}, sub_mesh.twin, sub_mesh.n_vertices};
}

/// I + dt Δ written out, with identity rows where a vertex is fixed.
Eigen::MatrixXd backward_euler_matrix(const NamedMesh& m, Laplacian laplacian)
{
    Eigen::MatrixXd A = system_time_step * dense_laplacian(laplacian, m.mesh, m.topology);
    for (Index v = 0; v < m.mesh.n_vertices(); ++v)
        if (m.topology.kind[v] != VertexKind::Interior)
            A.row(v).setZero();
    return A + Eigen::MatrixXd::Identity(A.rows(), A.cols());
}

std::vector<InterfaceRole> random_roles(const SubMesh& sub_mesh, RandomNumbers& random)
{
    std::vector<InterfaceRole> roles(sub_mesh.interface.vertices.size());
    for (InterfaceRole& role : roles)
        role = random.below(2) == 0 ? InterfaceRole::Leads : InterfaceRole::Follows;
    return roles;
}

/// Positions near those of the mesh, for all local vertices.
Points nearby(Points positions, RandomNumbers& random)
{
    for (double& coordinate : positions.reshaped())
        coordinate += 0.01 * random.symmetric();
    return positions;
}

struct NamedCondition {
    const char* name;
    std::unique_ptr<TransmissionCondition> (*make)(const SubMesh& sub_mesh, Laplacian laplacian);
};

/// All that may stand on Γ.
const NamedCondition conditions[] = {
    {"adapted Robin", [](const SubMesh& sub_mesh, Laplacian) { return make_adapted_ventcell(sub_mesh); }},
    {"adapted Ventcell", [](const SubMesh& sub_mesh, Laplacian) { return make_adapted_ventcell(sub_mesh, 0.4); }},
    {"Robin", [](const SubMesh& sub_mesh, Laplacian) { return make_ventcell(sub_mesh); }},
    {"Ventcell", [](const SubMesh& sub_mesh, Laplacian) { return make_ventcell(sub_mesh, 0.4); }},
    {"predicted side",
     [](const SubMesh& sub_mesh, Laplacian laplacian) { return make_predicted_side(sub_mesh, laplacian); }},
};

SystemParts parts_of(const SubMesh& sub_mesh, Laplacian laplacian)
{
    return {sub_mesh, sub_mesh.twin, laplacian};
}

void check_interface_rows(TransmissionCondition& condition, const SubMesh& sub_mesh, const Points& positions,
                          std::span<const InterfaceRole> roles, const Points& given, const Points& solution)
{
    condition.begin_step(positions, positions, system_time_step, system_p);
    for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
        const Index v = sub_mesh.interface.vertices[i];
        if (roles[i] == InterfaceRole::Follows) {
            CHECK(solution.row(v) == given.row(v));
            continue;
        }
        const auto columns = condition.columns()[i];
        std::vector<double> row(columns.size());
        Point residual = -row_of(condition, i, positions, row);
        double largest = 1.0;
        for (std::size_t k = 0; k < row.size(); ++k) {
            residual += row[k] * solution.row(columns[k]);
            largest = std::max(largest, std::abs(row[k]));
        }
        CHECK(residual.norm() < 1e-10 * largest * positions.cwiseAbs().maxCoeff());
    }
}

void check_other_rows(const SubMesh& sub_mesh, Laplacian laplacian, const Points& positions, const Points& solution)
{
    const LaplacianMatrix matrix = laplacian_matrix(laplacian, faces_of_sub_mesh(sub_mesh), positions);
    const Eigen::MatrixXd L = dense(matrix.pattern, matrix.values);
    const Points own = solution.topRows(sub_mesh.n_vertices);
    const Points residual = own + system_time_step * L * own - positions.topRows(sub_mesh.n_vertices);
    std::vector<bool> on_interface(sub_mesh.n_vertices, false);
    for (const Index v : sub_mesh.interface.vertices)
        on_interface[v] = true;
    for (Index v = 0; v < sub_mesh.n_vertices; ++v) {
        if (sub_mesh.fixed[v] == 1)
            CHECK(solution.row(v) == positions.row(v));
        else if (!on_interface[v])
            CHECK(residual.row(v).norm() <
                  1e-9 * (1.0 + system_time_step * L.row(v).norm()) * own.cwiseAbs().maxCoeff());
    }
}

}  // namespace

TEST_CASE("the system of the only sub-mesh is backward Euler on the whole mesh")
{
    SolverWorkspace workspace;
    for (const NamedMesh& m : sound_meshes())
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(m.name);
            CAPTURE(name_of(laplacian));
            const Decomposition whole =
                seamflow::decompose(m.mesh, m.topology, std::vector<Index>(m.mesh.n_faces(), 0), 1);
            const SubMesh& sub_mesh = whole.sub_meshes.front();
            const auto system = make_system(parts_of(sub_mesh, laplacian), make_adapted_ventcell(sub_mesh), workspace);
            const auto equations =
                system->assemble(m.mesh.vertices, m.mesh.vertices, system_time_step, system_p, {}, workspace);
            const auto factor = system->factorise(equations, heap(), workspace);
            Points solution = Points::Zero(m.mesh.n_vertices(), 3);
            system->solve(factor, m.mesh.vertices, solution, workspace);
            const Points expected = backward_euler_matrix(m, laplacian).partialPivLu().solve(m.mesh.vertices);
            CHECK(largest_difference(solution, expected) < 1e-9 * m.mesh.vertices.cwiseAbs().maxCoeff());
            for (Index v = 0; v < m.mesh.n_vertices(); ++v)
                if (m.topology.kind[v] != VertexKind::Interior)
                    CHECK(solution.row(v) == m.mesh.vertices.row(v));
        }
}

TEST_CASE("every row of a sub-mesh's system holds, and what is given comes out to the bit, step after step")
{
    RandomNumbers random(5);
    SolverWorkspace workspace;
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(name_of(laplacian));
            const SubMesh& sub_mesh = decomposition.sub_meshes[random.below(cut.n_parts)];
            for (const NamedCondition& condition : conditions) {
                CAPTURE(condition.name);
                const auto system =
                    make_system(parts_of(sub_mesh, laplacian), condition.make(sub_mesh, laplacian), workspace);
                const auto expected = condition.make(sub_mesh, laplacian);
                for (int step = 0; step < 2; ++step) {
                    const Points positions = nearby(localised(sub_mesh, cut.mesh.vertices), random);
                    const Points given = nearby(positions, random);
                    const auto roles = random_roles(sub_mesh, random);
                    const auto equations =
                        system->assemble(positions, positions, system_time_step, system_p, roles, workspace);
                    const auto factor = system->factorise(equations, heap(), workspace);
                    Points solution = given;
                    system->solve(factor, positions, solution, workspace);
                    check_interface_rows(*expected, sub_mesh, positions, roles, given, solution);
                    check_other_rows(sub_mesh, laplacian, positions, solution);
                    CHECK(solution.bottomRows(sub_mesh.n_halo) == given.bottomRows(sub_mesh.n_halo));
                }
            }
        }
    }
}

TEST_CASE("equations that are not finite are refused, and the system goes on with others")
{
    const PolygonMesh mesh = cut_meshes().front().mesh;
    const Topology topology = make_topology(mesh);
    const Decomposition whole = seamflow::decompose(mesh, topology, std::vector<Index>(mesh.n_faces(), 0), 1);
    SolverWorkspace workspace;
    const SubMesh& sub_mesh = whole.sub_meshes.front();
    const auto system =
        make_system(parts_of(sub_mesh, Laplacian::Fujiwara), make_adapted_ventcell(sub_mesh), workspace);
    const auto factorise = [&](const Points& positions) {
        const auto equations = system->assemble(positions, positions, system_time_step, system_p, {}, workspace);
        static_cast<void>(system->factorise(equations, heap(), workspace));
    };
    Points positions = mesh.vertices;
    positions.row(16) = positions.row(17);
    CHECK_THROWS_AS(factorise(positions), ComputationError);
    CHECK_NOTHROW(factorise(mesh.vertices));
}

TEST_CASE("predicted by a symmetric system or by a general one, the result is the same")
{
    RandomNumbers random(7);
    SolverWorkspace workspace;
    std::vector<CutMesh> cuts = cut_meshes();
    for (CutMesh& cut : cuts) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky})
            for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
                CAPTURE(name_of(laplacian));
                const auto fast = make_predicted_system(parts_of(sub_mesh, laplacian), workspace);
                GeneralSystem general(parts_of(sub_mesh, laplacian), make_predicted_side(sub_mesh, laplacian));
                for (int step = 0; step < 2; ++step) {
                    const Points positions = nearby(localised(sub_mesh, cut.mesh.vertices), random);
                    const Points other_side = nearby(positions, random);
                    const auto roles = random_roles(sub_mesh, random);
                    const auto flow = [&](SubMeshSystem& system) {
                        const auto equations =
                            system.assemble(positions, positions, system_time_step, system_p, roles, workspace);
                        const auto factor = system.factorise(equations, heap(), workspace);
                        Points prediction = positions;
                        system.solve(factor, positions, prediction, workspace);
                        system.use_other_side(positions, other_side);
                        Points solution = other_side;
                        system.solve(factor, positions, solution, workspace);
                        return std::pair{prediction, solution};
                    };
                    const auto [prediction, solution] = flow(*fast);
                    const auto [expected_prediction, expected_solution] = flow(general);
                    const double size = positions.cwiseAbs().maxCoeff();
                    CHECK(largest_difference(prediction, expected_prediction) < 1e-10 * size);
                    CHECK(largest_difference(solution, expected_solution) < 1e-10 * size);
                }
            }
    }
}

TEST_CASE("on the interface the other side responds in all rows where it can, or in none where no definite matrix "
          "would be left")
{
    // Triangles of a grid that is pressed flat and sheared are obtuse.
    RandomNumbers random(9);
    SolverWorkspace workspace;
    int n_without = 0;
    int n_responding = 0;
    for (const double dt : {1.0, 1.0, 1.0, 1000.0, 1000.0, 1000.0}) {
        PolygonMesh mesh = triangle_grid(14, 10);
        for (double& coordinate : mesh.vertices.reshaped())
            coordinate += 0.02 * random.symmetric();
        const CutMesh block = cut_by_place("", mesh, [](const Point& c) {
            return std::abs(c.x() - 7.0) < 4.0 && std::abs(c.y() - 5.0) < 3.0 ? Index{1} : Index{0};
        });
        mesh.vertices.col(1) *= 0.1;
        mesh.vertices.col(0) -= 2.0 * mesh.vertices.col(1);
        const Decomposition decomposition = test::decompose(block);
        const SubMesh& sub_mesh = decomposition.sub_meshes[1];
        const Points positions = localised(sub_mesh, mesh.vertices);
        const auto system = make_predicted_system(parts_of(sub_mesh, Laplacian::AlexaWardetzky), workspace);
        const std::vector<InterfaceRole> roles(sub_mesh.interface.size(), InterfaceRole::Leads);
        const auto equations = system->assemble(positions, positions, dt, system_p, roles, workspace);
        const auto factor = system->factorise(equations, heap(), workspace);
        Points solution = positions;
        system->solve(factor, positions, solution, workspace);

        Points after = mesh.vertices;
        for (Index v = 0; v < sub_mesh.n_vertices; ++v)
            after.row(sub_mesh.local_to_global[v]) = solution.row(v);
        const Eigen::MatrixXd L = dt * dense_laplacian(Laplacian::AlexaWardetzky, mesh, block.topology);
        bool all_held = true;
        bool all_respond = true;
        for (const Index i : sub_mesh.interface.vertices) {
            const Index v = sub_mesh.local_to_global[i];
            const Point held = after.row(v) - mesh.vertices.row(v) + L.row(v) * after;
            double response = 0.0;
            for (Index beyond = sub_mesh.n_vertices; beyond < sub_mesh.n_vertices + sub_mesh.n_halo; ++beyond)
                response += L(v, sub_mesh.local_to_global[beyond]) * remainder_between(positions, i, beyond, dt);
            const Point responding = held + response * (after.row(v) - mesh.vertices.row(v));
            const double small = 1e-9 * (1.0 + L.row(v).norm()) * mesh.vertices.cwiseAbs().maxCoeff();
            CHECK(std::min(held.norm(), responding.norm()) < small);
            all_held = all_held && held.norm() < small;
            all_respond = all_respond && responding.norm() < small;
        }
        n_without += all_held && !all_respond ? 1 : 0;
        n_responding += all_respond && !all_held ? 1 : 0;
    }
    CHECK(n_without > 0);
    CHECK(n_responding > 0);
}

TEST_CASE("following everywhere, a symmetric system and a general one give the same")
{
    RandomNumbers random(8);
    SolverWorkspace workspace;
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky})
            for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
                const Points positions = nearby(localised(sub_mesh, cut.mesh.vertices), random);
                const Points given = nearby(positions, random);
                const std::vector<InterfaceRole> roles(sub_mesh.interface.size(), InterfaceRole::Follows);
                const auto solved = [&](SubMeshSystem& system) {
                    const auto equations =
                        system.assemble(positions, positions, system_time_step, system_p, roles, workspace);
                    const auto factor = system.factorise(equations, heap(), workspace);
                    Points solution = given;
                    system.solve(factor, positions, solution, workspace);
                    return solution;
                };
                const auto following = make_following_system(parts_of(sub_mesh, laplacian), workspace);
                GeneralSystem general(parts_of(sub_mesh, laplacian), make_dirichlet(sub_mesh));
                const Points solution = solved(*following);
                CHECK(largest_difference(solution, solved(general)) < 1e-10 * positions.cwiseAbs().maxCoeff());
                for (const Index v : sub_mesh.interface.vertices)
                    CHECK(solution.row(v) == given.row(v));
            }
    }
}
