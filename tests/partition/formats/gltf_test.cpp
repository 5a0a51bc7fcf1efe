#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "partition/errors.h"
#include "partition/formats/gltf.h"
#include "partition/formats/gltf_content.h"
#include "partition/formats/mesh_io.h"
#include "partition/topology.h"
#include "partition/weld.h"
#include "tests/support/gltf_files.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// A square of two triangles, 0 1 2 and 0 2 3.
const std::vector<float> square = {0, 0, 0, 1, 0, 0.1F, 1, 1, 0, 0, 1, 0};
const std::vector<float> upwards = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
const std::vector<unsigned short> two_triangles = {0, 1, 2, 0, 2, 3};

using Faces = std::vector<std::vector<Index>>;

Faces faces_of(const PolygonMesh& mesh)
{
    Faces faces;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        faces.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
    return faces;
}

/// @param indices -1: none.
std::string primitive(int positions, int indices, const std::string& more = "", int normals = -1)
{
    return fmt::format(R"({{"attributes":{{"POSITION":{}{}}}{}{}}})", positions,
                       normals < 0 ? "" : fmt::format(R"(,"NORMAL":{})", normals),
                       indices < 0 ? "" : fmt::format(R"(,"indices":{})", indices), more.empty() ? "" : "," + more);
}

/// The square with normals.
GltfMaker made_square()
{
    GltfMaker maker;
    const int positions = maker.vectors(square);
    const int normals = maker.vectors(upwards);
    maker.mesh({primitive(positions, maker.indices(two_triangles), "", normals)});
    return maker;
}

std::string complaint_about_glb(const std::string& text, const std::string& bytes)
{
    return complaint_about("a.glb", GltfMaker::glb(text, bytes));
}

/// What a file says of an accessor.
nlohmann::json accessor_in(const std::string& glb, std::size_t i)
{
    const std::size_t length = glb.find("BIN", 20) - 24;
    return nlohmann::json::parse(glb.substr(20, length))["accessors"][i];
}

/// The text without the bounds of accessors.
std::string without_bounds(std::string text)
{
    for (const char* const bound : {R"("min":[)", R"("max":[)"})
        for (auto at = text.find(bound); at != std::string::npos; at = text.find(bound, at + 1))
            text.erase(at + 7, text.find(']', at) - at - 7);
    return text;
}

}  // namespace

TEST_CASE("indices of every width, and none, in triangles, strips and fans, give the same faces")
{
    // The first corner of each triangle of a strip is that of the same number.
    const Faces expected = {{0, 1, 2}, {1, 3, 2}};
    const std::vector<float> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    for (const int width : {1, 2, 4})
        for (const bool is_strip : {false, true}) {
            CAPTURE(width);
            const std::vector<unsigned> numbers =
                is_strip ? std::vector<unsigned>{0, 1, 2, 3} : std::vector<unsigned>{0, 1, 2, 1, 3, 2};
            GltfMaker maker;
            const int positions = maker.vectors(points);
            const int indices = width == 1 ? maker.indices(std::vector<unsigned char>(numbers.begin(), numbers.end()))
                                : width == 2
                                    ? maker.indices(std::vector<unsigned short>(numbers.begin(), numbers.end()))
                                    : maker.indices(numbers);
            maker.mesh({primitive(positions, indices, is_strip ? R"("mode":5)" : "")});
            CHECK(faces_of(read_text("a.glb", maker.glb()).mesh) == expected);
        }
    GltfMaker strip;
    strip.mesh({primitive(strip.vectors(points), -1, R"("mode":5)")});
    CHECK(faces_of(read_text("a.glb", strip.glb()).mesh) == expected);
    GltfMaker fan;
    fan.mesh({primitive(fan.vectors(square), -1, R"("mode":6)")});
    CHECK(faces_of(read_text("a.glb", fan.glb()).mesh) == Faces{{1, 2, 0}, {2, 3, 0}});
    GltfMaker triangle;
    triangle.mesh({primitive(triangle.vectors({0, 0, 0, 1, 0, 0, 0, 1, 0}), -1)});
    CHECK(faces_of(read_text("a.glb", triangle.glb()).mesh) == Faces{{0, 1, 2}});
}

TEST_CASE("the indices of bytes reach 255, and those of two bytes 65535")
{
    std::vector<float> points(3 * 65536, 0.0F);
    for (std::size_t v = 0; v < 65536; ++v)
        points[3 * v] = static_cast<float>(v);
    GltfMaker maker;
    const int positions = maker.vectors(points);
    maker.mesh({primitive(positions, maker.indices(std::vector<unsigned char>{0, 128, 255})),
                primitive(positions, maker.indices(std::vector<unsigned short>{0, 32768, 65535}))});
    CHECK(faces_of(read_text("a.glb", maker.glb()).mesh) == Faces{{0, 128, 255}, {0, 32768, 65535}});
}

