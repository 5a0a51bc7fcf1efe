// Reading as far as possible, and noting what was wrong.

#include <cmath>
#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

struct FaultyReading {
    PolygonMesh mesh;
    FaultLog faults;
};

FaultyReading read_faulty(const std::string& name, const std::string& text)
{
    const test::TemporaryDirectory directory;
    std::ofstream(directory / name, std::ios::binary) << text;
    FaultyReading reading;
    reading.mesh = read_faulty_mesh(directory / name, reading.faults).mesh;
    CHECK_THROWS_AS(read_mesh(directory / name), InputError);
    return reading;
}

using Numbers = std::vector<Index>;

Numbers face(const PolygonMesh& mesh, Index f)
{
    return {mesh.face(f).begin(), mesh.face(f).end()};
}

const std::string square_of_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("OBJ: faces with faults are left out, vertices keep their numbers")
{
    const FaultyReading reading =
        read_faulty("a.obj", "v 0 0 0\nv nan 0 0\nv 1 inf 0\nv 0 1 x\nf 1 2 3\nf 1 2\nf 1 1 2\nf 1 2 9\n"
                             "f 0 1 2\nf -9 1 2\nf 2 3 4\n");
    CHECK(reading.mesh.n_vertices() == 4);
    CHECK(std::isnan(reading.mesh.vertices(1, 0)));
    CHECK(reading.mesh.vertices(2, 0) == 1.0);
    CHECK_FALSE(std::isfinite(reading.mesh.vertices(2, 1)));
    REQUIRE(reading.mesh.n_faces() == 2);
    CHECK(face(reading.mesh, 0) == Numbers{0, 1, 2});
    CHECK(face(reading.mesh, 1) == Numbers{1, 2, 3});
    CHECK(reading.faults.count == 8);
    REQUIRE(reading.faults.messages.size() == 8);
    CHECK(reading.faults.messages[0].find("a.obj:2: expected coordinate x, but found 'nan'") != std::string::npos);
    CHECK(reading.faults.messages[3].find("a.obj:6: the face has 2 corners") != std::string::npos);
    CHECK(reading.faults.messages[4].find("a.obj:7: the face names vertex 1 twice") != std::string::npos);
}

TEST_CASE("OFF and PLY: the same")
{
    const FaultyReading off = read_faulty("a.off", "OFF\n3 3 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n3 0 1 7\n2 0 1\n");
    CHECK(off.faults.count == 3);
    CHECK(off.mesh.n_vertices() == 3);
    CHECK(off.mesh.n_faces() == 1);
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
        "z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const FaultyReading ply = read_faulty("a.ply", header + "0 0 0\n1 0 0\n0 -inf 0\n3 0 1 2\n4 0 1 2 1\n");
    CHECK(ply.faults.count == 2);
    CHECK(ply.mesh.n_faces() == 1);
}

TEST_CASE("STL: facets whose corners coincide are left out")
{
    const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex ";
    const std::string end = "\nendloop\nendfacet\n";
    const FaultyReading reading = read_faulty("a.stl", "solid\n" + facet + "0 1 0" + end + facet + "1 0 0" + end +
                                                           facet + "0 nan 0" + end + "endsolid\n");
    CHECK(reading.faults.count == 2);
    CHECK(reading.mesh.n_faces() == 2);
    CHECK(reading.mesh.n_vertices() == 4);
}

TEST_CASE("binary PLY: a coordinate that is no number is noted with its element")
{
    const test::TemporaryDirectory directory;
    PolygonMesh mesh = test::quad_grid(2, 2);
    write_mesh(directory / "a.ply", mesh, {FileFormat::Ply, Encoding::BinaryLittleEndian});
    std::fstream file(directory / "a.ply", std::ios::binary | std::ios::in | std::ios::out);
    const std::string header = "end_header\n";
    const std::string content((std::istreambuf_iterator<char>(file)), {});
    const double nan = std::nan("");
    file.clear();
    file.seekp(static_cast<std::streamoff>(content.find(header) + header.size() + 4 * sizeof(double)));
    file.write(reinterpret_cast<const char*>(&nan), sizeof nan);
    file.close();
    FaultLog faults;
    const PolygonMesh read = read_faulty_mesh(directory / "a.ply", faults).mesh;
    CHECK(faults.count == 1);
    CHECK(faults.messages.at(0).find("vertex 1") != std::string::npos);
    CHECK(std::isnan(read.vertices(1, 1)));
    CHECK(read.n_faces() == mesh.n_faces());
}

TEST_CASE("sound files have no faults; what is no mesh, or cut off, is refused as ever")
{
    const test::TemporaryDirectory directory;
    std::ofstream(directory / "a.obj") << square_of_obj << "f 1 2 3 4\n";
    FaultLog faults;
    CHECK(read_faulty_mesh(directory / "a.obj", faults).mesh.n_faces() == 1);
    CHECK(faults.count == 0);
    std::ofstream(directory / "b.off") << "OFF\n4 1 0\n0 0 0\n";
    CHECK_THROWS_AS(read_faulty_mesh(directory / "b.off", faults), InputError);
    CHECK_THROWS_AS(read_faulty_mesh(directory / "none.off", faults), InputError);
    CHECK_THROWS_AS(read_faulty_mesh(directory / "a.xyz", faults), InputError);
}

TEST_CASE("messages are kept up to a number, and all faults are counted")
{
    std::string text = square_of_obj;
    for (int i = 0; i < 2000; ++i)
        text += "f 1 1 2\n";
    const FaultyReading reading = read_faulty("a.obj", text);
    CHECK(reading.faults.count == 2000);
    CHECK(reading.faults.messages.size() == FaultLog::most_messages);
}
