// Reading files with faces that are none: these are left out, and stay in the file.

#include <string>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

using Numbers = std::vector<Index>;

struct Reading {
    MeshFile file;
    FaultLog left_out{.of_faces_alone = true};
};

/// Reads a file with harmless faults, which read_mesh refuses.
Reading read_leaving_out(const test::TemporaryDirectory& directory, const std::string& name, const std::string& content)
{
    static_cast<void>(directory.with(name, content));
    Reading reading;
    reading.file = read_faulty_mesh(directory / name, reading.left_out);
    CHECK_THROWS_AS(read_mesh(directory / name), InputError);
    CHECK(reading.left_out.n_harmless == reading.left_out.count);
    return reading;
}

/// The file written again with one vertex moved.
std::string rewritten(const test::TemporaryDirectory& directory, const Reading& reading, const std::string& name)
{
    REQUIRE(reading.file.source);
    PolygonMesh mesh = reading.file.mesh;
    mesh.vertices(0, 2) = 5.0;
    write_mesh_like(*reading.file.source, directory / name, mesh);
    return test::content_of(directory / name);
}

}  // namespace

TEST_CASE("OBJ: faces without three different corners are left out and stay in the file")
{
    const test::TemporaryDirectory directory;
    const std::string vertices = "v 1 0 0\nv 0 1 0\nv 0 0 1\n";
    const std::string faces = "f 1 1 2\nf 1 2 3\nf 1 2\nf 3 -3 2 -3\nf 3 2 1\n";
    const Reading reading = read_leaving_out(directory, "a.obj", "v 0 0 0\n" + vertices + faces);
    CHECK(reading.left_out.faces_left_out == Numbers{0, 2, 3});
    CHECK(reading.left_out.count == 3);
    CHECK(reading.left_out.messages[1].find("a.obj:7: the face has 2 corners") != std::string::npos);
    CHECK(reading.file.mesh.n_faces() == 2);
    CHECK(rewritten(directory, reading, "b.obj") == "v 0 0 5\n" + vertices + faces);
}

TEST_CASE("OBJ: normals belong to the faces that are left")
{
    const test::TemporaryDirectory directory;
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
    // Normals of faces: that of the face that is left out is nobody's.
    const std::string faces = "f 1//1 1//1 2//1\nf 1//2 2//2 3//2\nf 2//3 4//3 3//3\n";
    const Reading reading = read_leaving_out(directory, "a.obj", vertices + "vn 1 0 0\nvn 0 0 1\nvn 0 0 1\n" + faces);
    PolygonMesh mesh = reading.file.mesh;
    mesh.vertices(0, 2) = 1.0;
    write_mesh_like(*reading.file.source, directory / "b.obj", mesh);
    const std::string content = test::content_of(directory / "b.obj");
    CHECK(content.find("vn 1 0 0\nvn 0.57735026 0.57735026 0.57735026\nvn 0 0 1\nf") != std::string::npos);
}

TEST_CASE("OFF and PLY: the same")
{
    const test::TemporaryDirectory directory;
    const std::string vertices = "1 0 0\n0 1 0\n0 0 1\n";
    const std::string faces = "3 1 1 2\n3 0 1 2\n2 0 1\n4 0 1 2 1\n3 3 2 1\n";
    const Reading off = read_leaving_out(directory, "a.off", "OFF\n4 5 0\n0 0 0\n" + vertices + faces);
    CHECK(off.left_out.faces_left_out == Numbers{0, 2, 3});
    CHECK(rewritten(directory, off, "b.off") == "OFF\n4 5 0\n0 0 5\n" + vertices + faces);

    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
        "property double z\nelement face 5\nproperty list uchar int vertex_indices\nend_header\n";
    const Reading ply = read_leaving_out(directory, "a.ply", header + "0 0 0\n" + vertices + faces);
    CHECK(ply.left_out.faces_left_out == Numbers{0, 2, 3});
    CHECK(rewritten(directory, ply, "b.ply") == header + "0 0 5\n" + vertices + faces);

    // Numbers that nobody has declared.
    const std::string more = "1 0 0 255\n0 1 0\n0 0 1 1 2\n";
    const std::string longer = "3 0 1 2 7 7 7\n3 0 1 3\n3 0 2 3\n3 1 2 3\n3 3 2 1 0\n";
    const Reading surplus = read_leaving_out(directory, "c.ply", header + "0 0 0\n" + more + longer);
    CHECK(surplus.left_out.faces_left_out.empty());
    CHECK(surplus.left_out.count == 4);
    CHECK(surplus.file.mesh.n_faces() == 5);
    CHECK(rewritten(directory, surplus, "d.ply") == header + "0 0 5\n" + more + longer);
}

