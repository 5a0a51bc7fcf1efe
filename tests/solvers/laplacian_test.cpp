#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "partition/topology.h"
#include "solvers/laplacian/laplacian_assembler.h"
#include "tests/support/reference_data.h"

using namespace seamflow;

namespace {

constexpr Laplacian all_laplacians[] = {Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::PtackovaVelho};

FaceView view(const PolygonMesh& mesh, const Topology& topology)
{
    return {mesh.face_offsets, mesh.face_vertices, topology.twin, mesh.n_vertices()};
}

std::map<Index, test::Row> rows_of(const LaplacianMatrix& matrix)
{
    std::map<Index, test::Row> rows;
    for (Index column = 0; column < matrix.pattern.n(); ++column)
        for (Index i = matrix.pattern.column_offsets[at(column)]; i < matrix.pattern.column_offsets[at(column) + 1];
             ++i)
            rows[matrix.pattern.rows[at(i)]][column] = matrix.values[at(i)];
    return rows;
}

}  // namespace

TEST_CASE("the Laplacians are those of the paper's authors, boundary rows included")
{
    const auto files = test::reference_files("operators");
    REQUIRE(files.size() == 4);
    for (const auto& file : files) {
        const test::ReferenceOperators reference = test::read_operators(file);
        const Topology topology = make_topology(reference.mesh);
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(file.filename().string());
            CAPTURE(name_of(laplacian));
            auto rows = rows_of(laplacian_matrix(laplacian, view(reference.mesh, topology), reference.mesh.vertices));
            const auto& expected_rows = reference.laplacian.at(laplacian);
            for (Index v = 0; v < reference.mesh.n_vertices(); ++v) {
                const test::Row& expected = expected_rows.at(v);
                double largest = 0.0;
                for (const auto& [column, value] : expected)
                    largest = std::max(largest, std::abs(value));
                for (const auto& [column, value] : expected)
                    CHECK(rows[v][column] == doctest::Approx(value).epsilon(1e-10).scale(largest));
                for (const auto& [column, value] : rows[v])
                    if (!expected.contains(column))
                        CHECK(std::abs(value) <= 1e-10 * largest);
            }
        }
    }
}