TEST_CASE("strips joined by triangles without area lose these, and nothing else")
{
    GltfMaker maker;
    const int positions = maker.vectors(square);
    maker.mesh({primitive(positions, maker.indices(std::vector<unsigned short>{0, 1, 2, 2, 2, 3, 0}), R"("mode":5)")});
    CHECK(faces_of(read_text("a.glb", maker.glb()).mesh) == Faces{{0, 1, 2}, {2, 3, 0}});
}

TEST_CASE("primitives that share positions share vertices, and alike ones are one, whatever accessor names them")
{
    GltfMaker maker;
    const int view = maker.view(bytes_of(square));
    const int all = maker.accessor(view, 5126, 4, "VEC3");
    const int again = maker.accessor(view, 5126, 4, "VEC3");
    const int last_three = maker.accessor(view, 5126, 3, "VEC3", R"("byteOffset":12)");
    const int indices = maker.indices(two_triangles);
    const int others = maker.vectors(square);
    maker.mesh({primitive(all, indices), primitive(again, indices)});
    maker.mesh({primitive(last_three, -1), primitive(all, indices), primitive(others, indices)});
    const PolygonMesh mesh = read_text("a.glb", maker.glb()).mesh;
    CHECK(mesh.n_vertices() == 8);
    CHECK(faces_of(mesh) == Faces{{0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {4, 5, 6}, {4, 6, 7}});
}

TEST_CASE("every vertex lies where the file says, also between other data")
{
    // Of each vertex 28 bytes: something, the position, something.
    std::string bytes;
    for (std::size_t v = 0; v < 4; ++v)
        bytes += std::string(8, static_cast<char>('a' + v)) +
                 bytes_of(std::vector<float>(square.begin() + 3 * v, square.begin() + 3 * (v + 1))) +
                 std::string(8, '#');
    GltfMaker maker;
    const int view = maker.view(bytes, R"("byteStride":28)");
    const int positions =
        maker.accessor(view, 5126, 4, "VEC3", R"("byteOffset":8,"min":[0,0,0.0],"max":[1,1.0,0.10000000149011612])");
    maker.mesh({primitive(positions, maker.indices(two_triangles))});
    const std::string file = maker.glb();
    const MeshFile read = read_text("a.glb", file);
    for (Index v = 0; v < 4; ++v)
        for (Index k = 0; k < 3; ++k)
            CHECK(read.mesh.vertices(v, k) == double{square[usize(3 * v + k)]});
    const Rewritten moved = rewritten("a.glb", file, [](Points& points) { points.row(2) << 1, 2, -0.25; });
    CHECK(moved.remarks.empty());
    const std::string text = with(with(maker.text(), R"("min":[0,0,0.0])", R"("min":[0,0,-0.25])"), "1.0,0.1", "2,0.1");
    const std::string place = bytes_of(std::vector<float>{1, 1, 0});
    CHECK(moved.content ==
          GltfMaker::glb(text, with(maker.bytes(), place, bytes_of(std::vector<float>{1, 2, -0.25F}))));
}

TEST_CASE("a file whose vertices stay is the same file, with anything in it")
{
    GltfMaker maker = made_square();
    const int points = maker.vectors({5, 5, 5});
    const int colours =
        maker.accessor(maker.view("\1\2\3\4\5\6\7\10\11\12\13\14"), 5121, 4, "VEC3", R"("normalized":true)");
    maker.mesh({primitive(points, -1, R"("mode":0)"), fmt::format(R"({{"attributes":{{"COLOR_0":{},"POSITION":0}},)"
                                                                  R"("mode":1,"extras":"\u00e4 \" ]}}"}})",
                                                                  colours)});
    maker.more =
        R"("materials":[{"name":"\\\"}"}], "nodes" : [{"mesh":0,"scale":[1.50,2e0,-0]}],"empty":[ ],"none":{})";
    const Rewritten same = rewritten("a.glb", maker.glb(), stay_put);
    CHECK(same.content == maker.glb());
    CHECK(same.remarks.empty());
    // Also with a text that is filled up with zeros and what is no JSON, and with bytes behind the file.
    const std::string filled = GltfMaker::glb(maker.text() + std::string("\0\0}}]", 5), maker.bytes());
    CHECK(rewritten("a.glb", filled, stay_put).content == filled);
    std::string odd = GltfMaker::glb(maker.text(), maker.bytes()) + "behind";
    CHECK(rewritten("a.glb", odd, stay_put).content == odd);
    const std::string moved = rewritten("a.glb", odd, [](Points& p) { p(1, 2) = 12345.678; }).content;
    CHECK(moved.ends_with("behind"));
    CHECK(without_bounds(moved.substr(20, moved.find("BIN", 20) - 24)).starts_with(without_bounds(maker.text())));
    CHECK(read_text("a.glb", moved).mesh.vertices(1, 2) == double{12345.678F});
}

