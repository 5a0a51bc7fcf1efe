#include <vector>

#include <doctest/doctest.h>

#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

const std::string three_vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

PolygonMesh read_obj_text(const std::string& content)
{
    return read_text("a.obj", content).mesh;
}

std::string obj_complaint(const std::string& content)
{
    return complaint_about("a.obj", content);
}

}  // namespace

TEST_CASE("OBJ: corners with texture coordinates and normals, in all their forms")
{
    const auto mesh = read_obj_text(three_vertices + "vt 0 0\nvn 0 0 1\n"
                                                     "f 1 2 3\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\n"
                                                     "f 1// 2// 3//\nf 1/ 2/-1 3/-1/-1\n");
    REQUIRE(mesh.n_faces() == 6);
    for (Index f = 0; f < 6; ++f)
        CHECK(std::vector<Index>(mesh.face(f).begin(), mesh.face(f).end()) == std::vector<Index>{0, 1, 2});
}

TEST_CASE("OBJ: relative indices count back from the line, absolute ones may look ahead")
{
    const auto mesh = read_obj_text("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -1 -2 -3\nf +1 +2 +4");
    CHECK(mesh.face_vertices == std::vector<Index>{0, 1, 2, 0, 1, 2, 3, 2, 1, 0, 1, 3});
}

TEST_CASE("OBJ: continued lines, CR LF, tabs, comments, a byte order mark and a missing last line end")
{
    const auto mesh = read_obj_text("\xEF\xBB\xBF# path C:\\meshes\\\r\n\tv 0\t0 \\\r\n 0  \r\n\r\nv 1 0 0 # right\r\n"
                                    "v 0 1 0\r\n  # f 9 9 9\r\nf 1 \\\r\n\\\r\n2\\\r\n 3 # the end \\\r\nf 3 2 1");
    CHECK(mesh.n_vertices() == 3);
    CHECK(mesh.face_vertices == std::vector<Index>{0, 1, 2, 2, 1, 0});
}

TEST_CASE("OBJ: a comment in the last line, which need not end")
{
    for (const char* last :
         {"f 1 2 3 # x", "f 1 2 3# x", "f 1 2 3 #", "f 1 2 3\n# x", "f 1 2 \\\n3 # x", "f 1 2 3\r# x"}) {
        CAPTURE(last);
        CHECK(read_obj_text(three_vertices + last).face_vertices == std::vector<Index>{0, 1, 2});
    }
}

TEST_CASE("OBJ: lines that end with CR alone")
{
    CHECK(read_obj_text("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r").n_faces() == 1);
    CHECK(contains(obj_complaint("v 0 0 0\rv 1 0 0\rv 0 1 0\nf 1 2 3\n"), "put each vertex on a line of its own"));
}

TEST_CASE("OBJ: a weight or a colour after the coordinates is passed over, whatever it is")
{
    const auto mesh =
        read_obj_text("v 1 2 3 0.5\nv 4 5 6 1 0 0\nv 7 8 9 nan nan nan\nv 1 1 1 1 0 0 1\nv 2 2 2 0.5 1 0 0 1\n");
    Points expected(5, 3);
    expected << 1, 2, 3, 4, 5, 6, 7, 8, 9, 1, 1, 1, 2, 2, 2;
    CHECK(mesh.vertices == expected);
    CHECK(mesh.n_faces() == 0);
    CHECK(contains(obj_complaint("v 2 2 2 0.5 1 0 0 1 1\n"), "a.obj:1: a vertex has 3 coordinates"));
}

TEST_CASE("OBJ: everything that is no polygon is passed over")
{
    const auto mesh = read_obj_text("mtllib a.mtl\no thing\ng a f 1 2 \\\nf 1 2\n" + three_vertices +
                                    "s off\nusemtl red\np 1\nl 1 2 3\nvp 0 0\nextension of somebody\nf 1 2 3\n");
    CHECK(mesh.n_faces() == 1);
}

TEST_CASE("OBJ: numbers are rounded correctly and read in all their forms")
{
    const auto mesh = read_obj_text("v +1 1. .5\nv 1E3 -0 +1e-3\n"
                                    "v 0.1000000000000000055511151231257827021181583404541015625 1e-400 -1e-400\n"
                                    "v 9007199254740992.99999999999999999999 4.9e-324 1.7976931348623157e308\n");
    Points expected(4, 3);
    expected << 1, 1, 0.5, 1000, -0.0, 0.001, 0.1, 0.0, -0.0, 9007199254740992.0 + 0.0, 5e-324, 1.7976931348623157e308;
    expected(3, 0) = 9007199254740992.99999999999999999999;
    CHECK(identical(mesh, make_mesh(expected, {})));
}

