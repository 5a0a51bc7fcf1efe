#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "partition/io/byte_order.h"
#include "samples/meshes/meshes.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

constexpr FileKind text_stl = {FileFormat::Stl, Encoding::Ascii};
constexpr FileKind binary_stl = {FileFormat::Stl, Encoding::BinaryLittleEndian};

std::string stl_complaint(const std::string& content)
{
    return complaint_about("a.stl", content);
}

std::string facet(const std::string& vertices)
{
    return "facet normal 0 0 0\nouter loop\n" + vertices + "endloop\nendfacet\n";
}

const std::string three = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";

template <class Number>
void append(std::string& bytes, Number value)
{
    const auto number = to_bytes(value, std::endian::little);
    bytes.append(number.begin(), number.end());
}

std::string binary(const std::vector<float>& coordinates, const std::string& title = "")
{
    std::string bytes = title;
    bytes.resize(80);
    append(bytes, static_cast<std::uint32_t>(coordinates.size() / 9));
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
        if (k % 9 == 0)
            bytes.append(12, '\x7f');
        append(bytes, coordinates[k]);
        if (k % 9 == 8)
            bytes.append(2, '\x01');
    }
    return bytes;
}

const std::vector<float> one_facet = {0, 0, 0, 1, 0, 0, 0, 1, 0};

}  // namespace

TEST_CASE("STL: equal corners become one vertex in order of appearance, of several solids too")
{
    const auto file = read_text("a.stl", "solid one\n" + facet(three) + "endsolid one\n  SOLID two\r\n" +
                                             facet("  vertex 1 -0 0\n\tVERTEX 0 1.0 0\n vertex 1e0 1 0\n") +
                                             facet("vertex 5 5 5\nvertex 0 1 0\nvertex 1 1 0\n") +
                                             facet("vertex 5 5 5\nvertex 1 1 0\nvertex 1 0 -0\n") + "endsolid two");
    CHECK(file.kind == text_stl);
    CHECK(file.mesh.n_vertices() == 5);
    CHECK(file.mesh.face_vertices == std::vector<Index>{0, 1, 2, 1, 2, 3, 4, 2, 3, 4, 3, 1});
}

TEST_CASE("STL: normals and names are passed over, whatever they are")
{
    const auto mesh = read_text("a.stl", "solid facet vertex # 1\nfacet normal nan -nan(ind) 1.#QNAN\nouter loop\n" +
                                             three + "endloop\nendfacet\nendsolid vertex")
                          .mesh;
    CHECK(identical(mesh, make_triangle()));
}

TEST_CASE("STL: a binary file is known by its size even if it begins with solid")
{
    const auto file = read_text("a.stl", binary(one_facet, "solid thing"));
    CHECK(file.kind == binary_stl);
    CHECK(identical(file.mesh, make_triangle()));
}

TEST_CASE("STL: only padding may follow the facets of a binary file")
{
    const std::string padding("\0\0 \n", 4);
    CHECK(identical(read_text("a.stl", binary(one_facet, "solid") + padding).mesh, make_triangle()));
    CHECK(contains(stl_complaint(binary(one_facet) + padding + "x"), "a.stl: byte 138: the file continues"));
}

