#include <numeric>

#include <doctest/doctest.h>

#include "partition/inspection/repeated_faces.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

using Numbers = std::vector<Index>;

Numbers all_faces(const PolygonMesh& mesh)
{
    Numbers all(at(mesh.n_faces()));
    std::iota(all.begin(), all.end(), 0);
    return all;
}

}  // namespace

TEST_CASE("repeated faces are found with the first of their vertices, whatever their order")
{
    PolygonMesh mesh;
    mesh.vertices.setZero(6, 3);
    for (const Numbers& face : {Numbers{0, 1, 2}, Numbers{3, 4, 5}, Numbers{2, 0, 1}, Numbers{0, 1, 2, 3},
                                Numbers{5, 4, 3}, Numbers{2, 1, 0}, Numbers{0, 1, 3}})
        mesh.add_face(face);
    const auto repeated = find_repeated_faces(mesh, all_faces(mesh));
    REQUIRE(repeated.size() == 3);
    CHECK((repeated[0].face == 2 && repeated[0].first == 0));
    CHECK((repeated[1].face == 4 && repeated[1].first == 1));
    CHECK((repeated[2].face == 5 && repeated[2].first == 0));
    CHECK(find_repeated_faces(mesh, {1, 2, 3}).empty());
    CHECK(find_repeated_faces(mesh, {}).empty());
}

TEST_CASE("sound meshes have none")
{
    for (const test::NamedMesh& m : test::assorted_meshes()) {
        CAPTURE(m.name);
        CHECK(find_repeated_faces(m.mesh, all_faces(m.mesh)).empty());
    }
}
