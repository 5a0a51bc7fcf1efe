#include <bit>
#include <cstring>
#include <sstream>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "samples/meshes/meshes.h"
#include "samples/report/error_map.h"
#include "tests/support/relative.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

/// The vertices of an error map: x, y, z, a colour and some values each.
struct ErrorMap {
    std::vector<std::string> names;
    std::vector<Colour> colours;
    /// Per vertex.
    std::vector<std::vector<double>> values;
};

/// Takes bytes off the front of `text`.
template <class Number>
Number take(std::string_view& text)
{
    Number number;
    std::memcpy(&number, text.data(), sizeof number);
    text.remove_prefix(sizeof number);
    return number;
}

ErrorMap read_error_map(const std::filesystem::path& path)
{
    const std::string content = test::content_of(path);
    const std::string end = "end_header\n";
    const std::size_t body = content.find(end) + end.size();
    std::istringstream header(content.substr(0, body));
    ErrorMap map;
    std::size_t vertices = 0;
    for (std::string word; header >> word && word != "face";) {
        if (word == "vertex")
            header >> vertices;
        if (word == "double" && header >> word && word.size() > 1)
            map.names.push_back(word);
    }
    std::string_view rest = std::string_view(content).substr(body);
    for (std::size_t v = 0; v < vertices; ++v) {
        rest.remove_prefix(3 * sizeof(double));
        map.colours.emplace_back();
        for (auto& channel : map.colours.back())
            channel = take<std::uint8_t>(rest);
        map.values.emplace_back();
        for (std::size_t k = 0; k < map.names.size(); ++k)
            map.values.back().push_back(take<double>(rest));
    }
    return map;
}

/// A plane, and the same with vertex 17, in its middle, pulled up and sideways.
struct Planes {
    test::TemporaryDirectory folder;
    std::filesystem::path file = folder / "map.ply";
    PolygonMesh reference = make_quads(100, {.amplitude = 0.0});
    PolygonMesh candidate = reference;

    Planes() { candidate.vertices.row(17) += Eigen::RowVector3d(0.003, 0.0, 0.004); }
};

}  // namespace

TEST_CASE("the candidate comes with its distances from the surface of the reference, and their colours")
{
    const Planes p;
    const ErrorRange range = write_error_map(p.file, p.reference, p.candidate, Shown::SurfaceDistance, {});
    CHECK(range.first == 0.0);
    CHECK(range.last == test::relative(0.004, 1e-5));
    CHECK(read_mesh(p.file).mesh.vertices == p.candidate.vertices);
    const ErrorMap map = read_error_map(p.file);
    CHECK(map.names == std::vector<std::string>{"distance"});
    REQUIRE(map.values.size() == 100);
    CHECK(map.values[17][0] == range.last);
    CHECK(map.values[18][0] == 0.0);
    CHECK(map.colours[17] == rainbow_colour(1.0));
    CHECK(map.colours[18] == rainbow_colour(0.0));
}

TEST_CASE("the distance of corresponding vertices and its parts")
{
    const Planes p;
    CHECK(write_error_map(p.file, p.reference, p.candidate, Shown::VertexDistance, {}).last ==
          test::relative(0.005, 1e-5));
    CHECK(read_error_map(p.file).names == std::vector<std::string>{"distance"});
    write_error_map(p.file, p.reference, p.candidate, Shown::Tangential, {});
    const ErrorMap tangential = read_error_map(p.file);
    CHECK(tangential.names == std::vector<std::string>{"tangential", "normal", "distance"});
    CHECK(tangential.values[17][0] == test::relative(0.003, 0.2));
    CHECK(tangential.values[17][2] == test::relative(0.005, 1e-5));
    const ErrorRange range = write_error_map(p.file, p.reference, p.candidate, Shown::Normal, {});
    CHECK(range.first == -range.last);
    const ErrorMap normal = read_error_map(p.file);
    CHECK(normal.names == std::vector<std::string>{"normal", "tangential", "distance"});
    CHECK(std::abs(normal.values[17][0]) == range.last);
    CHECK(normal.colours[17] == signed_colour(normal.values[17][0] > 0.0 ? 1.0 : -1.0));
    CHECK(normal.colours[18] == signed_colour(0.0));
}

TEST_CASE("the full scale can be given")
{
    const Planes p;
    CHECK(write_error_map(p.file, p.reference, p.candidate, Shown::SurfaceDistance, 0.016).last == 0.016);
    CHECK(read_error_map(p.file).colours[17] == rainbow_colour(0.25));
}

TEST_CASE("equal meshes have one colour")
{
    const Planes p;
    CHECK(write_error_map(p.file, p.reference, p.reference, Shown::SurfaceDistance, {}).last == 0.0);
    for (const Colour& colour : read_error_map(p.file).colours)
        CHECK(colour == rainbow_colour(0.0));
}

TEST_CASE("only the distance from the surface can be shown of meshes that do not correspond")
{
    const Planes p;
    const PolygonMesh other = make_triangles(400, {.amplitude = 0.0});
    CHECK(write_error_map(p.file, p.reference, other, Shown::SurfaceDistance, {}).last < 1e-15);
    CHECK_THROWS_AS(write_error_map(p.file, p.reference, other, Shown::VertexDistance, {}), InputError);
    CHECK_THROWS_AS(write_error_map(p.file, p.reference, other, Shown::Normal, {}), InputError);
}