TEST_CASE("STL: facets with two corners in one place are left out, and make no vertices")
{
    const test::TemporaryDirectory directory;
    const auto facet = [](const std::string& a, const std::string& b, const std::string& c) {
        return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
               "\nendloop\nendfacet\n";
    };
    const Reading reading =
        read_leaving_out(directory, "a.stl",
                         "solid\n" + facet("9 9 9", "9 9 9", "0 0 0") + facet("0 0 0", "1 0 0", "0 1 0") +
                             facet("0 0 0", "-0 0 0", "0 1 0") + "endsolid\n");
    CHECK(reading.left_out.faces_left_out == Numbers{0, 2});
    CHECK(reading.file.mesh.n_faces() == 1);
    CHECK(reading.file.mesh.n_vertices() == 3);
    CHECK_NOTHROW(rewritten(directory, reading, "b.stl"));
}

TEST_CASE("what leaves doubt is thrown, beside faces that are left out, too")
{
    const test::TemporaryDirectory directory;
    const std::string begin = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\n";
    for (const char* rest : {"f 1 2 9\n", "f 0 1 2\n", "v nan 0 0\nf 1 2 3\n", "f 1 2 x\n"}) {
        static_cast<void>(directory.with("a.obj", begin + rest));
        FaultLog left_out{.of_faces_alone = true};
        CHECK_THROWS_AS(read_faulty_mesh(directory / "a.obj", left_out), InputError);
    }
}

TEST_CASE("corners that repeat the one before them count once, in all formats, and the file stays as it is")
{
    const test::TemporaryDirectory directory;
    const std::string rows = "1 0 0\n0 1 0\n0 0 1\n";
    const PolygonMesh expected =
        test::make_mesh(test::read_text("v.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n").mesh.vertices,
                        {{0, 1, 2}, {1, 2, 3}, {0, 3, 2, 1}, {0, 1, 3}});
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 9 0 0\nvn 0 0 1\nvn 1 0 0\n"
                            "f 1//1 2//1 3//1 3//2\nf 2 3 3 4 4 2 2\nf 1 4 3 2 -4\nf 1//3 1//2 2//3 4//3\n";
    const std::string faces = "4 0 1 2 2\n7 1 2 2 3 3 1 1\n5 0 3 2 1 0\n4 0 0 1 3\n";
    const std::string header = "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
                               "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& example : {std::pair<std::string, std::string>{"a.obj", obj},
                                {"a.off", "OFF\n4 4 0\n0 0 0\n" + rows + faces},
                                {"a.ply", "ply\nformat ascii 1.0\n" + header + "0 0 0\n" + rows + faces}}) {
        const auto& name = example.first;
        const auto& content = example.second;
        CAPTURE(name);
        const auto path = directory.with(name, content);
        const MeshFile file = read_mesh(path);
        CHECK(test::identical(file.mesh, expected));
        write_mesh_like(*file.source, directory / ("b" + name), file.mesh);
        CHECK(test::content_of(directory / ("b" + name)) == content);
    }
    // Normals go with the corners that are left: the first is that of a face, the second nobody's.
    const MeshFile file = read_mesh(directory / "a.obj");
    PolygonMesh moved = file.mesh;
    moved.vertices(2, 2) = 1.0;
    write_mesh_like(*file.source, directory / "b.obj", moved);
    const std::string content = test::content_of(directory / "b.obj");
    CHECK(content.find("vn 0 -0.70710677 0.70710677\nvn 0 0 1\nvn 1 0 0\n") != std::string::npos);
}