TEST_CASE("bounds are those of the bytes, for every accessor that shows them, and others stay as they are written")
{
    GltfMaker maker = made_square();
    // Points of the same vertices, the bounds of which are one number, and two lists that are no bounds.
    const int first_two = maker.accessor(0, 5126, 2, "VEC3", R"("min":[0.00,0,0],"max":[1,0,0.10000000149011612])");
    const int no_bounds = maker.accessor(0, 5126, 4, "VEC3", R"("min":[],"max":{"0":1})");
    maker.mesh({primitive(first_two, -1, R"("mode":0)"), primitive(no_bounds, -1, R"("mode":0)")});
    const Rewritten moved = rewritten("a.glb", maker.glb(), [](Points& points) {
        points.row(0) << 0.25, -0.0, 1e-10;
        points.row(2) << -7, 0.1, 3e20;
    });
    const auto numbers = [&](std::size_t i, const char* bound) {
        return accessor_in(moved.content, i)[bound].get<std::vector<double>>();
    };
    CHECK(numbers(0, "min") == std::vector<double>{-7, 0, 0});
    CHECK(numbers(0, "max") == std::vector<double>{1, 1, double{3e20F}});
    CHECK(numbers(3, "min") == std::vector<double>{0.25, 0, double{1e-10F}});
    CHECK(numbers(3, "max") == std::vector<double>{1, 0, double{0.1F}});
    CHECK(accessor_in(moved.content, 4)["max"].dump() == R"({"0":1})");
    CHECK(contains(moved.content, R"("min":[0.25,0,)"));
}

TEST_CASE("normals follow the surface; those that belong to several vertices stay, with a remark")
{
    const auto tilt = [](Points& points) { points.col(2) = points.col(0); };
    const Rewritten tilted = rewritten("a.glb", made_square().glb(), tilt);
    CHECK(tilted.remarks.empty());
    const float half = std::sqrt(0.5F);
    const std::string normals =
        bytes_of(std::vector<float>{-half, 0, half, -half, 0, half, -half, 0, half, -half, 0, half});
    CHECK(contains(tilted.content, normals));
    CHECK(accessor_in(tilted.content, 1)["max"][2].get<double>() == double{half});

    GltfMaker shared;
    const int normals_of_both = shared.vectors(upwards);
    const int indices = shared.indices(two_triangles);
    shared.mesh({primitive(shared.vectors(square), indices, "", normals_of_both),
                 primitive(shared.vectors(square), indices, "", normals_of_both)});
    const Rewritten stays = rewritten("a.glb", shared.glb(), tilt);
    CHECK(stays.remarks ==
          std::vector<std::string>{"the normals that belong to several vertices of a.glb stay as they were"});
    CHECK(contains(stays.content, bytes_of(upwards)));

    GltfMaker sphere;
    const int both = sphere.vectors(square);
    sphere.mesh({primitive(both, sphere.indices(two_triangles), "", both)});
    CHECK(rewritten("a.glb", sphere.glb(), tilt).remarks.size() == 1);
}

TEST_CASE("vertices that are split between two primitives are joined along the seam")
{
    GltfMaker maker;
    const int indices = maker.indices(std::vector<unsigned char>{0, 1, 2});
    maker.mesh({primitive(maker.vectors({0, 0, 0, 1, 0, 0, 1, 1, 0}), indices),
                primitive(maker.vectors({0, 0, 0, 1, 1, 0, 0, 1, 0}), indices)});
    const PolygonMesh mesh = read_text("a.glb", maker.glb()).mesh;
    const auto joined = weld(mesh, make_topology(mesh), 0.0);
    REQUIRE(joined);
    CHECK(joined->n_edges == 1);
    CHECK(joined->n_vertices == 4);
}

TEST_CASE("normals stay continuous across a seam that is joined although it gapes")
{
    GltfMaker maker;
    const int indices = maker.indices(std::vector<unsigned char>{0, 1, 2});
    // The normals at the seam are between those of the two faces.
    const int left = maker.vectors({0, 0, 0, 1, 0, 0.5F, 1, 1, 0});
    const int left_normals = maker.vectors({-0.24F, 0.24F, 0.94F, 0, 0, 1, -0.24F, 0.24F, 0.94F});
    const int right = maker.vectors({0, 0.01F, 0, 1, 1.01F, 0, 0, 1, 0});
    maker.mesh({primitive(left, indices, "", left_normals),
                primitive(right, indices, "", maker.vectors({-0.24F, 0.24F, 0.94F, -0.24F, 0.24F, 0.94F, 0, 0, 1}))});
    const TemporaryDirectory folder;
    MeshFile file = read_mesh(folder.with("a.glb", maker.glb()));
    file.mesh.vertices(1, 2) = 1.0;
    for (const double gap : {0.0, 0.1}) {
        write_mesh_like(*file.source, folder / "b.glb", file.mesh, run_serially, gap);
        const nlohmann::json view = nlohmann::json::parse(maker.text())["bufferViews"];
        const std::string now = content_of(folder / "b.glb");
        const std::size_t chunk = now.find("BIN") + 4;
        const auto normal = [&](std::size_t list, std::size_t i) {
            return now.substr(chunk + view[list]["byteOffset"].get<std::size_t>() + 12 * i, 12);
        };
        // Of the right triangle, which has not moved, the first two lie on the seam.
        CHECK((normal(2, 0) == normal(4, 0)) == (gap > 0.0));
        CHECK((normal(2, 2) == normal(4, 1)) == (gap > 0.0));
        CHECK(normal(4, 2) == bytes_of(std::vector<float>{0, 0, 1}));
    }
}

