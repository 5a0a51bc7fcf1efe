#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "partition/errors.h"
#include "partition/formats/gltf_text.h"
#include "partition/formats/mesh_io.h"
#include "tests/support/gltf_files.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// A square of two triangles, the second and the last vertex of which are elsewhere in what lies below.
const std::vector<float> sheet = {0, 0, 0, 1, 0, 0.1F, 1, 1, 0, 0, 1, 0.5F};
const std::vector<float> below = {0, 0, 0, 7, 7, 7, 1, 1, 0, 8, 8, 8};
const std::vector<float> replaced = {1, 0, 0.1F, 0, 1, 0.5F};
const std::vector<unsigned short> second_and_last = {1, 3};
const std::vector<unsigned char> sheet_corners = {0, 1, 2, 0, 2, 3};

constexpr const char* sheet_bounds = R"("min":[0,0,0],"max":[1,1,0.5])";

Points points_of(const std::vector<float>& numbers)
{
    Points points(static_cast<Index>(numbers.size() / 3), 3);
    for (Index v = 0; v < points.rows(); ++v)
        for (Index k = 0; k < 3; ++k)
            points(v, k) = double{numbers[usize(3 * v + k)]};
    return points;
}

/// The sheet, its positions sparse. Accessor 0 has the indices, accessor 1 the positions.
/// @param again a second mesh with what lies below, without any replaced.
GltfMaker sparse_sheet(bool again = false)
{
    GltfMaker maker;
    maker.indices(sheet_corners);
    const int base = maker.view(bytes_of(below));
    maker.accessor(base, 5126, 4, "VEC3",
                   fmt::format(R"("name":"sheet",{},{})", maker.sparse(second_and_last, replaced), sheet_bounds));
    maker.mesh({R"({"attributes":{"POSITION":1},"indices":0})"});
    if (again) {
        maker.accessor(base, 5126, 4, "VEC3", R"("min":[0,0,0],"max":[8,8,8])");
        maker.mesh({R"({"attributes":{"POSITION":2},"indices":0})"});
    }
    // Odd numbers of bytes behind all others.
    maker.view("end");
    return maker;
}

nlohmann::json json_of(const std::string& file)
{
    const bool is_binary = file.starts_with("glTF");
    return nlohmann::json::parse(is_binary ? file.substr(20, file.find("BIN", 20) - 24) : file);
}

/// Checks that an accessor of three floats has these values and bounds, in a view of its own.
void require_dense(const nlohmann::json& json, std::size_t accessor, std::string_view buffer, const Points& points)
{
    const nlohmann::json& now = json["accessors"][accessor];
    CHECK_FALSE(now.contains("sparse"));
    CHECK_FALSE(now.contains("byteOffset"));
    const nlohmann::json& view = json["bufferViews"][now["bufferView"].get<std::size_t>()];
    REQUIRE(view["byteLength"] == 12 * points.rows());
    const auto offset = view["byteOffset"].get<std::size_t>();
    CHECK(offset % 4 == 0);
    CHECK(json["buffers"][view["buffer"].get<std::size_t>()]["byteLength"].get<std::size_t>() <= buffer.size());
    for (Index v = 0; v < points.rows(); ++v) {
        const std::vector<float> expected{float(points(v, 0)), float(points(v, 1)), float(points(v, 2))};
        REQUIRE(buffer.substr(offset + 12 * usize(v), 12) == bytes_of(expected));
    }
    for (Index k = 0; k < 3; ++k) {
        CHECK(now["min"][usize(k)] == double{float(points.col(k).minCoeff())});
        CHECK(now["max"][usize(k)] == double{float(points.col(k).maxCoeff())});
    }
}

}  // namespace

TEST_CASE("sparse positions are those below, or zeros, with some replaced, by indices of every width")
{
    for (const bool has_base : {true, false})
        for (const int width : {1, 2, 4}) {
            CAPTURE(width);
            GltfMaker maker;
            maker.indices(sheet_corners);
            const std::string sparse = width == 1   ? maker.sparse(std::vector<unsigned char>{1, 3}, replaced)
                                       : width == 2 ? maker.sparse(second_and_last, replaced)
                                                    : maker.sparse(std::vector<unsigned>{1, 3}, replaced);
            maker.accessor(has_base ? maker.view(bytes_of(below)) : -1, 5126, 4, "VEC3", sparse);
            maker.mesh({R"({"attributes":{"POSITION":1},"indices":0})"});
            Points expected = points_of(sheet);
            if (!has_base)
                expected.row(2).setZero();
            CHECK(read_text("a.glb", maker.glb()).mesh.vertices == expected);
            CHECK(rewritten("a.glb", maker.glb(), stay_put).content == maker.glb());
        }
}

