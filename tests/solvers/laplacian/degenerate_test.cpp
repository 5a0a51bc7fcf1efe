#include <string>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "solvers/laplacian/degenerate.h"
#include "tests/support/flows.h"
#include "tests/support/matrices.h"
#include "tests/support/messages.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

std::string complaint(const PolygonMesh& mesh, Laplacian laplacian)
{
    return message_of<InputError>([&] { require_sound_geometry(mesh, make_topology(mesh), laplacian); });
}

/// All rows of vertices that may move are finite.
bool is_finite_where_it_matters(const PolygonMesh& mesh, Laplacian laplacian)
{
    const Topology topology = make_topology(mesh);
    const Eigen::MatrixXd matrix = dense_laplacian(laplacian, mesh, topology);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (topology.kind[v] == VertexKind::Interior && !matrix.row(v).allFinite())
            return false;
    return true;
}

}  // namespace

TEST_CASE("sound meshes pass")
{
    for (const NamedMesh& m : sound_meshes())
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(m.name);
            CHECK(complaint(m.mesh, laplacian).empty());
        }
}

TEST_CASE("an edge without length is named for Fujiwara alone")
{
    PolygonMesh mesh = quad_grid(4, 4);
    mesh.vertices.row(12) = mesh.vertices.row(13);
    const std::string message = complaint(mesh, Laplacian::Fujiwara);
    CHECK(contains(message, "vertices 13 and 12"));
    CHECK(contains(message, "face 6 "));
    CHECK(complaint(mesh, Laplacian::AlexaWardetzky).empty());
    CHECK(complaint(mesh, Laplacian::PtackovaVelho).empty());
    // The other end may be held fixed.
    PolygonMesh at_rim = quad_grid(4, 4);
    at_rim.vertices.row(6) = at_rim.vertices.row(1);
    CHECK(contains(complaint(at_rim, Laplacian::Fujiwara), "face 0 "));
}

TEST_CASE("a face without area is named for the others")
{
    PolygonMesh mesh = triangle_grid(4, 4);
    const auto corners = mesh.face(10);
    mesh.vertices.row(corners[1]) = 0.5 * (mesh.vertices.row(corners[0]) + mesh.vertices.row(corners[2]));
    CHECK(contains(complaint(mesh, Laplacian::AlexaWardetzky), "face 10 (numbered from 0) has no area"));
    CHECK(contains(complaint(mesh, Laplacian::PtackovaVelho), "face 10 (numbered from 0) has no area"));
    CHECK(complaint(mesh, Laplacian::Fujiwara).empty());
}

TEST_CASE("what lies between fixed vertices only may be degenerate")
{
    PolygonMesh mesh = triangle_grid(4, 4);
    mesh.vertices.row(4) = mesh.vertices.row(3);
    CHECK(complaint(mesh, Laplacian::Fujiwara).empty());
    CHECK(is_finite_where_it_matters(mesh, Laplacian::Fujiwara));
    CHECK(complaint(mesh, Laplacian::AlexaWardetzky).empty() ==
          is_finite_where_it_matters(mesh, Laplacian::AlexaWardetzky));
}

TEST_CASE("Ptáčková-Velho needs the area of faces across an edge too")
{
    // An ear on a grid: a triangle of boundary vertices on an edge of a face with an interior vertex.
    PolygonMesh mesh;
    mesh.vertices.resize(8, 3);
    mesh.vertices << 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 0, 1, -1, 0, 9, 9, 9, 9, 9, 9;
    for (Index k = 0; k < 4; ++k)
        mesh.add_face(std::vector<Index>{k, (k + 1) % 4, 4});
    mesh.add_face(std::vector<Index>{0, 5, 1});
    for (const Laplacian laplacian : all_laplacians)
        CHECK(complaint(mesh, laplacian).empty());
    mesh.vertices.row(5) << 1, 0, 0;
    CHECK(is_finite_where_it_matters(mesh, Laplacian::AlexaWardetzky));
    CHECK(complaint(mesh, Laplacian::AlexaWardetzky).empty());
    CHECK(!is_finite_where_it_matters(mesh, Laplacian::PtackovaVelho));
    CHECK(contains(complaint(mesh, Laplacian::PtackovaVelho), "face 4 (numbered from 0) has no area"));
}

TEST_CASE("once the vertices without a row are held, no row that matters divides in vain, and few are held")
{
    PolygonMesh folded = triangle_grid(8, 8);
    const auto corners = folded.face(60);
    folded.vertices.row(corners[1]) = 0.5 * (folded.vertices.row(corners[0]) + folded.vertices.row(corners[2]));
    PolygonMesh merged = quad_grid(8, 8);
    merged.vertices.row(40) = merged.vertices.row(41);
    for (const PolygonMesh& mesh : {folded, merged})
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(name_of(laplacian));
            Topology topology = make_topology(mesh);
            const std::vector<Index> held = vertices_without_row(mesh, topology, laplacian);
            CHECK(held.empty() == complaint(mesh, laplacian).empty());
            CHECK(held.size() <= 12);
            fix_vertices(topology, held);
            CHECK(vertices_without_row(mesh, topology, laplacian).empty());
            const Eigen::MatrixXd matrix = dense_laplacian(laplacian, mesh, topology);
            for (Index v = 0; v < mesh.n_vertices(); ++v)
                if (topology.moves(v))
                    CHECK(matrix.row(v).allFinite());
        }
}