TEST_CASE("of members with the same name the last one counts, and is the one that changes")
{
    const GltfMaker maker = made_square();
    const std::string text = with(maker.text(), R"("count":4)", R"("count":3,"co\u0075nt":4,"min":[9,9,9])");
    const std::string file = GltfMaker::glb(text, maker.bytes());
    CHECK(read_text("a.glb", file).mesh.n_vertices() == 4);
    const std::string moved = rewritten("a.glb", file, [](Points& points) { points(0, 0) = -2.0; }).content;
    CHECK(contains(moved, R"("min":[9,9,9],)"));
    CHECK(accessor_in(moved, 0)["min"] == nlohmann::json::parse("[-2,0,0]"));
}

TEST_CASE("what is kept as it was is named: morph targets, skins, tangents, other normals")
{
    GltfMaker maker;
    const int positions = maker.vectors(square);
    const int four = maker.accessor(maker.view(std::string(64, '\1')), 5126, 4, "VEC4");
    const int bytes = maker.accessor(maker.view(std::string(16, '\1'), R"("byteStride":4)"), 5120, 4, "VEC3");
    maker.mesh(
        {fmt::format(R"({{"attributes":{{"POSITION":{},"TANGENT":{},"NORMAL":{}}},"targets":[{{"POSITION":0}}]}})",
                     positions, four, bytes)});
    maker.more = R"("skins":[{"joints":[0]}])";
    std::string file = maker.glb();
    // Four corners are no triangles.
    CHECK(complaint_about("a.glb", file) == "a.glb: meshes[0].primitives[0].attributes.POSITION: has 4 corners, which "
                                            "are not three for each triangle; export the mesh again");
    file = with(file, R"("targets")", R"("mode":5,"targets")");
    file = GltfMaker::glb(with(maker.text(), R"("targets")", R"("mode":5,"targets")"), maker.bytes());
    const Rewritten moved = rewritten("a.glb", file, [](Points& points) { points(0, 0) = 0.1; });
    CHECK(moved.remarks ==
          std::vector<std::string>{
              "the normals that are not in single precision, once for each vertex, of a.glb stay as they were",
              "the tangents of a.glb stay as they were",
              "the morph targets (differences from the positions) of a.glb stay as they were",
              "the skins (joints and weights) of a.glb stay as they were",
              "a.glb holds positions in single precision, and so does the result; text formats (.obj or .off) keep all "
              "digits"});
}

TEST_CASE("a file names its buffer beside it: the result gets a new one, and that of the input stays")
{
    const TemporaryDirectory folder;
    const std::filesystem::path there = folder / "other place";
    std::filesystem::create_directory(there);
    GltfMaker maker = made_square();
    maker.more = R"("images":[{"uri":"wood.png"}])";
    const std::string text = maker.text("my%20square.bin");
    const auto input = folder.with("a.gltf", text);
    const auto buffer = folder.with("my square.bin", maker.bytes() + "more");
    const MeshFile file = read_mesh(input);
    CHECK(faces_of(file.mesh) == Faces{{0, 1, 2}, {0, 2, 3}});
    PolygonMesh moved = file.mesh;
    moved.vertices(1, 0) = 0.5;
    const std::string expected =
        with(maker.bytes(), bytes_of(std::vector<float>{1, 0, 0.1F}), bytes_of(std::vector<float>{0.5F, 0, 0.1F})) +
        "more";

    const auto output = there / "b c.gltf";
    CHECK(write_mesh_like(*file.source, output, moved) ==
          std::vector<std::string>{"the binary data of " + output.string() + " are beside it, in b c.bin",
                                   output.string() +
                                       " names 1 picture beside it ('wood.png'): copy it there from the "
                                       "folder of " +
                                       input.string()});
    CHECK(content_of(there / "b c.bin").substr(48 * 2) == expected.substr(48 * 2));
    CHECK(without_bounds(content_of(output)) == without_bounds(with(text, "my%20square.bin", "b%20c.bin")));
    CHECK(read_mesh(output).mesh.vertices == moved.vertices);
    // Again: the buffer of the file that is replaced is replaced, too.
    moved.vertices(1, 0) = 0.75;
    write_mesh_like(*file.source, output, moved);
    CHECK(read_mesh(output).mesh.vertices == moved.vertices);
    CHECK(std::distance(std::filesystem::directory_iterator(there), {}) == 2);
    // A file that has the name by chance is left alone.
    const auto precious = folder.with("d.bin", "precious");
    write_mesh_like(*file.source, folder / "d.gltf", moved);
    CHECK(content_of(precious) == "precious");
    CHECK(read_mesh(folder / "d.gltf").mesh.vertices == moved.vertices);
    // Over itself, twice.
    for (int i = 0; i < 2; ++i) {
        write_mesh_like(*read_mesh(input).source, input, moved);
        CHECK(read_mesh(input).mesh.vertices == moved.vertices);
    }
    CHECK(content_of(buffer) == maker.bytes() + "more");
    // What was read does not need the files any more.
    std::filesystem::remove(buffer);
    write_mesh_like(*file.source, output, file.mesh);
    CHECK(read_mesh(output).mesh.vertices == file.mesh.vertices);
}

