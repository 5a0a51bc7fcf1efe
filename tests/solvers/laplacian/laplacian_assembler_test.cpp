#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>

#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/matrices.h"
#include "tests/support/reference_data.h"
#include "tests/support/relative.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

std::map<Index, Row> rows_of(const LaplacianMatrix& matrix)
{
    std::map<Index, Row> rows;
    for (Index column = 0; column < matrix.pattern.n(); ++column)
        for (Index i = matrix.pattern.column_offsets[column]; i < matrix.pattern.column_offsets[column + 1]; ++i)
            rows[matrix.pattern.rows[i]][column] = matrix.values[i];
    return rows;
}

double largest(const Eigen::MatrixXd& matrix)
{
    return matrix.cwiseAbs().maxCoeff();
}

/// M_v of all vertices.
Eigen::VectorXd masses(Laplacian laplacian, const NamedMesh& m)
{
    const auto assembler = make_assembler(laplacian, faces_of(m.mesh, m.topology));
    double unread = 0.0;
    assembler->add(m.mesh.vertices, 1.0, std::vector<Index>(assembler->entries().size(), 0), {&unread, 1});
    Eigen::VectorXd masses(m.mesh.n_vertices());
    for (Index v = 0; v < m.mesh.n_vertices(); ++v)
        masses(v) = assembler->mass(v);
    return masses;
}

double area_of(const PolygonMesh& mesh)
{
    double sum = 0.0;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        sum += area(mesh.face(f), mesh.vertices);
    return sum;
}

/// Length of the edges at each vertex over their number, edges on the boundary counted half.
Eigen::VectorXd mean_lengths(const NamedMesh& m)
{
    Eigen::VectorXd length = Eigen::VectorXd::Zero(m.mesh.n_vertices());
    Eigen::VectorXd count = length;
    for (Index h = 0; h < m.mesh.n_corners(); ++h) {
        const Index start = m.mesh.face_vertices[h];
        const Index end = m.mesh.face_vertices[m.topology.next(m.mesh, h)];
        for (const Index v : {start, end}) {
            length(v) += (m.mesh.vertices.row(end) - m.mesh.vertices.row(start)).norm();
            count(v) += 1.0;
        }
    }
    return length.cwiseQuotient(count);
}

/// The cotan Laplacian of a triangle mesh, each row divided by a third of the area of the triangles at the vertex.
Eigen::MatrixXd cotan_laplacian(const PolygonMesh& mesh)
{
    Eigen::MatrixXd L = Eigen::MatrixXd::Zero(mesh.n_vertices(), mesh.n_vertices());
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(mesh.n_vertices());
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const Index apex = mesh.face(f)[k];
            const Index i = mesh.face(f)[(k + 1) % 3];
            const Index j = mesh.face(f)[(k + 2) % 3];
            const Point to_i = mesh.vertices.row(i) - mesh.vertices.row(apex);
            const Point to_j = mesh.vertices.row(j) - mesh.vertices.row(apex);
            const double twice_area = to_i.cross(to_j).norm();
            const double weight = 0.5 * to_i.dot(to_j) / twice_area;
            L(i, i) += weight;
            L(j, j) += weight;
            L(i, j) -= weight;
            L(j, i) -= weight;
            mass(apex) += twice_area / 6.0;
        }
    return mass.cwiseInverse().asDiagonal() * L;
}

/// Largest length of Δ applied to the positions at interior vertices.
double applied_to_linear_functions(Laplacian laplacian, const PolygonMesh& mesh)
{
    const Topology topology = make_topology(mesh);
    const Points result = dense_laplacian(laplacian, mesh, topology) * mesh.vertices;
    double most = 0.0;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (topology.kind[v] == VertexKind::Interior)
            most = std::max(most, result.row(v).norm());
    return most;
}

PolygonMesh flat(PolygonMesh mesh)
{
    mesh.vertices.col(2).setZero();
    return mesh;
}

/// A flat sheet of hexagons of equal sides and angles.
PolygonMesh regular_hexagons(Index m, Index n)
{
    PolygonMesh mesh = hexagon_sheet(m, n);
    for (double& y : mesh.vertices.col(1)) {
        const double row = std::round(y);
        y = std::sqrt(3.0) * row + std::copysign(std::sqrt(1.0 / 12.0), y - row);
    }
    return mesh;
}

}  // namespace

TEST_CASE("the Laplacians are those of the paper's authors, boundary rows included")
{
    const auto files = reference_files("operators");
    REQUIRE(files.size() == 4);
    for (const auto& file : files) {
        const ReferenceOperators reference = read_operators(file);
        const Topology topology = make_topology(reference.mesh);
        REQUIRE(reference.laplacian.size() == 3);
        for (const auto& of_laplacian : reference.laplacian) {
            const Laplacian laplacian = of_laplacian.first;
            CAPTURE(file.filename().string());
            CAPTURE(name_of(laplacian));
            auto rows =
                rows_of(laplacian_matrix(laplacian, faces_of(reference.mesh, topology), reference.mesh.vertices));
            const auto& expected_rows = of_laplacian.second;
            for (Index v = 0; v < reference.mesh.n_vertices(); ++v) {
                const Row& expected = expected_rows.at(v);
                double largest = 0.0;
                for (const auto& [column, value] : expected)
                    largest = std::max(largest, std::abs(value));
                for (const auto& [column, value] : expected)
                    CHECK(std::abs(rows[v][column] - value) <= 1e-10 * largest);
                for (const auto& entry : rows[v])
                    CHECK(expected.contains(entry.first));
            }
        }
    }
}