TEST_CASE("sparse indices of triangles are read, and stay")
{
    GltfMaker maker;
    maker.vectors(sheet);
    const int others = maker.view(bytes_of(std::vector<unsigned short>{3, 1}));
    const int places = maker.view(bytes_of(std::vector<unsigned char>{4, 5}));
    maker.accessor(maker.view(bytes_of(std::vector<unsigned short>{0, 1, 2, 0, 2, 3})), 5123, 6, "SCALAR",
                   fmt::format(R"("sparse":{{"count":2,"indices":{{"bufferView":{},"componentType":5121}},)"
                               R"("values":{{"bufferView":{}}}}})",
                               places, others));
    maker.mesh({R"({"attributes":{"POSITION":0},"indices":1})"});
    const PolygonMesh mesh = read_text("a.glb", maker.glb()).mesh;
    CHECK(std::ranges::equal(mesh.face(1), std::vector<Index>{0, 3, 1}));
    const Rewritten moved = rewritten("a.glb", maker.glb(), move_second);
    CHECK(moved.content.size() <= maker.glb().size() + 64);
    CHECK(json_of(moved.content)["accessors"][1] == json_of(maker.glb())["accessors"][1]);
}

TEST_CASE("sparse positions that have moved are all written behind the bytes that were there")
{
    const GltfMaker maker = sparse_sheet();
    Points expected = points_of(sheet);
    expected.row(0) << -1, 0.5, 0.25;  // Neither of those that are replaced.
    const auto move = [&](Points& points) { points = expected; };
    const std::size_t n_views = json_of(maker.glb())["bufferViews"].size();
    const auto check = [&](const std::string& file, std::string_view buffer) {
        const nlohmann::json json = json_of(file);
        CHECK(json["bufferViews"].size() == n_views + 1);
        CHECK(json["accessors"][1]["name"] == "sheet");
        CHECK(json["buffers"][0]["byteLength"] == buffer.size());
        CHECK(buffer.starts_with(maker.bytes()));
        require_dense(json, 1, buffer, expected);
    };

    const std::string glb = rewritten("a.glb", maker.glb(), move).content;
    const std::size_t chunk = glb.find("BIN") + 4;
    check(glb, std::string_view(glb).substr(chunk));
    CHECK(read_text("a.glb", glb).mesh.vertices == expected);
    CHECK(rewritten("a.glb", glb, stay_put).content == glb);
    // What is behind the chunk stays there.
    CHECK(rewritten("a.glb", maker.glb() + "behind", move).content == glb + "behind");

    const std::string head = "data:application/gltf-buffer;base64";
    const std::string text = rewritten("a.gltf", maker.text(gltf_data(head, maker.bytes())), move).content;
    const std::string uri = json_of(text)["buffers"][0]["uri"];
    REQUIRE(uri.starts_with(head + ","));
    check(text, bytes_of_gltf_base64(std::string_view(uri).substr(head.size() + 1)).value());
    // Beside a chunk that is another buffer.
    const std::string both =
        rewritten("a.glb", GltfMaker::glb(maker.text(gltf_data(head, maker.bytes())), "chunk"), move).content;
    CHECK(read_text("a.glb", both).mesh.vertices == expected);
    CHECK(both.ends_with(std::string("\10\0\0\0BIN\0chunk\0\0\0", 16)));

    const TemporaryDirectory folder;
    static_cast<void>(folder.with("a.bin", maker.bytes() + "more"));
    MeshFile file = read_mesh(folder.with("a.gltf", maker.text("a.bin")));
    CHECK(file.mesh.vertices == points_of(sheet));
    file.mesh.vertices = expected;
    write_mesh_like(*file.source, folder / "b.gltf", file.mesh);
    const std::string bytes = content_of(folder / "b.bin");
    CHECK(bytes.starts_with(maker.bytes() + "more"));
    check(content_of(folder / "b.gltf"), bytes);
    CHECK(content_of(folder / "a.bin") == maker.bytes() + "more");
}