TEST_CASE("the own buffer of a file is never replaced, even where its name is the one for the result's")
{
    const TemporaryDirectory folder;
    const GltfMaker maker = made_square();
    const auto path = folder.with("a.gltf", maker.text("a.bin"));
    const auto buffer = folder.with("a.bin", maker.bytes());
    for (const double x : {0.5, 0.25, 0.125}) {
        MeshFile file = read_mesh(path);
        file.mesh.vertices(0, 0) = x;
        const std::string named = nlohmann::json::parse(content_of(path))["buffers"][0]["uri"];
        const std::string before = content_of(folder / named);
        write_mesh_like(*file.source, path, file.mesh);
        CHECK(content_of(folder / named) == before);
        CHECK(read_mesh(path).mesh.vertices == file.mesh.vertices);
    }
    CHECK(content_of(buffer) == maker.bytes());
}

TEST_CASE("buffers within the text stay there, also in a binary file, and beside its own chunk")
{
    const GltfMaker maker = made_square();
    for (std::size_t n_more : {0, 1, 2}) {
        const std::string bytes = maker.bytes() + std::string(n_more, 'x');
        const std::string text = maker.text(gltf_data("data:application/gltf-buffer;base64", bytes));
        CHECK(rewritten("a.gltf", text, stay_put).content == text);
        const auto change = [](Points& points) { points(0, 2) = 0.5; };
        const Rewritten moved = rewritten("a.gltf", text, change);
        CHECK(read_text("a.gltf", moved.content).mesh.vertices(0, 2) == 0.5);
        CHECK(without_bounds(moved.content).size() == without_bounds(text).size());
        const std::string both = GltfMaker::glb(text, "the chunk of another buffer");
        CHECK(rewritten("a.glb", both, stay_put).content == both);
        const Rewritten changed = rewritten("a.glb", both, change);
        CHECK(read_text("a.glb", changed.content).mesh.vertices(0, 2) == 0.5);
        CHECK(contains(changed.content, "the chunk of another buffer"));
    }
    CHECK(gltf_data("data:", "M") == "data:,TQ==");
    CHECK(gltf_data("data:", "Ma") == "data:,TWE=");
    CHECK(gltf_data("data:", "Man") == "data:,TWFu");
}

TEST_CASE("names of files are written so that they are read back, whatever is in them")
{
    for (const std::string name : {"a.bin", "a b%20.bin", "\"#?\\.bin", "\xc3\xa4.bin", "%.bin", "a:b.bin", "%zz.bin"})
        CHECK(gltf_name_of(gltf_uri_of(name)) == name);
    CHECK(gltf_name_of("%41%4a%zz%4") == "AJ%zz%4");
    CHECK(gltf_uri_of("a b%\"") == "a%20b%25%22");
}

