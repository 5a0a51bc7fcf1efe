#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/formats/edge_files.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

std::vector<Edge> edges_of(const char* name, const std::string& content)
{
    const TemporaryDirectory directory;
    return read_edges(directory.with(name, content), 6);
}

std::string refusal_of(const char* name, const std::string& content)
{
    const std::string text = message_of<InputError>([&] { (void)edges_of(name, content); });
    return text.substr(text.rfind('/') + 1);
}

}  // namespace

TEST_CASE("edges are read from pairs, from polylines of OBJ and from edges of PLY")
{
    CHECK(edges_of("a.txt", "# two\n0 1\n\n 5 2 # last\n") == std::vector<Edge>{{0, 1}, {5, 2}});
    CHECK(edges_of("none", "# nothing\n").empty());
    CHECK(edges_of("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2/7 3\nv 0 1 0\nv 0 0 1\nl -1 -4\nf 1 2 3\nl 6 \\\n5\n") ==
          std::vector<Edge>{{0, 1}, {1, 2}, {3, 0}, {5, 4}});
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nelement edge 2\n"
                            "property uchar red\nproperty int vertex2\nproperty list uchar int more\n"
                            "property int vertex1\nend_header\n7\n8\n";
    CHECK(edges_of("a.ply", ply + "255 3 2 9 9 4\n0 0 0 5\n") == std::vector<Edge>{{4, 3}, {5, 0}});
    const std::string binary = "ply\nformat binary_big_endian 1.0\nelement edge 1\nproperty ushort vertex1\n"
                               "property uchar vertex2\nend_header\n";
    CHECK(edges_of("a.ply", binary + std::string("\0\5\2", 3)) == std::vector<Edge>{{5, 2}});
}

TEST_CASE("what is no edge is refused with the line and what to do")
{
    CHECK(refusal_of("a.txt", "0 1\n2 6\n")
              .starts_with("a.txt:2: there is no vertex 6: the mesh has 6, numbered from 0"));
    CHECK(refusal_of("a.txt", "-1 1\n").starts_with("a.txt:1: there is no vertex -1"));
    CHECK(refusal_of("a.txt", "3 3\n").starts_with("a.txt:1: names vertex 3 twice"));
    CHECK(refusal_of("a.txt", "0 1 2\n").starts_with("a.txt:1: the line continues"));
    CHECK(refusal_of("a.txt", "0\n").starts_with("a.txt:1: "));
    CHECK(refusal_of("a.txt", "0 x\n").starts_with("a.txt:1: "));
    CHECK(refusal_of("a.obj", "l 1 7\n").starts_with("a.obj:1: there is no vertex 7: the mesh has 6, numbered from 1"));
    CHECK(refusal_of("a.obj", "l 0 1\n").starts_with("a.obj:1: there is no vertex 0"));
    for (const std::string number : {"-2", "-2147483649", "-3000000000", "-4294967296"})
        CHECK(
            refusal_of("a.obj", "v 0 0 0\nl " + number + " 1\n")
                .starts_with("a.obj:2: names vertex " + number + ", counted back from this line, but only 1 vertex "));
    for (const std::string number : {"2147483649", "3000000000", "4294967297"})
        CHECK(refusal_of("a.obj", "l 1 " + number + "\n").starts_with("a.obj:1: there is no vertex " + number + ": "));
    CHECK(refusal_of("a.obj", "v 0 0 0\n").starts_with("a.obj: the file has no edges of its own: lines l"));
    CHECK(refusal_of("a.off", "OFF\n").starts_with("a.off: the format has no edges"));
    CHECK(refusal_of("a.stl", "solid\n").starts_with("a.stl: the format has no edges"));
    CHECK(refusal_of("a.glb", "glTF").starts_with("a.glb: the format has no edges"));
    const std::string ply = "ply\nformat ascii 1.0\nelement edge 1\nproperty int vertex1\n";
    CHECK(refusal_of("a.ply", ply + "end_header\n1\n")
              .starts_with("a.ply:3: the edges have no integer property vertex2"));
    CHECK(
        refusal_of("a.ply", ply + "property float vertex2\nend_header\n1 2\n").starts_with("a.ply:3: the edges have"));
    CHECK(refusal_of("a.ply", ply + "property int vertex2\nend_header\n1 9\n")
              .starts_with("a.ply:7: there is no vertex 9"));
    CHECK(refusal_of("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n")
              .starts_with("a.ply: the file has no edges of its own: elements edge"));
}
