#include <cmath>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "partition/errors.h"
#include "samples/common/meshes/random_numbers.h"
#include "solvers/conditions/adapted_robin.h"
#include "solvers/sub_mesh_system.h"
#include "tests/support/conditions.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/flows.h"
#include "tests/support/matrices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

constexpr double time_step = 0.01;
constexpr double p = 3.0;

FaceView faces_of_sub_mesh(const SubMesh& sub_mesh)
{
    return {sub_mesh.face_vertices.offsets, sub_mesh.face_vertices.values, sub_mesh.twin, sub_mesh.n_vertices};
}

/// I + dt Δ written out, with identity rows where a vertex is fixed.
Eigen::MatrixXd backward_euler_matrix(const NamedMesh& m, Laplacian laplacian)
{
    Eigen::MatrixXd A = time_step * dense_laplacian(laplacian, m.mesh, m.topology);
    for (Index v = 0; v < m.mesh.n_vertices(); ++v)
        if (m.topology.kind[at(v)] != VertexKind::Interior)
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

void check_interface_rows(const SubMesh& sub_mesh, const Points& positions, std::span<const InterfaceRole> roles,
                          const Points& given, const Points& solution)
{
    AdaptedRobin condition(sub_mesh);
    condition.begin_step(positions, positions, time_step, p);
    for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
        const Index v = sub_mesh.interface.vertices[at(i)];
        if (roles[at(i)] == InterfaceRole::Follows) {
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
    const Points residual = own + time_step * L * own - positions.topRows(sub_mesh.n_vertices);
    std::vector<bool> on_interface(at(sub_mesh.n_vertices), false);
    for (const Index v : sub_mesh.interface.vertices)
        on_interface[at(v)] = true;
    for (Index v = 0; v < sub_mesh.n_vertices; ++v) {
        if (sub_mesh.fixed[at(v)] == 1)
            CHECK(solution.row(v) == positions.row(v));
        else if (!on_interface[at(v)])
            CHECK(residual.row(v).norm() < 1e-9 * (1.0 + time_step * L.row(v).norm()) * own.cwiseAbs().maxCoeff());
    }
}

}  // namespace

TEST_CASE("the system of the only sub-mesh is backward Euler on the whole mesh")
{
    for (const NamedMesh& m : sound_meshes())
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(m.name);
            CAPTURE(name_of(laplacian));
            const Decomposition whole =
                seamflow::decompose(m.mesh, m.topology, std::vector<Index>(at(m.mesh.n_faces()), 0), 1);
            SubMeshSystem system(whole.sub_meshes.front(), laplacian, make_adapted_robin(whole.sub_meshes.front()));
            system.assemble(m.mesh.vertices, m.mesh.vertices, time_step, p, {});
            system.factorise();
            Points solution = Points::Zero(m.mesh.n_vertices(), 3);
            system.solve(solution);
            const Points expected = backward_euler_matrix(m, laplacian).partialPivLu().solve(m.mesh.vertices);
            CHECK(largest_difference(solution, expected) < 1e-9 * m.mesh.vertices.cwiseAbs().maxCoeff());
            for (Index v = 0; v < m.mesh.n_vertices(); ++v)
                if (m.topology.kind[at(v)] != VertexKind::Interior)
                    CHECK(solution.row(v) == m.mesh.vertices.row(v));
        }
}

TEST_CASE("every row of a sub-mesh's system holds, and what is given comes out to the bit, step after step")
{
    RandomNumbers random(5);
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(name_of(laplacian));
            const SubMesh& sub_mesh = decomposition.sub_meshes[at(random.below(cut.n_parts))];
            SubMeshSystem system(sub_mesh, laplacian, make_adapted_robin(sub_mesh));
            for (int step = 0; step < 2; ++step) {
                const Points positions = nearby(localised(sub_mesh, cut.mesh.vertices), random);
                const Points given = nearby(positions, random);
                const auto roles = random_roles(sub_mesh, random);
                system.assemble(positions, positions, time_step, p, roles);
                system.factorise();
                Points solution = given;
                system.solve(solution);
                check_interface_rows(sub_mesh, positions, roles, given, solution);
                check_other_rows(sub_mesh, laplacian, positions, solution);
                CHECK(solution.bottomRows(sub_mesh.n_halo) == given.bottomRows(sub_mesh.n_halo));
            }
        }
    }
}

TEST_CASE("the pattern covers every role, so that it does not depend on them")
{
    const CutMesh& cut = cut_meshes().front();
    const Decomposition decomposition = test::decompose(cut);
    const SubMesh& sub_mesh = decomposition.sub_meshes.front();
    SubMeshSystem system(sub_mesh, Laplacian::Fujiwara, make_adapted_robin(sub_mesh));
    const Index n_entries = system.n_entries();
    CHECK(n_entries > sub_mesh.n_vertices);
    const Points positions = localised(sub_mesh, cut.mesh.vertices);
    for (const InterfaceRole role : {InterfaceRole::Leads, InterfaceRole::Follows}) {
        system.assemble(positions, positions, time_step, p,
                        std::vector<InterfaceRole>(sub_mesh.interface.vertices.size(), role));
        CHECK(system.n_entries() == n_entries);
        CHECK_NOTHROW(system.factorise());
    }
}

TEST_CASE("equations that are not finite are refused, and the system goes on with others")
{
    const PolygonMesh mesh = cut_meshes().front().mesh;
    const Topology topology = make_topology(mesh);
    const Decomposition whole = seamflow::decompose(mesh, topology, std::vector<Index>(at(mesh.n_faces()), 0), 1);
    SubMeshSystem system(whole.sub_meshes.front(), Laplacian::Fujiwara, make_adapted_robin(whole.sub_meshes.front()));
    Points positions = mesh.vertices;
    positions.row(16) = positions.row(17);
    system.assemble(positions, positions, time_step, p, {});
    CHECK_THROWS_AS(system.factorise(), ComputationError);
    system.assemble(mesh.vertices, mesh.vertices, time_step, p, {});
    CHECK_NOTHROW(system.factorise());
}