TEST_CASE("what cannot be used is refused with its place in the file and a remedy")
{
    const GltfMaker maker = made_square();
    const std::string good = maker.text();
    CHECK(complaint_about_glb(good, maker.bytes()).empty());
    const std::string accessors = "accessors";
    const auto complaint = [&](std::string_view old, std::string_view now) {
        REQUIRE(contains(good, old));
        return complaint_about_glb(with(good, old, now), maker.bytes());
    };
    const std::string again = "; export the mesh again";
    CHECK(complaint(R"("indices":2)", R"("indices":7)") ==
          "a.glb: meshes[0].primitives[0].indices: names accessors[7], but the file has 3 of them" + again);
    CHECK(complaint(R"("indices":2)", R"("indices":-1)") ==
          "a.glb: meshes[0].primitives[0].indices: expected a whole number of at least 0, but found '-1'" + again);
    for (const char* bad : {"0.5", "1e300", "true", "[]", R"("2")", "18446744073709551615", "null"})
        CHECK(contains(complaint(R"("indices":2)", std::string(R"("indices":)") + bad),
                       "primitives[0].indices: expected a"));
    CHECK(complaint(R"("indices":2)", R"("indices":2.0)").empty());
    CHECK(
        contains(complaint(R"("indices":2)", R"("indices":0)"), "indices: the indices are not whole numbers of 1, 2"));
    CHECK(complaint(R"("POSITION":0)", R"("POSITION":2)") ==
          "a.glb: meshes[0].primitives[0].attributes.POSITION: the positions are quantised (KHR_mesh_quantization) and "
          "cannot hold smooth ones; export the mesh without quantisation, or undo it (gltf-transform dequantize)");
    CHECK(contains(complaint(R"("POSITION":0)", R"("POS":0)"), "attributes.POSITION: is missing"));
    CHECK(contains(complaint(R"("indices":2)", R"("indices":2,"mode":7)"), "primitives[0].mode: is not known"));
    CHECK(contains(complaint(R"("indices":2)", R"("indices":2,"mode":1)"), "a.glb: has no triangles, strips or fans"));
    CHECK(
        complaint(R"("indices":2)", R"("indices":2,"extensions":{"KHR_draco_mesh_compression":{}})") ==
        "a.glb: meshes[0].primitives[0]: is compressed by Draco (KHR_draco_mesh_compression); export the mesh without "
        "compression");
    CHECK(complaint(R"("byteLength":48)", R"("byteLength":48,"extensions":{"EXT_meshopt_compression":{}})") ==
          "a.glb: bufferViews[0]: is compressed by meshopt (EXT_meshopt_compression); export the mesh without "
          "compression");
    CHECK(complaint(R"("bufferView":0,)", "") == "a.glb: accessors[0]: has no bufferView and so no data" + again);
    CHECK(complaint(R"("bufferView":0,)", R"("bufferView":3,)") ==
          "a.glb: accessors[0].bufferView: names bufferViews[3], but the file has 3 of them" + again);
    CHECK(complaint(R"("count":4)", R"("count":5)") ==
          "a.glb: accessors[0]: its 5 elements do not fit into bufferViews[0], which has 48 bytes" + again);
    for (const char* n : {"4611686018427387904", "1537228672809129302", "9007199254740992"})
        CHECK_FALSE(complaint(R"("count":4)", std::string(R"("count":)") + n).empty());
    CHECK(contains(complaint(R"("count":4)", R"("count":0)"), "accessors[0].count: there is no element"));
    CHECK(
        contains(complaint(R"("count":4)", R"("count":4,"byteOffset":4)"), "accessors[0]: its 4 elements do not fit"));
    CHECK(contains(complaint(R"("count":4)", R"("count":4,"byteOffset":9007199254740992)"), "accessors[0]: its 4"));
    CHECK(contains(complaint(R"("count":4)", R"("count":3)"),
                   "triangle 1 (numbered from 0): names vertex 3, but the file"));
    CHECK(complaint(R"("VEC3")", R"("VEC2")") ==
          "a.glb: meshes[0].primitives[0].attributes.POSITION: the positions are "
          "not three numbers each (VEC3)" +
              again);
    CHECK(contains(complaint(R"("VEC3")", R"("VEC9")"), "accessors[0].type: is not known to glTF 2.0"));
    CHECK(contains(complaint("5126", "5124"), "accessors[0].componentType: is not known to glTF 2.0"));
    CHECK(complaint(R"("byteLength":48)", R"("byteLength":480)") ==
          "a.glb: bufferViews[0]: ends at byte 480 of a buffer of 108 bytes" + again);
    CHECK(
        contains(complaint(R"("byteOffset":0)", R"("byteOffset":-4)"), "bufferViews[0].byteOffset: expected a whole"));
    CHECK(contains(complaint(R"("byteLength":48)", R"("byteLength":48,"byteStride":4)"),
                   "bufferViews[0].byteStride: is 4, but the elements of accessors[0] have 12 bytes"));
    CHECK(contains(complaint(R"("buffer":0)", R"("buffer":1)"), "bufferViews[0].buffer: names buffers[1]"));
    CHECK(complaint(R"("byteOffset":48)", R"("byteOffset":44)") ==
          "a.glb: meshes[0].primitives[0].attributes.NORMAL: shares bytes with "
          "meshes[0].primitives[0].attributes.POSITION, which would change with it" +
              again);
    CHECK(contains(complaint(R"("byteOffset":96)", R"("byteOffset":0)"), "shares bytes with"));
    CHECK(
        contains(complaint(R"("version":"2.0")", R"("version":"1.0")"), "asset.version: is '1.0', but only glTF 2.0"));
    CHECK(
        contains(complaint(R"("primitives":[)", R"("primitives":[7,)"), "meshes[0].primitives[0]: expected an object"));
    CHECK(contains(complaint(R"("meshes":[)", R"("meshes":{"a":[)"), "this is not JSON"));
    CHECK(contains(complaint(R"("asset")", R"("accessors":{},"asset")"), "a.glb") == false);
}