TEST_CASE("positions that lie below sparse ones move without them, and these without those")
{
    const GltfMaker maker = sparse_sheet(true);
    Points before(8, 3);
    before << points_of(sheet), points_of(below);
    CHECK(read_text("a.glb", maker.glb()).mesh.vertices == before);
    for (const bool moves_first : {true, false})
        for (const bool moves_second : {true, false}) {
            CAPTURE(moves_first);
            CAPTURE(moves_second);
            Points expected = before;
            if (moves_first)
                expected.topRows(4).array() += 0.25;
            if (moves_second)
                expected.bottomRows(4).array() -= 0.5;
            expected = expected.cast<float>().cast<double>().eval();
            const std::string now = rewritten("a.glb", maker.glb(), [&](Points& points) { points = expected; }).content;
            CHECK(read_text("a.glb", now).mesh.vertices == expected);
            CHECK((now == maker.glb()) == (!moves_first && !moves_second));
            if (moves_first || moves_second)
                require_dense(json_of(now), 1, std::string_view(now).substr(now.find("BIN") + 4), expected.topRows(4));
        }
}

TEST_CASE("several sparse accessors get a view each, in one buffer, and sparse normals follow the surface")
{
    GltfMaker maker;
    maker.indices(sheet_corners);
    maker.accessor(-1, 5126, 4, "VEC3",
                   maker.sparse(std::vector<unsigned>{1, 2, 3}, {1, 0, 0, 1, 1, 0, 0, 1, 0}) +
                       R"(,"min":[0,0,0],"max":[1,1,0])");
    maker.accessor(-1, 5126, 4, "VEC3",
                   maker.sparse(std::vector<unsigned>{0, 1, 2, 3}, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}) +
                       R"(,"min":[0,0,1],"max":[0,0,1])");
    maker.mesh({R"({"attributes":{"POSITION":1,"NORMAL":2},"indices":0})"});
    Points expected = points_of({0, 0, 0, 1, 0, 1, 1, 1, 1, 0, 1, 0});
    const Rewritten tilted = rewritten("a.glb", maker.glb(), [&](Points& points) { points = expected; });
    CHECK(tilted.remarks.empty());
    const std::string_view chunk = std::string_view(tilted.content).substr(tilted.content.find("BIN") + 4);
    require_dense(json_of(tilted.content), 1, chunk, expected);
    const double half = double{std::sqrt(0.5F)};
    expected.col(0).setConstant(-half);
    expected.col(1).setZero();
    expected.col(2).setConstant(half);
    require_dense(json_of(tilted.content), 2, chunk, expected);
    // A move that turns nothing leaves the normals sparse.
    const Rewritten shifted = rewritten("a.glb", maker.glb(), [](Points& points) { points.col(0).array() += 1.0; });
    CHECK(json_of(shifted.content)["accessors"][2] == json_of(maker.glb())["accessors"][2]);
}

TEST_CASE("a sparse accessor keeps its other members, whatever their order and the blanks between them")
{
    const GltfMaker maker = sparse_sheet();
    const std::string text = maker.text();
    const std::size_t begin = text.find(R"({"bufferView":1,"componentType")");
    const std::size_t end = text.find(sheet_bounds) + std::string_view(sheet_bounds).size() + 1;
    const std::string sparse =
        R"("sparse" :{"count":2,"indices":{"bufferView":2,"componentType":5123},"values":{"bufferView":3}})";
    const std::string rest = R"("componentType":5126 ,"count": 4,"type":"VEC3")";
    for (const std::string& members :
         {sparse + " , " + rest + R"(, "byteOffset" : 0 ,"bufferView": 1 )",
          rest + ",\n " + sparse + R"(,"bufferView":1 )", R"( "bufferView":1, )" + sparse + "," + rest,
          rest + R"(,"bufferView":1,)" + sparse}) {
        CAPTURE(members);
        const std::string file =
            GltfMaker::glb(text.substr(0, begin) + "{" + members + "}" + text.substr(end), maker.bytes());
        const std::string now = rewritten("a.glb", file, move_second).content;
        CHECK(read_text("a.glb", now).mesh.vertices(1, 0) == 2.0);
        CHECK(contains(now, rest));
        CHECK(json_of(now)["accessors"][1] == nlohmann::json::parse(R"({"bufferView":5,)" + rest + "}"));
    }
}