TEST_CASE("OBJ: every complaint names the line")
{
    CHECK(obj_complaint("v 1 2\n") ==
          "a.obj:1: expected coordinate z, but the line ends; add what is missing or export the mesh again");
    CHECK(obj_complaint("# x\n\nv 1 2 x7\n") ==
          "a.obj:3: expected coordinate z, but found 'x7'; write a finite number such as 1.5 or -2e-3");
    for (const char* number : {"nan", "inf", "-inf", "1,5", "1e999", "+-1", "0x10", "1.5f", "--1", "+", "1e400"})
        CHECK(contains(obj_complaint("v 0 " + std::string(number) + " 0\n"),
                       "a.obj:1: expected coordinate y, but found '" + std::string(number)));
    CHECK(contains(obj_complaint(three_vertices + "f 1 2\n"), "a.obj:4: the face has 2 corners, but needs at least 3"));
    CHECK(contains(obj_complaint(three_vertices + "f\n"), "a.obj:4: the face has 0 corners"));
    CHECK(contains(obj_complaint(three_vertices + "f 1 2 1\n"), "a.obj:4: the face names vertex 1 twice"));
    CHECK(contains(obj_complaint(three_vertices + "v 1 1 0\nf 1 2 3 -3\n"), "a.obj:5: the face names vertex 2 twice"));
    CHECK(contains(obj_complaint(three_vertices + "f 0 1 2\n"), "a.obj:4: names vertex 0"));
    for (const std::string number : {"2147483648", "2147483649", "4294967298", "123456789012"})
        CHECK(contains(obj_complaint(three_vertices + "f 1 2 " + number + "\n"),
                       "a.obj:4: names vertex " + number + ", but a mesh has 2147483647 vertices at most"));
    CHECK(contains(obj_complaint(three_vertices + "f 1 2 4\n"),
                   "a.obj:4: names vertex 4, but the file has only 3 vertices"));
    CHECK(contains(obj_complaint("f 1 2 3\nf 1 2 9\nf 1 2 5\n" + three_vertices),
                   "a.obj:2: names vertex 9, but the file has only 3 vertices"));
    CHECK(contains(obj_complaint(three_vertices + "f 1 2 \\\n-4\n"),
                   "a.obj:5: names vertex -4, counted back from this line, but only 3 vertices precede it"));
    for (const char* corners : {"1 2 3000000000", "1 3000000000 4000000000", "3000000000/1 4000000000//2 1"})
        CHECK(
            contains(obj_complaint(three_vertices + "f " + corners + "\n"), "a.obj:4: names vertex 3000000000, but "));
    CHECK(contains(obj_complaint(three_vertices + "f 1 2 2147483647\n"),
                   "a.obj:4: names vertex 2147483647, but the file has only 3 vertices"));
    for (const std::string number : {"-2147483649", "-3000000000", "-4294967295"})
        CHECK(contains(obj_complaint(three_vertices + "f 1 2 " + number + "\n"),
                       "a.obj:4: names vertex " + number + ", counted back from this line"));
    CHECK(
        contains(obj_complaint(three_vertices + "f 1 2 99999999999999999999\n"), "a.obj:4: expected a vertex number"));
    for (const char* corner : {"3/x", "3/1/1/1", "3.0", "x", "3/1.5"})
        CHECK(contains(obj_complaint(three_vertices + "f 1 2 " + corner + "\n"), "a.obj:4: expected a "));
}

TEST_CASE("OBJ: a file without vertices")
{
    CHECK(obj_complaint("# nothing\n") == "a.obj:1: the file has no vertices; export the mesh again");
    CHECK(obj_complaint("\n\n \t") == "a.obj:3: the file has no vertices; export the mesh again");
    CHECK(contains(obj_complaint(std::string(100, '\0')), "no vertices"));
    CHECK(contains(obj_complaint("\\"), "no vertices"));
    CHECK(contains(obj_complaint("\xEF\xBB\xBF"), "no vertices"));
}

TEST_CASE("OBJ: what is written")
{
    const TemporaryDirectory folder;
    auto mesh = make_triangle();
    mesh.vertices(1, 0) = 0.1;
    write_mesh(folder.path() / "a.obj", mesh, {FileFormat::Obj, Encoding::Ascii});
    CHECK(content_of(folder.path() / "a.obj") == "v 0 0 0\nv 0.1 0 0\nv 0 1 0\nf 1 2 3\n");
}