TEST_CASE("virtual refinement has the stiffness and the mass of the reference")
{
    const auto files = reference_files("stiffness");
    REQUIRE(files.size() == 4);
    for (const auto& file : files) {
        CAPTURE(file.filename().string());
        const ReferenceStiffness reference = read_stiffness(file);
        const NamedMesh m = named("", reference.mesh);
        const Eigen::VectorXd mass = masses(Laplacian::VirtualRefinement, m);
        const Eigen::VectorXd expected_mass =
            Eigen::VectorXd::Map(reference.mass.data(), static_cast<Eigen::Index>(reference.mass.size()));
        CHECK((mass - expected_mass).cwiseAbs().maxCoeff() <= 1e-13 * expected_mass.maxCoeff());
        Eigen::MatrixXd difference =
            mass.asDiagonal() * dense_laplacian(Laplacian::VirtualRefinement, m.mesh, m.topology);
        const double size = largest(difference);
        for (const auto& [v, row] : reference.stiffness)
            for (const auto& [column, value] : row)
                difference(v, column) -= value;
        CHECK(largest(difference) <= 1e-11 * size);
    }
}

TEST_CASE("with virtual refinement constants alone have no energy, where Alexa-Wardetzky knows others without")
{
    const NamedMesh m = named("", quad_torus(8, 6));
    const auto energies = [&](Laplacian laplacian) {
        const Eigen::MatrixXd stiffness =
            masses(laplacian, m).asDiagonal() * dense_laplacian(laplacian, m.mesh, m.topology);
        const Eigen::VectorXd values =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (stiffness + stiffness.transpose())).eigenvalues();
        return Eigen::VectorXd(values / values.maxCoeff());
    };
    CHECK(std::abs(energies(Laplacian::VirtualRefinement)(0)) < 1e-12);
    CHECK(energies(Laplacian::VirtualRefinement)(1) > 0.01);
    CHECK(energies(Laplacian::AlexaWardetzky)(1) < 0.5 * energies(Laplacian::VirtualRefinement)(1));
}

TEST_CASE("virtual refinement is finite, symmetric and semi-definite whatever a polygon looks like")
{
    // Around (0, 0), counter-clockwise, with an area each.
    const std::vector<std::vector<Point>> polygons{
        {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}},                        // a corner twice
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}},                        // a straight corner
        {{0, 0, 0}, {1, 0, 0}, {1, 1e-9, 0}, {0, 1e-9, 0}},                  // hardly any width
        {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 1, 0}},                        // a corner that points inward
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-9}, {0, 1, 0}, {-1, 0.5, 2e-9}},    // hardly any height
        {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {0, 1, 0}},  // an L
        {{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}},                        // a saddle
    };
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        CAPTURE(i);
        PolygonMesh mesh;
        mesh.vertices.resize(static_cast<Eigen::Index>(polygons[i].size()), 3);
        std::vector<Index> corners;
        for (const Point& point : polygons[i]) {
            mesh.vertices.row(static_cast<Eigen::Index>(corners.size())) = point;
            corners.push_back(static_cast<Index>(corners.size()));
        }
        mesh.add_face(corners);
        const NamedMesh m = named("", mesh);
        const Eigen::MatrixXd stiffness = masses(Laplacian::VirtualRefinement, m).asDiagonal() *
                                          dense_laplacian(Laplacian::VirtualRefinement, m.mesh, m.topology);
        REQUIRE(stiffness.allFinite());
        CHECK(largest(stiffness - stiffness.transpose()) <= 1e-12 * largest(stiffness));
        CHECK(stiffness.rowwise().sum().cwiseAbs().maxCoeff() <= 1e-12 * largest(stiffness));
        CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (stiffness + stiffness.transpose()))
                  .eigenvalues()
                  .minCoeff() >= -1e-12 * largest(stiffness));
    }
}

TEST_CASE("constants are in the kernel: rows sum to zero")
{
    for (const NamedMesh& m : sound_meshes())
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(m.name);
            CAPTURE(name_of(laplacian));
            const Eigen::MatrixXd L = dense_laplacian(laplacian, m.mesh, m.topology);
            CHECK(L.rowwise().sum().cwiseAbs().maxCoeff() <= 1e-11 * largest(L));
        }
}

TEST_CASE("linear functions are in the kernel on flat regular meshes")
{
    for (const PolygonMesh& mesh : {quad_grid(6, 5), triangle_grid(6, 5), regular_hexagons(6, 5)})
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(name_of(laplacian));
            CHECK(applied_to_linear_functions(laplacian, mesh) < 1e-13);
        }
}