TEST_CASE("files that are cut off or no glTF files are refused, and nesting does not matter")
{
    const GltfMaker maker = made_square();
    const std::string file = maker.glb();
    for (std::size_t n = 1; n < file.size(); ++n)
        REQUIRE(contains(complaint_about("a.glb", file.substr(0, n)), "a.glb: "));
    CHECK(
        complaint_about("a.glb", file.substr(0, file.size() - 1)) ==
        fmt::format("a.glb: the file announces {} bytes, but has only {}; it has been cut off: export or copy the mesh "
                    "again",
                    file.size(), file.size() - 1));
    CHECK(complaint_about("a.gltf", "not JSON") ==
          "a.gltf: byte 1 of the JSON text: this is not JSON; export the mesh again");
    CHECK(contains(complaint_about("a.gltf", R"({"a":1e999})"), "a number that is too large"));
    CHECK(contains(complaint_about("a.gltf", "[]"), "a.gltf: expected an object"));
    CHECK(contains(complaint_about("a.glb", "glTF\xff\xff\xff\xff and more"), "no version of binary glTF"));
    CHECK(contains(complaint_about("a.glb", with(file, std::string("\2\0\0\0", 4), std::string("\1\0\0\0", 4))),
                   "version 1 of binary glTF"));
    CHECK(contains(complaint_about("a.glb", GltfMaker::glb(maker.text(), "")),
                   "buffers[0].byteLength: is 108, but the buffer has only 0 bytes"));
    const std::string deep(1'000'000, '[');
    CHECK(contains(complaint_about("a.gltf", deep), "this is not JSON"));
    GltfMaker nested = made_square();
    nested.more = R"("extras":)" + deep + std::string(deep.size(), ']');
    CHECK(rewritten("a.glb", nested.glb(), stay_put).content == nested.glb());
}

TEST_CASE("buffers that are not there, or not as they should be, are named")
{
    const GltfMaker maker = made_square();
    const auto complaint = [&](const std::string& uri) { return complaint_about("a.gltf", maker.text(uri)); };
    CHECK(
        contains(complaint("none.bin"), "a.gltf: buffers[0].uri: none.bin: cannot be read: No such file or directory"));
    CHECK(contains(complaint("/etc/hostname"), "names '/etc/hostname', which is no file beside this one"));
    CHECK(contains(complaint("https://there.org/a.bin"), "which is no file beside this one"));
    CHECK(contains(complaint("data:text/plain,abc"), "buffers[0].uri: the data are not in base64"));
    CHECK(contains(complaint("data:;base64,a*b"), "buffers[0].uri: the data have characters that are not base64"));
    CHECK(contains(complaint("data:;base64,AAAA"), "buffers[0].byteLength: is 108, but the buffer has only 3 bytes"));
    CHECK(contains(complaint(""), "buffers[0].byteLength: is 108, but the buffer has only 0 bytes"));
    const TemporaryDirectory folder;
    static_cast<void>(folder.with("empty.bin", ""));
    CHECK_THROWS_AS(read_mesh(folder.with("a.gltf", maker.text("empty.bin"))), InputError);
    // Begins as a packed file does, and is none.
    GltfMaker odd;
    const int indices = odd.indices(std::vector<unsigned short>{0x8b1f, 0, 1});
    std::vector<float> points(3 * 0x8b20, 0.5F);
    odd.mesh({primitive(odd.vectors(points), indices)});
    static_cast<void>(folder.with("odd.bin", odd.bytes()));
    CHECK(faces_of(read_mesh(folder.with("odd.gltf", odd.text("odd.bin"))).mesh) == Faces{{0x8b1f, 0, 1}});
}

TEST_CASE("positions that are not finite, and faces that name a vertex twice, are faults with their place")
{
    GltfMaker maker;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const int positions = maker.vectors({0, 0, 0, 1, 0, 0, 1, 1, 0, nan, 1, 0});
    maker.mesh({primitive(positions, maker.indices(std::vector<unsigned>{0, 1, 2, 1, 1, 2, 0, 2, 9, 0, 2, 3}))});
    const std::string file = maker.glb();
    CHECK(
        complaint_about("a.glb", file) ==
        "a.glb: meshes[0].primitives[0].attributes.POSITION, vertex 3 (numbered from 0): a coordinate is not a finite "
        "number; correct it or export the mesh again");
    const TemporaryDirectory folder;
    FaultLog faults;
    const MeshFile read = read_faulty_mesh(folder.with("a.glb", file), faults);
    CHECK(faces_of(read.mesh) == Faces{{0, 1, 2}, {0, 2, 3}});
    CHECK(faults.count == 3);
    CHECK(faults.faces_left_out == std::vector<Index>{1});
    CHECK(
        contains(faults.messages[2], "meshes[0].primitives[0].indices, triangle 2 (numbered from 0): names vertex 9"));
}

