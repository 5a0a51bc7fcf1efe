#include <doctest/doctest.h>

#include "tests/support/mesh_files.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// A tent over a square: the ridge, 1 to 2 of the file's four lower and two upper vertices, is sharp.
const std::string tent = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 1 1\nv 2 1 1\n";

/// Doubles the height of the tent.
void raise_ridge(Points& points)
{
    points.col(2) *= 2;
}

}  // namespace

TEST_CASE("OBJ in its own form: only coordinates that differ change, whatever stands around them")
{
    const std::string before = "\xEF\xBB\xBF# a comment\r\nmtllib a b.mtl\r\no thing \\\r\n v 1 2 3\r\n\r\n"
                               "\tv  0.000 +0\t-0.0 # first\r\nv 1.50 \\\r\n 0.0\\\r\n 0e0 1.0 0.5 0.25 # coloured\r\n"
                               "vt 0.5 0.50\r\nusemtl red\r\ns 1\r\nv 0 1 .0#last\r\nf 1/1 2/1 \\\r\n3/1\r\n"
                               "l 1 2\r\ng end\r\nextension of somebody";
    CHECK(rewritten("a.obj", before, stay_put).content == before);
    const Rewritten result = rewritten("a.obj", before, move_second);
    CHECK(result.content == with(with(before, "1.50", "2"), " 0.0\\", " 0.1\\"));
    CHECK(result.remarks.empty());
}

TEST_CASE("OBJ in its own form: weights that are no numbers, lines that end with CR, and signs of zeros")
{
    const std::string before = "v 0 0 0 nan\rv 1 0 0 nan nan nan\rv 0 1 -0\rf 1 2 3\r";
    CHECK(rewritten("a.obj", before, stay_put).content == before);
    const auto after = rewritten("a.obj", before, [](Points& points) { points(2, 2) = 0.0; });
    CHECK(after.content == "v 0 0 0 nan\rv 1 0 0 nan nan nan\rv 0 1 0\rf 1 2 3\r");
}

TEST_CASE("OBJ in its own form: a normal of one vertex becomes that of those of its faces that name it")
{
    const std::string faces = "f 1//1 2//1 6//1 5//2\nf 5//3 6//4 3//4 4//-1\n";
    const std::string before =
        tent + "vn 0 -0.7 0.7\nvn 0 -0.7071 0.7071 # one\nvn 0 0.7 0.7\nvn 0 0.7 0.7\n" + "vn 0 -0.7 -0.7\n" + faces;
    CHECK(rewritten("a.obj", before, stay_put).content == before);
    const std::string after = rewritten("a.obj", before, raise_ridge).content;
    CHECK(contains(after, "v 0 1 2\nv 2 1 2\n"));
    // Of one vertex, of one face (twice), and the back of a face.
    CHECK(contains(after, "vn 0 -0.8944272 0.4472136\nvn 0 -0.8944272 0.4472136 # one\nvn 0 0.8944272 0.4472136\n"
                          "vn 0 0.8944272 0.4472136\nvn 0 -0.8944272 -0.4472136\n" +
                              faces));
}

TEST_CASE("OBJ in its own form: a smooth normal is that of all faces around the vertex, larger ones for more")
{
    const std::string before = tent + "vn 0 0 1\nvn 0 0 1\nf 1 2 6//2 5//1\nf 5//1 6//2 3 4\n";
    const auto after = rewritten("a.obj", before, [](Points& points) { points.row(3) << 0, 1, 0; });
    CHECK(after.remarks.empty());
    CHECK_FALSE(contains(after.content, "vn 0 0 1\n"));
}

TEST_CASE("OBJ in its own form: normals that cannot be made new stay, and a remark says so")
{
    const std::string before = tent + "vn 0 0 1\nvn 0 0 9\nf 1//1 2//1 6//1 5//1\nf 5//1 6//1 3//7 4\n";
    CHECK(rewritten("a.obj", before, stay_put).remarks.empty());
    const Rewritten after = rewritten("a.obj", before, raise_ridge);
    CHECK(contains(after.content, "vn 0 0 1\nvn 0 0 9\nf"));
    CHECK(after.remarks ==
          std::vector<std::string>{"of the 2 normals (vn) of a.obj, 2 could not be recomputed and stay as they were: 1 "
                                   "belong to several vertices of several faces, 1 to no face"});
}

TEST_CASE("OBJ in its own form: a normal that is no number is made new, one that is cut short only as far as it goes")
{
    const std::string before = tent + "vn nan nan 1e999\nvn 0\nvn\nf 1//1 2//2 6//3 5\n";
    CHECK(rewritten("a.obj", before, stay_put).content == before);
    const std::string after = rewritten("a.obj", before, raise_ridge).content;
    CHECK(contains(after, "vn 0 -0.8944272 0.4472136\nvn 0\nvn\nf"));
}

TEST_CASE(
    "OBJ in its own form: a backslash at the end of a comment joins no lines, nor one behind a joined line's comment")
{
    for (const std::string first : {"v 0 0 0 # one \\\n", "v 0 0 0 1 \\\n# one \\\n", "v 0 0 0 \\\n @#2\\\r\n"}) {
        CAPTURE(first);
        const auto shift = [](Points& points) { points.col(2).setConstant(3.0); };
        const std::string after = rewritten("a.obj", first + "v 1 0 0\nv 0 1 0\nf 1 2 3\n", shift).content;
        const PolygonMesh mesh = read_text("a.obj", after).mesh;
        REQUIRE(mesh.n_vertices() == 3);
        CHECK((mesh.vertices.col(2).array() == 3.0).all());
        CHECK(contains(after, "\nv 1 0 3\nv 0 1 3\nf 1 2 3\n"));
        CHECK(after.starts_with("v 0 0 3"));
    }
}

TEST_CASE("OBJ in its own form: a face without area has no normal, and the old one stays")
{
    const std::string before = tent + "vn 0 -0.7 0.7\nf 1//1 2//1 6//1\n";
    const auto after = rewritten("a.obj", before, [](Points& points) { points.row(5) << 1, 0, 0; });
    CHECK(contains(after.content, "vn 0 -0.7 0.7\n"));
}