TEST_CASE("STL: complaints about text name the line")
{
    CHECK(contains(stl_complaint("solid a\n"), "a.stl:1: the file ends where 'facet or endsolid' should follow"));
    CHECK(contains(stl_complaint("solid a\n" + facet(three)), "a.stl:8: the file ends where 'facet or endsolid'"));
    CHECK(contains(stl_complaint("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
                   "a.stl:4: the file ends where 'vertex' should follow"));
    CHECK(contains(stl_complaint("solid a\nfacte\n"), "a.stl:2: expected 'facet', but found 'facte'"));
    CHECK(
        contains(stl_complaint("solid a\nfacet\nouter\n"), "a.stl:3: expected 'loop', but found the end of the line"));
    CHECK(contains(stl_complaint("solid a\n" + facet(three + "vertex 1 1 0\n") + "endsolid\n"),
                   "a.stl:7: the facet has more than 3 corners"));
    CHECK(contains(stl_complaint("solid a\n" + facet("vertex 0 0 0\nvertex 1 0 0\n") + "endsolid\n"),
                   "a.stl:6: expected 'vertex', but found 'endloop'"));
    CHECK(contains(stl_complaint("solid a\n" + facet("vertex 0 0 0\nvertex 1 0\nvertex 0 1 0\n") + "endsolid\n"),
                   "a.stl:5: expected coordinate z"));
    CHECK(contains(stl_complaint("solid a\n" + facet("vertex 0 0 0\nvertex 1 0 0 9\nvertex 0 1 0\n") + "endsolid\n"),
                   "a.stl:5: expected the end of the line"));
    CHECK(contains(stl_complaint("solid a\n" + facet("vertex 0 0 nan\nvertex 1 0 0\nvertex 0 1 0\n") + "endsolid\n"),
                   "a.stl:4: expected coordinate z, but found 'nan'"));
    CHECK(contains(stl_complaint("solid a\n" + facet("vertex 0 0 0\nvertex 0 0 0\nvertex 0 1 0\n") + "endsolid\n"),
                   "a.stl:8: two corners of the facet have the same coordinates"));
    CHECK(contains(stl_complaint("solid a\nendsolid a\nrubbish"), "a.stl:3: expected 'solid'"));
    CHECK(contains(stl_complaint("solid a\nendsolid a\n"), "the file has no vertices"));
}

TEST_CASE("STL: complaints about binary data name facet and byte")
{
    CHECK(contains(stl_complaint("too short"), "a.stl: byte 9: this is neither text STL"));
    CHECK(contains(stl_complaint(std::string(84, '\0')), "a.stl: byte 84: the file has no vertices"));
    const auto whole = binary(one_facet);
    CHECK(contains(stl_complaint(whole.substr(0, 133)),
                   "a.stl: byte 80: the file announces 1 facet, but its 133 bytes hold"));
    CHECK(contains(stl_complaint(std::string(80, ' ') + "\xff\xff\xff\xff"), "announces 4294967295 facets"));
    auto facets = one_facet;
    facets.insert(facets.end(), {0, 0, 0, 1, 0, 0, std::numeric_limits<float>::infinity(), 0, 0});
    CHECK(contains(stl_complaint(binary(facets)),
                   "a.stl: facet 1 (numbered from 0), byte 170: a coordinate is not a finite"));
    CHECK(contains(stl_complaint(binary({0, 0, 0, 1, 0, 0, 1, -0.0F, 0})), "a.stl: facet 0 (numbered from 0)"));
}

TEST_CASE("STL: coordinates of a binary file may be so large that their sum is none, or too small for a normal float")
{
    constexpr float huge = std::numeric_limits<float>::max();
    constexpr float tiny = std::numeric_limits<float>::denorm_min();
    const auto mesh = read_text("a.stl", binary({huge, huge, huge, -huge, tiny, 0, huge, huge, -tiny,  //
                                                 huge, huge, -tiny, -huge, tiny, -0.0F, huge, huge, 0}))
                          .mesh;
    Points expected(4, 3);
    expected << huge, huge, huge, -huge, tiny, 0, huge, huge, -tiny, huge, huge, 0;
    CHECK(identical(mesh, make_mesh(expected, {{0, 1, 2}, {2, 1, 3}})));
}

TEST_CASE("STL: many vertices are joined again")
{
    PolygonMesh mesh;
    mesh.vertices.resize(5000, 3);
    for (Index v = 0; v < 5000; ++v)
        mesh.vertices.row(v) << v, v % 2, v % 3;
    for (Index v = 0; v + 2 < 5000; ++v)
        mesh.add_face(std::vector<Index>{v, v + 1, v + 2});
    CHECK(identical(round_trip(mesh, "a.stl", text_stl).mesh, mesh));
    CHECK(identical(round_trip(mesh, "a.stl", binary_stl).mesh, mesh));
}

TEST_CASE("STL: what is written")
{
    const TemporaryDirectory folder;
    write_mesh(folder.path() / "a.stl", make_triangle(), text_stl);
    CHECK(content_of(folder.path() / "a.stl") ==
          "solid mesh\nfacet normal 0 0 1\nouter loop\n" + three + "endloop\nendfacet\nendsolid mesh\n");
    write_mesh(folder.path() / "b.stl", make_triangle(), binary_stl);
    const auto bytes = content_of(folder.path() / "b.stl");
    CHECK(bytes.size() == 134);
    CHECK(from_bytes<float>(bytes.data() + 92, std::endian::little) == 1.0F);
}

TEST_CASE("STL: a mesh that it cannot hold is refused before anything is written")
{
    Points points(4, 3);
    points << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
    for (const auto& kind : {text_stl, binary_stl}) {
        CHECK(
            complaint_of_writing(make_mesh(points, {{0, 1, 2}, {0, 1, 2, 3}}), "a.stl", kind) ==
            "a.stl: cannot be written: face 1 (numbered from 0) has 4 sides, but STL holds triangles only; write .obj, "
            ".off or .ply, which can hold this mesh");
        CHECK(complaint_of_writing(make_mesh(points, {{0, 1, 2}}), "a.stl", kind) ==
              "a.stl: cannot be written: vertex 3 (numbered from 0) belongs to no face, and STL holds only vertices of "
              "faces; write .obj, .off or .ply, which can hold this mesh");
    }
}

TEST_CASE("STL: single precision is refused where it is not enough")
{
    auto mesh = make_triangle();
    for (const double x : {1e39, -1e39}) {
        mesh.vertices(1, 0) = x;
        CHECK(complaint_of_writing(mesh, "a.stl", text_stl).empty());
        CHECK(contains(complaint_of_writing(mesh, "a.stl", binary_stl),
                       "vertex 1 (numbered from 0) has a coordinate too large"));
    }
    mesh.vertices(1, 0) = 1e-300;
    const test::TemporaryDirectory folder;
    CHECK(write_mesh(folder / "a.stl", mesh, text_stl).empty());
    // A facet that has become a line is still there.
    for (const double x : {1e-300, 0.0}) {
        mesh.vertices(1, 0) = x;
        const auto remarks = write_mesh(folder / "a.stl", mesh, binary_stl);
        REQUIRE(remarks.size() == 1);
        CHECK(contains(remarks.front(), "1 facet of "));
        CHECK(contains(remarks.front(), "has become a line"));
        CHECK(std::filesystem::file_size(folder / "a.stl") == 84 + 50);
    }
    CHECK(write_mesh(folder / "a.stl", mesh, text_stl).size() == 1);
}

namespace {

/// A text file with names, colours, a facet that is a line, and words as several programs write them.
std::string named_solids(const std::string& end)
{
    std::string text = "solid inlet of the pump\ncolor 1 0 0\n" + facet(three) +
                       "FACET NORMAL 9 9 9\n OUTER LOOP\n  VERTEX 0 0 0\n  VERTEX 0 0 0\n  VERTEX 1 0 0\n END LOOP\n"
                       "END FACET\n end solid inlet\nsolid\tWALL\n" +
                       facet("vertex 1.50 0 0\nvertex 2.5e0 0 0\nvertex 1 1 0\n") + "endsolid WALL\n\n";
    for (std::size_t at = text.find('\n'); end != "\n" && at != text.npos; at = text.find('\n', at + end.size()))
        text.replace(at, 1, end);
    return text;
}

}  // namespace

TEST_CASE("STL: names, colours, digits and facets that are lines stay when positions change")
{
    const TemporaryDirectory folder;
    for (const std::string end : {"\n", "\r\n"}) {
        const std::string text = named_solids(end);
        const auto path = folder.with("a.stl", text);
        FaultLog faults{.of_faces_alone = true};
        MeshFile read = read_faulty_mesh(path, faults);
        REQUIRE(read.mesh.n_faces() == 2);
        REQUIRE(faults.faces_left_out == std::vector<Index>{1});
        CHECK(write_mesh_like(*read.source, folder / "b.stl", read.mesh).empty());
        CHECK(content_of(folder / "b.stl") == text);
        // The second triangle turns about an edge.
        read.mesh.vertices(5, 1) = 0.0;
        read.mesh.vertices(5, 2) = -1.0;
        CHECK(write_mesh_like(*read.source, folder / "b.stl", read.mesh).empty());
        const std::string triangle = "facet normal 0 0 0" + end + "outer loop" + end + "vertex 1.50 0 0";
        CHECK(content_of(folder / "b.stl") == with(with(text, triangle, with(triangle, "normal 0 0 0", "normal 0 1 0")),
                                                   "vertex 1 1 0", "vertex 1 0 -1"));
        CHECK(extras_of(*read.source) == std::vector<std::string>{"names of solids"});
        // One that becomes a line is told of.
        read.mesh.vertices.row(5) = read.mesh.vertices.row(4);
        CHECK(write_mesh_like(*read.source, folder / "b.stl", read.mesh).size() == 1);
        CHECK(contains(content_of(folder / "b.stl"), "vertex 2.5e0 0 0" + end + "vertex 2.5 0 0"));
    }
}

TEST_CASE("STL: title, attributes and facets that are lines stay in binary files, and a normal keeps its side")
{
    const TemporaryDirectory folder;
    std::string file = binary({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 5, 5, 5, 1, 0, 0, 0, 1, 0, 1, 1, 0},
                              "COLOR=\x10\x20\x30\xff of the whole");
    for (std::size_t facet = 0; facet < 3; ++facet) {
        file[84 + 50 * facet + 48] = static_cast<char>(7 + facet);
        file[84 + 50 * facet + 49] = static_cast<char>(0x80 + facet);
    }
    // Against its corners, which turn round a normal downwards.
    const float up = 1.0F;
    std::memcpy(file.data() + 84 + 100 + 8, &up, sizeof up);
    file += "\r\n";
    const auto path = folder.with("a.stl", file);
    FaultLog faults{.of_faces_alone = true};
    MeshFile read = read_faulty_mesh(path, faults);
    REQUIRE(read.mesh.n_faces() == 2);
    CHECK(write_mesh_like(*read.source, folder / "b.stl", read.mesh).empty());
    CHECK(content_of(folder / "b.stl") == file);
    CHECK(extras_of(*read.source) == std::vector<std::string>{"colours of the header", "attributes of facets"});
    read.mesh.vertices.col(0) *= 0.5;
    CHECK(write_mesh_like(*read.source, folder / "b.stl", read.mesh).empty());
    const std::string written = content_of(folder / "b.stl");
    REQUIRE(written.size() == file.size());
    CHECK(written.substr(0, 84) == file.substr(0, 84));
    // The line, the attributes, and what follows.
    CHECK(written.substr(84 + 50, 50) == file.substr(84 + 50, 50));
    for (std::size_t facet = 0; facet < 3; ++facet)
        CHECK(written.substr(84 + 50 * facet + 48, 2) == file.substr(84 + 50 * facet + 48, 2));
    CHECK(written.substr(written.size() - 2) == "\r\n");
    const auto number = [&](std::size_t facet, std::size_t k) {
        return from_bytes<float>(written.data() + 84 + 50 * facet + 4 * k, std::endian::little);
    };
    CHECK(number(0, 2) == 1.0F);
    CHECK(number(2, 2) == 1.0F);
    CHECK(number(0, 6) == 0.5F);
    FaultLog again{.of_faces_alone = true};
    CHECK(identical(read_faulty_mesh(folder / "b.stl", again).mesh, read.mesh));
}

TEST_CASE("STL: files in many slices are written like small ones")
{
    const TemporaryDirectory folder;
    for (const FileKind& kind : {text_stl, binary_stl}) {
        write_mesh(folder / "a.stl", make_triangles(20'000), kind);
        const Index n_faces = read_mesh(folder / "a.stl").mesh.n_faces();
        // Before all others comes a facet that is a line.
        std::string content = content_of(folder / "a.stl");
        const bool is_text = content.starts_with("solid");
        const std::string line = is_text ? facet("vertex 0 0 0\nvertex 0 0 0\nvertex 5 5 5\n")
                                         : binary({0, 0, 0, 0, 0, 0, 5, 5, 5}).substr(84);
        content.insert(is_text ? content.find('\n') + 1 : 84, line);
        if (!is_text)
            content[80] = static_cast<char>(content[80] + 1);
        const auto path = folder.with("a.stl", content);
        FaultLog faults{.of_faces_alone = true};
        MeshFile read = read_faulty_mesh(path, faults);
        REQUIRE(read.mesh.n_faces() == n_faces);
        CHECK(write_mesh_like(*read.source, folder / "b.stl", read.mesh).empty());
        CHECK(content_of(folder / "b.stl") == content_of(folder / "a.stl"));
        read.mesh.vertices = 0.5 * read.mesh.vertices;
        CHECK(write_mesh_like(*read.source, folder / "b.stl", read.mesh).empty());
        CHECK(identical(read_faulty_mesh(folder / "b.stl", faults).mesh, read.mesh));
    }
}
