#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "partition/formats/off.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

const std::string triangle_body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string off_complaint(const std::string& content)
{
    return complaint_about("a.off", content);
}

}  // namespace

TEST_CASE("OFF: the counts may stand on the line of OFF or after it, with comments anywhere")
{
    for (const char* header : {"OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF3 1 0\n", "OFF 3 1\n",
                               "# made by hand\n\n OFF # polygons\n#\n3 1 3# counts\n", "3 1 3\n",
                               "\tOFF\r\n3\t1 0 \r\n", "\xEF\xBB\xBFOFF\n3 1 0\n"}) {
        CAPTURE(header);
        CHECK(identical(read_text("a.off", header + triangle_body).mesh, make_triangle()));
    }
    CHECK(identical(read_text("a.off", "OFF\n3 1 0\n0 0 0#first\n#\n1 0 0\n\n0 1 0\n\n3 0 1 2").mesh, make_triangle()));
}

TEST_CASE("OFF: a comment in the last line, which need not end")
{
    for (const char* end : {" # x", "# x", "#", "\n# x"}) {
        CAPTURE(end);
        CHECK(identical(read_text("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2" + std::string(end)).mesh,
                        make_triangle()));
    }
    CHECK(read_text("a.off", "OFF 1 0 0\n1 2 3 # x").mesh.n_vertices() == 1);
}