TEST_CASE("with areas linear functions are in the kernel on any flat mesh")
{
    for (const PolygonMesh& mesh : {make_hexagons(150), make_triangles(150), make_mixed_polygons(150)})
        for (const Laplacian laplacian : {Laplacian::AlexaWardetzky, Laplacian::PtackovaVelho}) {
            CAPTURE(name_of(laplacian));
            CHECK(applied_to_linear_functions(laplacian, flat(mesh)) < 1e-10);
        }
    // Where the virtual vertex sees the whole polygon.
    for (const PolygonMesh& mesh : {make_hexagons(150), make_triangles(150), make_quads(150)})
        CHECK(applied_to_linear_functions(Laplacian::VirtualRefinement, flat(mesh)) < 1e-10);
}

TEST_CASE("the areas of the vertices sum to the area of the mesh")
{
    for (const Laplacian laplacian :
         {Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement, Laplacian::PtackovaVelho}) {
        CAPTURE(name_of(laplacian));
        for (const NamedMesh& m : sound_meshes()) {
            CAPTURE(m.name);
            const Eigen::VectorXd areas = masses(laplacian, m);
            CHECK(areas.sum() == relative(area_of(m.mesh), 1e-13));
            CHECK(areas.minCoeff() > 0.0);
        }
        CHECK(masses(laplacian, named("", quad_grid(5, 4))).sum() == relative(20.0, 1e-5));
        CHECK(masses(laplacian, named("", flat(make_mixed_polygons(150)))).sum() == relative(1.0, 1e-5));
    }
}

TEST_CASE("the mass of Fujiwara is the mean length of the edges")
{
    for (const NamedMesh& m : sound_meshes()) {
        CAPTURE(m.name);
        const Eigen::VectorXd lengths = mean_lengths(m);
        CHECK((masses(Laplacian::Fujiwara, m) - lengths).norm() < 1e-14 * lengths.norm());
    }
}

TEST_CASE("on triangles Alexa-Wardetzky and virtual refinement are the cotan Laplacian with barycentric mass")
{
    for (const PolygonMesh& mesh : {make_triangles(120), make_noisy_sphere(150), triangle_torus(9, 7)})
        for (const Laplacian laplacian : {Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement}) {
            const Eigen::MatrixXd L = dense_laplacian(laplacian, mesh, make_topology(mesh));
            CHECK(largest(L - cotan_laplacian(mesh)) < 1e-12 * largest(L));
        }
}

TEST_CASE("M times a symmetric Laplacian is symmetric and semi-definite")
{
    for (const NamedMesh& m : sound_meshes())
        for (const Laplacian laplacian : symmetric_laplacians) {
            CAPTURE(m.name);
            CAPTURE(name_of(laplacian));
            const Eigen::MatrixXd L =
                masses(laplacian, m).asDiagonal() * dense_laplacian(laplacian, m.mesh, m.topology);
            CHECK(largest(L - L.transpose()) < 1e-13 * largest(L));
            const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (L + L.transpose()),
                                                                       Eigen::EigenvaluesOnly);
            CHECK(eigen.eigenvalues().minCoeff() > -1e-12 * eigen.eigenvalues().maxCoeff());
        }
}

TEST_CASE("an offset of the whole mesh costs no precision beyond that of the positions")
{
    for (const NamedMesh& m : sound_meshes())
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(m.name);
            CAPTURE(name_of(laplacian));
            const Eigen::RowVector3d offset(0x1p+20, -0x1p+20, 0x1p+19);
            PolygonMesh far = m.mesh;
            far.vertices.rowwise() += offset;
            // The same rounding of the positions near the origin.
            PolygonMesh near = far;
            near.vertices.rowwise() -= offset;
            const Eigen::MatrixXd L = dense_laplacian(laplacian, near, m.topology);
            CHECK(largest(dense_laplacian(laplacian, far, m.topology) - L) < 1e-12 * largest(L));
        }
}

TEST_CASE("assemblers add, with a factor, and leave entries that are not wanted to one place")
{
    const NamedMesh m = named("mixed", make_mixed_polygons(120));
    for (const Laplacian laplacian : all_laplacians) {
        const LaplacianMatrix matrix = laplacian_matrix(laplacian, faces_of(m.mesh, m.topology), m.mesh.vertices);
        const FacesOnBothSides faces = faces_of(m.mesh, m.topology);
        const auto assembler = make_assembler(laplacian, faces);
        std::vector<Index> slots;
        for (const MatrixEntry& entry : assembler->entries())
            slots.push_back(entry.row % 2 == 0 ? matrix.pattern.slot(entry) : matrix.pattern.n_entries());
        std::vector<double> values(usize(matrix.pattern.n_entries()) + 1, 1.0);
        for (int repetition = 0; repetition < 2; ++repetition)
            assembler->add(m.mesh.vertices, 0.25, slots, values);
        const double scale = largest(dense(matrix.pattern, matrix.values));
        for (Index i = 0; i < matrix.pattern.n_entries(); ++i) {
            const bool wanted = matrix.pattern.rows[i] % 2 == 0;
            const double expected = wanted ? 1.0 + 0.5 * matrix.values[i] : 1.0;
            CHECK(std::abs(values[i] - expected) < 1e-13 * scale);
        }
    }
}