TEST_CASE("bytes that are damaged anywhere give a mesh that can be written again, or a complaint")
{
    GltfMaker maker = made_square();
    maker.mesh({primitive(0, -1, R"("mode":6)")});
    const std::string file = maker.glb();
    for (std::size_t place = 12; place < file.size(); ++place)
        for (const char c : {'\0', '9', '-', '"', ']', '\x7f', '\xff'}) {
            std::string damaged = file;
            damaged[place] = c;
            CAPTURE(place);
            try {
                const Rewritten again = rewritten("a.glb", damaged, stay_put);
                REQUIRE(again.content == damaged);
                const Rewritten moved = rewritten("a.glb", damaged, [](Points& points) { points *= 0.5; });
                REQUIRE(read_text("a.glb", moved.content).mesh.n_faces() > 0);
            } catch (const InputError&) {
                continue;
            }
        }
}

TEST_CASE("what glTF cannot hold is refused before anything is written")
{
    const FileKind glb{FileFormat::Glb, Encoding::BinaryLittleEndian};
    const Points points = tricky_points(true);
    CHECK(complaint_of_writing(make_mesh(points, {{0, 1, 2}, {0, 1, 2, 3}}), "a.glb", glb) ==
          "a.glb: cannot be written: face 1 (numbered from 0) has 4 sides, but glTF holds triangles only; write .obj, "
          ".off "
          "or .ply, which can hold this mesh");
    CHECK(contains(complaint_of_writing(make_mesh(points, {}), "a.glb", glb), "the mesh has no faces"));
    CHECK(contains(complaint_of_writing(make_mesh(tricky_points(false), {{0, 1, 2}}), "a.glb", glb),
                   "has a coordinate too large for the single precision of glTF"));
    CHECK_THROWS_WITH_AS(write_mesh("a.glb", make_triangle(), {FileFormat::Glb, Encoding::Ascii}),
                         "encoding must be BinaryLittleEndian for glTF files", OptionError);
    const TemporaryDirectory folder;
    MeshFile file = read_mesh(folder.with("b.glb", made_square().glb()));
    file.mesh.vertices(1, 1) = 1e39;
    CHECK_THROWS_AS(write_mesh_like(*file.source, folder / "c.glb", file.mesh), OutputError);
    CHECK(folder.n_files() == 1);
}

TEST_CASE("a file that is made anew says what is in it")
{
    const TemporaryDirectory folder;
    write_mesh(folder / "a.glb", make_triangle(), {FileFormat::Glb, Encoding::BinaryLittleEndian});
    const std::string glb = content_of(folder / "a.glb");
    CHECK(glb.size() % 4 == 0);
    CHECK(accessor_in(glb, 0) ==
          nlohmann::json::parse(
              R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]})"));
    CHECK(glb.ends_with(bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}) +
                        bytes_of(std::vector<unsigned>{0, 1, 2})));
    CHECK(extras_of(*read_mesh(folder / "a.glb").source) == std::vector<std::string>{});
    write_mesh(folder / "a.gltf", make_triangle(), {FileFormat::Gltf, Encoding::BinaryLittleEndian});
    CHECK(nlohmann::json::parse(content_of(folder / "a.gltf"))["buffers"][0]["byteLength"] == 48);
    CHECK(identical(read_mesh(folder / "a.gltf").mesh, make_triangle()));
    CHECK(folder.n_files() == 2);
}

TEST_CASE("what else is in a file is named in a few words")
{
    GltfMaker maker;
    maker.mesh({R"({"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"TEXCOORD_1":2,"_HEAT":3},"targets":[{}]})",
                R"({"attributes":{"POSITION":0},"mode":1})"});
    maker.more = R"("materials":[{}],"animations":[{}],"skins":[],"nodes":[{},{"scale":[2,2,2]}])";
    CHECK(extras_of_gltf("a.gltf", maker.text()) ==
          std::vector<std::string>{"normals", "texture coordinates", "attributes _HEAT", "morph targets",
                                   "points and lines", "materials", "animations", "transforms of nodes"});
}

TEST_CASE("members that are not used may have any type: the file is read, written again, and what is in it is named")
{
    for (const char* member : {"skins", "materials", "textures", "animations", "cameras", "nodes"})
        for (const char* value : {"{}", R"({"version":"2.0"})", "3", "\"a\"", "[1]", "[[]]", "null"}) {
            GltfMaker maker;
            maker.mesh({fmt::format(R"({{"attributes":{{"POSITION":{}}},"mode":5}})", maker.vectors(square))});
            maker.more = fmt::format(R"("{}":{})", member, value);
            CAPTURE(maker.more);
            CHECK(complaint_about("a.glb", maker.glb()).empty());
            CHECK_NOTHROW(rewritten("a.glb", maker.glb(), [](Points& points) { points(0, 0) = 0.5; }));
            CHECK_NOTHROW(extras_of_gltf("a.glb", maker.glb()));
        }
}