TEST_CASE("OFF: numbers after the coordinates and colours of faces are passed over")
{
    for (const char* keyword : {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"}) {
        const auto mesh =
            read_text("a.off", std::string(keyword) + "\n3 2 0\n0 0 0 1 0 0 1\n1 0 0 0 255 0 255\n"
                                                      "0 1 0 0 0 1 1\n3 0 1 2 255 0 0\n3 2 1 0 0.1 0.2 0.3 1\n");
        CHECK(mesh.mesh.face_vertices == std::vector<Index>{0, 1, 2, 2, 1, 0});
    }
}

TEST_CASE("OFF: every complaint names the line")
{
    CHECK(contains(off_complaint("hello\n"), "a.off:1: the file begins with 'hello' and not with OFF"));
    CHECK(contains(off_complaint("OFFSET 1 2 3\n"), "not with OFF"));
    CHECK(contains(off_complaint("# nothing\n"), "a.off:1: the file holds no mesh"));
    CHECK(contains(off_complaint("NOFF BINARY\n"), "a.off:1: binary OFF files with more than coordinates and faces"));
    CHECK(contains(off_complaint("4OFF\n3 1 0\n"), "a.off:1: '4OFF' files"));
    CHECK(contains(off_complaint("nOFF\n3\n"), "a.off:1: 'nOFF' files"));
    CHECK(contains(off_complaint("XOFF\n3 1 0\n"), "a.off:1: the keyword 'XOFF' is unknown"));
    CHECK(contains(off_complaint("OFF\n"), "a.off:1: the file ends before the numbers of vertices and faces"));
    CHECK(contains(off_complaint("OFF\n3\n" + triangle_body),
                   "a.off:2: expected the number of faces, but the line ends"));
    CHECK(contains(off_complaint("OFF\n3 1 0 7\n" + triangle_body), "a.off:2: expected the end of the line"));
    CHECK(contains(off_complaint("OFF\n-3 1 0\n" + triangle_body), "a.off:2: the number of vertices is -3"));
    CHECK(contains(off_complaint("OFF\n2147483648 1 0\n" + triangle_body),
                   "a.off:2: the number of vertices is 2147483648"));
    CHECK(contains(off_complaint("OFF\n3 9000000000000000000 0\n" + triangle_body),
                   "a.off:2: the number of faces is 9000000"));
    CHECK(contains(off_complaint("OFF\n3 2 0\n" + triangle_body), "a.off:6: the file ends after 1 of 2 faces"));
    CHECK(contains(off_complaint("OFF\n5 1 0\n" + triangle_body), "a.off:6: the file ends after 4 of 5 vertices"));
    CHECK(contains(off_complaint("OFF\n3 1 0\n" + triangle_body + "3 0 1 2\n"),
                   "a.off:7: the file continues after the 3 vertices"));
    CHECK(contains(off_complaint("OFF\n3 1 0\n0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "a.off:3: expected coordinate z"));
    CHECK(contains(off_complaint("OFF\n3 1 0\n0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n"), "a.off:4: expected coordinate z"));
    const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
    CHECK(contains(off_complaint(vertices + "3 0 1\n"), "a.off:6: expected the vertices of all corners of the face"));
    CHECK(contains(off_complaint(vertices + "3 0 1 3\n"),
                   "a.off:6: names vertex 3, but the file has only the vertices 0 to 2"));
    CHECK(contains(off_complaint(vertices + "3 0 1 -1\n"), "a.off:6: names vertex -1"));
    CHECK(contains(off_complaint(vertices + "3 0 1 0\n"), "a.off:6: the face names vertex 0 twice"));
    CHECK(contains(off_complaint(vertices + "2 0 1\n"), "a.off:6: the face has 2 corners"));
    CHECK(contains(off_complaint(vertices + "-1\n"), "a.off:6: the face has 0 corners"));
    CHECK(contains(off_complaint(vertices + "2000000000 0 1 2\n"), "a.off:6: expected the vertices of all corners"));
    CHECK(contains(off_complaint("OFF 0 0 0\n"), "the file has no vertices"));
}

TEST_CASE("OFF: a file without faults across lines has none, though line by line it would have")
{
    // The second line of the first vertex has its normal, which is passed over.
    const std::string text = "NOFF\n2 0 0\n0 0 0\nx 0 1\n1 1 1 0 0 1\n";
    CHECK(read_off("a.off", text, Slicing()).vertices == (Points(2, 3) << 0, 0, 0, 1, 1, 1).finished());
    FaultLog faults;
    CHECK(read_off("a.off", text, Slicing(), &faults).vertices(1, 2) == 1.0);
    CHECK(faults.count == 0);
}

TEST_CASE("OFF: what is written")
{
    const TemporaryDirectory folder;
    write_mesh(folder.path() / "a.off", make_triangle(), {FileFormat::Off, Encoding::Ascii});
    CHECK(content_of(folder.path() / "a.off") == "OFF\n3 1 0\n" + triangle_body);
}

namespace {

/// A tetrahedron as binary OFF.
std::string binary_tetrahedron(std::endian order, bool colours_follow_faces, float first_coordinate = 0.1F)
{
    std::string file = "OFF BINARY\n";
    const auto append = [&](auto number) {
        auto bytes = std::bit_cast<std::array<char, 4>>(number);
        if (order != std::endian::native)
            std::reverse(bytes.begin(), bytes.end());
        file.append(bytes.data(), bytes.size());
    };
    for (const std::int32_t count : {4, 4, 6})
        append(count);
    for (const float coordinate : {first_coordinate, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F})
        append(coordinate);
    for (const std::array<std::int32_t, 4>& face : {std::array{3, 0, 2, 1}, {3, 0, 1, 3}, {3, 1, 2, 3}, {3, 0, 3, 2}}) {
        for (const std::int32_t number : face)
            append(number);
        if (colours_follow_faces) {
            append(std::int32_t{1});
            append(0.5F);
        }
    }
    return file;
}

}  // namespace

TEST_CASE("binary OFF is read in both byte orders, with colours behind the faces and without")
{
    for (const std::endian order : {std::endian::big, std::endian::little})
        for (const bool colours : {true, false}) {
            const MeshFile file = test::read_text("a.off", binary_tetrahedron(order, colours));
            CHECK(file.kind == FileKind{FileFormat::Off, Encoding::Ascii});
            REQUIRE(file.mesh.n_vertices() == 4);
            REQUIRE(file.mesh.n_faces() == 4);
            CHECK(file.mesh.vertices(0, 0) == static_cast<double>(0.1F));
            CHECK(file.mesh.vertices(3, 2) == 1.0);
            CHECK(file.mesh.face(2)[0] == 1);
            CHECK(file.mesh.face(3)[2] == 2);
        }
}

TEST_CASE("binary OFF that is cut off, too long, or holds what is no number is refused")
{
    const std::string whole = binary_tetrahedron(std::endian::little, false);
    for (std::size_t size = 11; size < whole.size(); ++size)
        CHECK(contains(test::complaint_about("a.off", whole.substr(0, size)),
                       "a.off: byte 11: the binary data do not end"));
    CHECK(contains(test::complaint_about("a.off", whole + "more"), "do not end"));
    CHECK(contains(test::complaint_about("a.off", "OFF BINARY\n" + std::string(12, '\xff')), "do not end"));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(contains(test::complaint_about("a.off", binary_tetrahedron(std::endian::big, true, nan)),
                   "vertex 0 (numbered from 0), byte 23: a coordinate is not a finite number"));
}

TEST_CASE("OFF: what vertices have besides coordinates may be named in any order, each once")
{
    const std::string data = "3 1 0\n0 0 0 9 9 9 1 0 0 1 .5 .5\n1 0 0 9 9 9 1 0 0 1 .5 .5\n0 1 0 9 9 9 1 0 0 1 .5 .5\n"
                             "3 0 1 2\n";
    std::vector<std::string> parts{"C", "N", "ST"};
    do {
        const std::string name = parts[0] + parts[1] + parts[2] + "OFF\n";
        CAPTURE(name);
        CHECK(read_text("a.off", name + data).mesh.n_faces() == 1);
        // Normals follow the coordinates, whatever the order of the names.
        CHECK(contains(rewritten("a.off", name + data, [](Points& p) { p(2, 2) = 1.0; }).content,
                       "1 0 0 0 -0.70710677 0.70710677 1 0 0 1 .5 .5\n"));
    } while (std::next_permutation(parts.begin(), parts.end()));
    for (const char* name : {"CC", "NCN", "STST", "S", "T", "TS", "X", "CNX"})
        CHECK(contains(complaint_about("a.off", name + ("OFF\n" + data)), "is unknown"));
}

TEST_CASE("OFF: a file with one line for each vertex and face is read by its lines, so that it can be written back")
{
    // With lines as blanks the last two vertices would be (0 1 0) and (5 7 9).
    CHECK(
        contains(off_complaint("OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0 5\n7 9\n3 0 1 2\n"), "a.off:6: expected coordinate z"));
    // Without one line for each they are.
    const std::string freely = "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0 5\n7\n9\n3 0 1 2\n";
    CHECK(read_text("a.off", freely).mesh.vertices.row(3) == Eigen::RowVector3d(5.0, 7.0, 9.0));
    CHECK(rewritten("a.off", freely, [](Points& p) { p(3, 2) = 8.0; }).content ==
          "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0 5\n7\n8\n3 0 1 2\n");
}
