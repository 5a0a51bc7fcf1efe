#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "solvers/conditions/derivatives.h"
#include "tests/support/conditions.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/reference_data.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// A row of a stencil by the vertices of the whole mesh.
Row global_row(const SubMesh& sub_mesh, std::span<const Index> columns, std::span<const double> row)
{
    Row global;
    for (std::size_t k = 0; k < columns.size(); ++k)
        global[sub_mesh.local_to_global[columns[k]]] += row[k];
    return global;
}

void check_same(const Row& found, const Row& expected)
{
    double largest = 0.0;
    for (const auto& [column, value] : expected)
        largest = std::max(largest, std::abs(value));
    for (const auto& [column, value] : found)
        CHECK(std::abs(value - (expected.contains(column) ? expected.at(column) : 0.0)) <= 1e-10 * largest);
    for (const auto& [column, value] : expected)
        CHECK(found.contains(column));
}

}  // namespace

TEST_CASE("the derivatives are those of the paper's authors")
{
    for (const auto& file : reference_files("operators")) {
        CAPTURE(file.filename().string());
        const ReferenceOperators reference = read_operators(file);
        const Topology topology = make_topology(reference.mesh);
        const Decomposition decomposition = seamflow::decompose(reference.mesh, topology, reference.labels, 2);
        CHECK(reference.interface_rows.size() == 2 * usize(decomposition.n_interface_vertices));
        for (const auto& expected : reference.interface_rows) {
            CAPTURE(expected.vertex);
            const SubMesh& sub_mesh = decomposition.sub_meshes[expected.sub_mesh];
            const Points positions = localised(sub_mesh, reference.mesh.vertices);
            const auto& vertices = sub_mesh.interface.vertices;
            const auto place = std::find(vertices.begin(), vertices.end(), local_index(sub_mesh, expected.vertex));
            REQUIRE(place != vertices.end());
            const auto i = static_cast<Index>(place - vertices.begin());
            const DerivativeStencils stencils = make_derivative_stencils(sub_mesh);
            const auto columns = stencils.columns[i];
            std::vector<double> row(columns.size());
            const auto conormal = own_conormal(sub_mesh, i, positions);
            REQUIRE(conormal);
            normal_derivative_row(sub_mesh, stencils, i, *conormal, row);
            check_same(global_row(sub_mesh, columns, row), expected.normal_derivative);
            const TangentialWeights weights = tangential_weights(sub_mesh, i, positions);
            std::fill(row.begin(), row.end(), 0.0);
            add_tangential_derivative(stencils, i, weights, 1.0, row);
            const Row tangential = global_row(sub_mesh, columns, row);
            for (const auto& [column, value] : expected.tangential_derivative)
                CHECK(tangential.at(column) == relative(value, 1e-10));
            CHECK(std::count_if(row.begin(), row.end(), [](double c) { return c != 0.0; }) == 3);
        }
    }
}

TEST_CASE("a stencil is the vertices of the own faces, and knows the places of its corners")
{
    for_each_sub_mesh([](const CutMesh&, const SubMesh& sub_mesh) {
        const auto& interface = sub_mesh.interface;
        const DerivativeStencils stencils = make_derivative_stencils(sub_mesh);
        REQUIRE(stencils.columns.size() == interface.size());
        for (Index i = 0; i < interface.size(); ++i) {
            const auto columns = stencils.columns[i];
            CHECK(std::is_sorted(columns.begin(), columns.end()));
            CHECK(columns[stencils.centre[i]] == interface.vertices[i]);
            CHECK(columns[stencils.before[i]] == interface.before[i]);
            CHECK(columns[stencils.after[i]] == interface.after[i]);
            std::vector<Index> corners;
            for (const Index f : interface.own_faces[i])
                corners.insert(corners.end(), sub_mesh.face_vertices[f].begin(), sub_mesh.face_vertices[f].end());
            REQUIRE(stencils.corner_columns[i].size() == corners.size());
            for (std::size_t k = 0; k < corners.size(); ++k)
                CHECK(columns[stencils.corner_columns[i][k]] == corners[k]);
        }
    });
}

