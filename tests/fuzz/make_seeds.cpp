// Makes the files that fuzzing begins with: make_seeds DIRECTORY. For each harness there is a folder there with files
// that show what its format has; DIRECTORY/NAME.dict lists words of it.

#include <array>
#include <bit>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "partition/formats/gltf_content.h"
#include "partition/formats/mesh_io.h"
#include "partition/formats/palette.h"
#include "partition/io/byte_order.h"
#include "tests/fuzz/seeds.h"
#include "tests/support/gltf_files.h"

namespace {

using namespace seamflow;
using namespace seamflow::test;

/// Faces of three, four and five corners, with a vertex that has none.
PolygonMesh house()
{
    PolygonMesh mesh;
    mesh.vertices.resize(7, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0.125, 0, 1, -1e-3, 0.5, 1.5, 1e20, 0.5, -2, 0.1, 7, 7, 7;
    mesh.add_face(std::array<Index, 5>{0, 1, 2, 4, 3});
    mesh.add_face(std::array<Index, 3>{1, 0, 5});
    mesh.add_face(std::array<Index, 4>{0, 3, 4, 5});
    return mesh;
}

PolygonMesh two_triangles()
{
    PolygonMesh mesh;
    mesh.vertices.resize(4, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0.5, 1, 1, 0, 0, 1.25, 0;
    mesh.add_face(std::array<Index, 3>{0, 1, 2});
    mesh.add_face(std::array<Index, 3>{0, 2, 3});
    return mesh;
}

void make_obj(const std::filesystem::path& root)
{
    const Seeds seeds(root, "obj");
    write_mesh(seeds.path("house.obj"), house(), {FileFormat::Obj, Encoding::Ascii});
    seeds.add("all.obj",
              "# a comment \\\nmtllib a.mtl\no thing\ng one two\ns 1\nusemtl red\n"
              "v 0 0 0 0.5 0.5 0.5\nv 1e0 +0.0 -0\nv .5 1. 0 1\nvt 0 0\nvt 1 0 0\nvn 0 0 1\nvn 1 0 0\nvp 1 2\n"
              "f 1/1/1 2/2/1 3/1/2\nf -3//-1 -1//-1 -2//-1\nl 1 2 3\np 1\n");
    seeds.add("lines.obj", "v 0 0 0\r\nv 1 0 0\r\nv 0 \\\r\n 1 0\r\n\r\nf 1 \\\r\n 2 3");
    seeds.words({"v ",
                 "vn ",
                 "vt ",
                 "vp ",
                 "f ",
                 "l ",
                 "p ",
                 "g ",
                 "o ",
                 "s off",
                 "usemtl ",
                 "mtllib ",
                 "\\\\\\x0a",
                 "\\x0d\\x0a",
                 "//",
                 "/",
                 "-1",
                 "2147483647",
                 "9223372036854775808",
                 "1e309",
                 "nan",
                 "inf",
                 "0x1p3",
                 "# ",
                 "curv ",
                 "call "});
}

void make_off(const std::filesystem::path& root)
{
    const Seeds seeds(root, "off");
    write_mesh(seeds.path("house.off"), house(), {FileFormat::Off, Encoding::Ascii});
    seeds.add("colours.off",
              "COFF # colours\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 1 1\n3 0 1 2 1 0 0\n");
    seeds.add("normals.off", "STCNOFF\n3 1 3\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1 1 1 1 1 1 0\n"
                             "0 1 0 0 0 1 1 1 1 1 0 1\n3 0 1 2\n");
    seeds.add("bare.off", "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    std::string binary = "OFF BINARY\n";
    const auto append = [&binary](auto number) {
        for (const char byte : to_bytes(number, std::endian::big))
            binary += byte;
    };
    for (const std::int32_t count : {3, 1, 0})
        append(count);
    for (const float x : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.5F})
        append(x);
    for (const std::int32_t number : {3, 0, 1, 2, 1, 7})
        append(number);
    seeds.add("binary.off", binary);
    seeds.words({"OFF", "OFF BINARY\\x0a", "COFF", "NOFF", "STOFF", "4OFF", "nOFF", "4nOFF", "# ", "2147483647",
                 "4294967296", "1e309", "nan", "-1", "\\xff\\xff\\xff\\x7f", "\\x7f\\xff\\xff\\xff"});
}

void make_ply(const std::filesystem::path& root)
{
    const Seeds seeds(root, "ply");
    write_mesh(seeds.path("text.ply"), house(), {FileFormat::Ply, Encoding::Ascii});
    write_mesh(seeds.path("little.ply"), house(), {FileFormat::Ply, Encoding::BinaryLittleEndian});
    write_mesh(seeds.path("big.ply"), house(), {FileFormat::Ply, Encoding::BinaryBigEndian});
    write_labelled_ply(seeds.path("labels.ply"), two_triangles(), std::vector<Index>{0, 3});
    const std::string more =
        "comment made for trying\nobj_info none\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property double z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
        "element face 1\nproperty list uchar short vertex_indices\nproperty list uint float texcoord\n"
        "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n";
    seeds.add("more.ply", "ply\nformat ascii 1.0\n" + more +
                              "0 0 0 0 0 1 255\n1 0 0 0 0 1 9\n0 1 0.5 0 0 1 0\n3 0 1 2 2 0.5 0.25\n0 1\n");
    seeds.add("integers.ply", "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty int8 x\r\nproperty uint16 y\r\n"
                              "property int32 z\r\nelement face 1\r\nproperty list uint8 uint32 vertex_index\r\n"
                              "end_header\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n");
    seeds.add("tiny.ply", std::string("ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\n"
                                      "property char y\nproperty float z\nelement face 1\n"
                                      "property list uchar uchar vertex_indices\nend_header\n") +
                              std::string("\0\0\0\0\0\0\1\0\0\0\0\0\0\1\0\0\0\0\3\0\1\2", 22));
    seeds.words({"ply\\x0a",
                 "format ascii 1.0\\x0a",
                 "format binary_little_endian 1.0\\x0a",
                 "format binary_big_endian 1.0\\x0a",
                 "element vertex ",
                 "element face ",
                 "element edge ",
                 "element tristrips ",
                 "property float x\\x0a",
                 "property double y\\x0a",
                 "property uchar z\\x0a",
                 "property list uchar int vertex_indices\\x0a",
                 "property list uint uint vertex_index\\x0a",
                 "property list float int vertex_indices\\x0a",
                 "property float nx\\x0a",
                 "comment ",
                 "obj_info ",
                 "end_header\\x0a",
                 "\\x0d\\x0a",
                 "4294967295",
                 "2147483647",
                 "18446744073709551615",
                 "nan",
                 "1e309",
                 "\\xff\\xff\\xff\\xff",
                 "\\x00\\x00\\xc0\\x7f"});
}

void make_stl(const std::filesystem::path& root)
{
    const Seeds seeds(root, "stl");
    write_mesh(seeds.path("text.stl"), two_triangles(), {FileFormat::Stl, Encoding::Ascii});
    write_mesh(seeds.path("binary.stl"), two_triangles(), {FileFormat::Stl, Encoding::BinaryLittleEndian});
    seeds.add("spaces.stl",
              "  SOLID a name\n\tFacet Normal 0 0 1\nouter\nloop\nvertex 0 0 0 vertex 1 0 0\nvertex 0 1 0\n"
              "endloop endfacet\nendsolid a name\nsolid\nendsolid\n");
    seeds.words({"solid ", "endsolid", "facet normal ", "outer loop", "vertex ", "endloop", "endfacet", "nan", "1e309",
                 "1e39", "-0", "\\x02\\x00\\x00\\x00", "\\xff\\xff\\xff\\xff", "\\x00\\x00\\xc0\\x7f",
                 "\\x00\\x00\\x80\\x7f"});
}

void make_gltf(const std::filesystem::path& root)
{
    const Seeds binary(root, "glb");
    const Seeds text(root, "gltf");
    write_mesh(binary.path("plain.glb"), two_triangles(), {FileFormat::Glb, Encoding::BinaryLittleEndian});
    write_mesh(text.path("plain.gltf"), two_triangles(), {FileFormat::Gltf, Encoding::BinaryLittleEndian});
    GltfMaker maker;
    const int view = maker.view(bytes_of(std::vector<float>{0, 0, 0, 0, 0, 1, 1, 0, 0.5F, 0, 0, 1, 0, 1, 0, 0, 0, 1}),
                                R"("byteStride":24)");
    const std::string attributes =
        fmt::format(R"("attributes":{{"POSITION":{},"NORMAL":{}}})",
                    maker.accessor(view, 5126, 3, "VEC3", R"("min":[0,0,0],"max":[1,1,0.5])"),
                    maker.accessor(view, 5126, 3, "VEC3", R"("byteOffset":12)"));
    const int bytes = maker.indices(std::vector<unsigned char>{0, 1, 2});
    const int shorts = maker.indices(std::vector<unsigned short>{0, 1, 2, 2, 0});
    maker.mesh({fmt::format(R"({{{},"indices":{}}})", attributes, bytes), "{" + attributes + R"(,"mode":6})",
                fmt::format(R"({{{},"indices":{},"mode":5,"targets":[{{"POSITION":0}}]}})", attributes, shorts)});
    maker.mesh({"{" + attributes + R"(,"mode":0})"});
    maker.more = R"("nodes":[{"mesh":0}],"skins":[{}])";
    binary.add("all.glb", maker.glb());
    const std::string data = gltf_data("data:application/octet-stream;base64", maker.bytes());
    text.add("all.gltf", maker.text(data));
    binary.add("data.glb", GltfMaker::glb(maker.text(data), "chunk"));
    GltfMaker sparse;
    sparse.indices(std::vector<unsigned char>{0, 1, 2});
    for (const int base : {sparse.view(bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0})), -1})
        sparse.accessor(base, 5126, 3, "VEC3",
                        sparse.sparse(std::vector<unsigned char>{1, 2}, {2, 0, 0, 0, 2, 0}) + R"(,"min":[0,0,0])");
    sparse.mesh({R"({"attributes":{"POSITION":1,"NORMAL":2},"indices":0})"});
    binary.add("sparse.glb", sparse.glb());
    const std::vector<std::string> words = {R"(\"accessors\":[)",
                                            R"(\"attributes\":{)",
                                            R"(\"bufferView\":)",
                                            R"(\"bufferViews\":[)",
                                            R"(\"buffers\":[)",
                                            R"(\"byteLength\":)",
                                            R"(\"byteOffset\":)",
                                            R"(\"byteStride\":4)",
                                            R"(\"componentType\":5126)",
                                            R"(\"count\":)",
                                            R"(\"indices\":)",
                                            R"(\"max\":[)",
                                            R"(\"meshes\":[)",
                                            R"(\"min\":[)",
                                            R"(\"mode\":5)",
                                            R"(\"NORMAL\":)",
                                            R"(\"POSITION\":)",
                                            R"(\"primitives\":[)",
                                            R"(\"sparse\":{)",
                                            R"(\"type\":\"VEC3\")",
                                            R"(\"uri\":\"data:;base64,)",
                                            "5121",
                                            "5123",
                                            "5125",
                                            "9007199254740992",
                                            "1e300"};
    binary.words(words);
    text.words(words);
}

void make_lists(const std::filesystem::path& root)
{
    const Seeds labels(root, "labels");
    labels.add("four.txt", "0\n1 # a comment\n\n  1\r\n2");
    labels.add("one.txt", "0\n");
    labels.words({"2147483647", "2147483648", "-1", "# ", "\\x0d\\x0a", "0.5", "+1"});
    const Seeds sets(root, "vertex_set");
    sets.add("list.txt", "# which\n0\n4\n 2 # again\n2\r\n");
    sets.add("text.ply",
             "ply\nformat ascii 1.0\nelement vertex 5\nproperty float locked\nend_header\n0\n1\n0\nnan\n2\n");
    sets.add("binary.ply", std::string("ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty uchar red\n"
                                       "property uchar locked\nend_header\n\7\0\7\1\7\0\7\1\7\1",
                                       115));
    sets.words({"ply\\x0a", "format ascii 1.0\\x0a", "element vertex 5\\x0a", "property uchar locked\\x0a",
                "property list uchar int locked\\x0a", "end_header\\x0a", "2147483648", "-1", "# "});
}

}  // namespace

int main(int n, char** arguments)
{
    if (n != 2) {
        std::fprintf(stderr, "usage: make_seeds DIRECTORY\n");
        return 2;
    }
    try {
        const std::filesystem::path root = arguments[1];
        make_obj(root);
        make_off(root);
        make_ply(root);
        make_stl(root);
        make_gltf(root);
        make_lists(root);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_seeds: %s\n", error.what());
        return 1;
    }
}