TEST_CASE("a sparse accessor that cannot be used is refused with its place")
{
    const GltfMaker maker = sparse_sheet();
    const std::string good = maker.text();
    const auto complaint = [&](std::string_view old, std::string_view now) {
        REQUIRE(contains(good, old));
        return complaint_about("a.glb", GltfMaker::glb(with(good, old, now), maker.bytes()));
    };
    const auto complaint_of_indices = [&](const std::vector<unsigned short>& indices) {
        return complaint_about("a.glb",
                               GltfMaker::glb(good, with(maker.bytes(), bytes_of(second_and_last) + bytes_of(replaced),
                                                         bytes_of(indices) + bytes_of(replaced))));
    };
    const std::string again = "; export the mesh again";
    CHECK(complaint_of_indices({1, 3}).empty());
    CHECK(complaint_of_indices({1, 4}) ==
          "a.glb: accessors[1].sparse.indices: number 1 of them is 4, but the accessor has 4 elements (all numbered "
          "from 0)" +
              again);
    CHECK(complaint_of_indices({3, 1}) ==
          "a.glb: accessors[1].sparse.indices: number 1 of them (numbered from 0) is 1 and follows 3, but they must "
          "ascend" +
              again);
    CHECK(contains(complaint_of_indices({1, 1}), "is 1 and follows 1, but they must ascend"));
    const std::string count = R"("sparse":{"count":2)";
    CHECK(complaint(count, R"("sparse":{"count":3)") ==
          "a.glb: accessors[1].sparse.values: its 3 elements do not fit into bufferViews[3], which has 24 bytes" +
              again);
    CHECK(contains(complaint(count, R"("sparse":{"count":0)"), "accessors[1].sparse.count: there is no element"));
    CHECK(contains(complaint(count, R"("sparse":{"":0)"), "accessors[1].sparse.count: is missing"));
    CHECK(contains(complaint(R"("indices":{"bufferView":2,"componentType":5123)", R"("indices":{"bufferView":2)"),
                   "accessors[1].sparse.indices.componentType: is missing"));
    CHECK(contains(complaint(R"("bufferView":2,"componentType":5123)", R"("bufferView":2,"componentType":5126)"),
                   "accessors[1].sparse.indices: the indices are not whole numbers"));
    CHECK(contains(complaint(R"("bufferView":2,"componentType":5123)", R"("bufferView":2,"componentType":5125)"),
                   "accessors[1].sparse.indices: its 2 elements do not fit into bufferViews[2], which has 4 bytes"));
    CHECK(contains(complaint(R"("values":{"bufferView":3)", R"("values":{"bufferView":30)"),
                   "accessors[1].sparse.values.bufferView: names bufferViews[30]"));
    CHECK(contains(complaint(R"("values":{"bufferView":3})", R"("values":7)"),
                   "accessors[1].sparse.values: expected an object"));
    CHECK(
        complaint(R"({"bufferView":1,"componentType":5126,"count":4)", R"({"componentType":5126,"count":4000000000)") ==
        fmt::format(
            "a.glb: accessors[1].count: is 4000000000, but there is no bufferView, and all buffers have only {} "
            "bytes{}",
            (maker.bytes().size() + 3) / 4 * 4, again));
    CHECK(contains(complaint(R"("componentType":5126,"count":4)", R"("componentType":5123,"count":4)"), "quantised"));
}

TEST_CASE("bytes of a sparse file that are damaged anywhere give a mesh that can be written again, or a complaint")
{
    const std::string file = sparse_sheet(true).glb();
    for (std::size_t place = 12; place < file.size(); ++place)
        for (const char c : {'\0', '9', '-', '"', ']', '\x7f', '\xff'}) {
            std::string damaged = file;
            damaged[place] = c;
            CAPTURE(place);
            try {
                const Rewritten same = rewritten("a.glb", damaged, stay_put);
                REQUIRE(same.content == damaged);
                Points expected;
                const Rewritten moved = rewritten("a.glb", damaged, [&](Points& points) { expected = points *= 0.5; });
                REQUIRE(read_text("a.glb", moved.content).mesh.vertices == expected.cast<float>().cast<double>());
            } catch (const InputError&) {
                continue;
            }
        }
}