TEST_CASE("the normal derivative of the positions is the unit conormal, at right angles to the tangent")
{
    for_each_sub_mesh([](const CutMesh& cut, const SubMesh& sub_mesh) {
        const Points positions = localised(sub_mesh, cut.mesh.vertices);
        const DerivativeStencils stencils = make_derivative_stencils(sub_mesh);
        for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
            const auto conormal = own_conormal(sub_mesh, i, positions);
            if (!conormal)
                continue;
            std::vector<double> row(stencils.columns[i].size());
            normal_derivative_row(sub_mesh, stencils, i, *conormal, row);
            const double largest = std::abs(*std::max_element(
                row.begin(), row.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
            const double rounding = 1e-13 * largest * positions.cwiseAbs().maxCoeff();
            CHECK(conormal->direction.norm() == relative(1.0, 1e-5));
            CHECK((applied(stencils.columns[i], row, positions) - conormal->direction).norm() <= rounding);
            const Point tau = positions.row(sub_mesh.interface.after[i]) - positions.row(sub_mesh.interface.before[i]);
            CHECK(std::abs(conormal->direction.dot(tau)) <= rounding * tau.norm());
            double sum = 0.0;
            for (const double coefficient : row)
                sum += coefficient;
            CHECK(std::abs(sum) <= 1e-13 * largest);
        }
    });
}

TEST_CASE("the other side's conormal is the other sub-mesh's own, where there are two")
{
    for (const CutMesh& cut : cut_meshes()) {
        if (cut.n_parts != 2)
            continue;
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        const SubMesh& a = decomposition.sub_meshes[0];
        const SubMesh& b = decomposition.sub_meshes[1];
        const Points at_a = localised(a, cut.mesh.vertices);
        const Points at_b = localised(b, cut.mesh.vertices);
        REQUIRE(a.interface.size() == b.interface.size());
        for (Index i = 0; i < a.interface.size(); ++i) {
            const auto other = complement_conormal(a, i, at_a);
            const auto own = own_conormal(b, i, at_b);
            REQUIRE(other.has_value() == own.has_value());
            if (own)
                CHECK((other->direction - own->direction).norm() < 1e-12);
        }
    }
}

TEST_CASE("across a straight interface of a flat mesh the two conormals are opposite and point outward")
{
    for (const PolygonMesh& mesh : {quad_grid(8, 6), triangle_grid(8, 6)}) {
        const CutMesh cut = cut_by_place("", mesh, [](const Point& c) { return c.x() > 3.0 ? Index{1} : Index{0}; });
        const Decomposition decomposition = test::decompose(cut);
        for (const Index s : {0, 1}) {
            const SubMesh& sub_mesh = decomposition.sub_meshes[s];
            const Points positions = localised(sub_mesh, cut.mesh.vertices);
            CHECK(sub_mesh.interface.size() == 5);
            const Point outward(s == 0 ? 1.0 : -1.0, 0.0, 0.0);
            for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
                CHECK((own_conormal(sub_mesh, i, positions)->direction - outward).norm() < 1e-14);
                CHECK((complement_conormal(sub_mesh, i, positions)->direction + outward).norm() < 1e-14);
            }
        }
    }
}

TEST_CASE("where a fan has shrunk to a point or to the interface itself there is no conormal")
{
    const CutMesh cut =
        cut_by_place("", quad_grid(4, 4), [](const Point& c) { return c.x() > 2.0 ? Index{1} : Index{0}; });
    const Decomposition decomposition = test::decompose(cut);
    const SubMesh& sub_mesh = decomposition.sub_meshes[0];
    Points positions = localised(sub_mesh, cut.mesh.vertices);
    positions.col(0).setConstant(1e6);
    for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
        CHECK(!own_conormal(sub_mesh, i, positions));
        CHECK(!complement_conormal(sub_mesh, i, positions));
    }
    positions.setConstant(3.0);
    for (Index i = 0; i < sub_mesh.interface.size(); ++i)
        CHECK(!own_conormal(sub_mesh, i, positions));
}
