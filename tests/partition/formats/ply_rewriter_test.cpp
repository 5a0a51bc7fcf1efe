#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

#include <doctest/doctest.h>

#include "partition/io/byte_order.h"
#include "partition/vector_area.h"
#include "tests/support/mesh_files.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

void stand_up(Points& points)
{
    points.row(2) << 0, 0, 1;
}

/// A binary file whose vertices have further numbers between and around their coordinates, before and behind them a
/// further element.
template <class Real>
std::string binary_file(std::endian order, const std::string& type, Real x, Real y, bool standing = false)
{
    std::string file =
        std::string("ply\r\nformat binary_") + (order == std::endian::big ? "big" : "little") +
        "_endian 1.0\r\ncomment of theirs\r\nelement thing 2\r\nproperty list uchar short parts\r\n"
        "element vertex 3\r\nproperty uchar red\r\nproperty " +
        type + " z\r\nproperty list uchar float weights\r\nproperty " + type + " x\r\nproperty " + type +
        " y\r\nproperty float nx\r\nproperty double nz\r\nproperty float ny\r\nproperty float quality\r\n"
        "element face 1\r\nproperty list uchar int vertex_index\r\nproperty ushort flags\r\n"
        "element edge 1\r\nproperty int vertex1\r\nend_header\r\n";
    const auto append = [&](auto... numbers) {
        (
            [&](auto number) {
                const auto bytes = to_bytes(number, order);
                file.append(bytes.data(), bytes.size());
            }(numbers),
            ...);
    };
    using Byte = std::uint8_t;
    const float not_a_number = std::numeric_limits<float>::quiet_NaN();
    append(Byte{1}, std::int16_t{7}, Byte{0});
    const auto append_vertex = [&](Byte red, Real px, Real py, Real pz) {
        append(red, pz, Byte{1}, 0.3F, px, py);
        append(0.F, standing ? 0.0 : 1.0, standing ? -1.F : 0.F, not_a_number);
    };
    append_vertex(1, Real(0), Real(0), Real(0));
    append_vertex(2, x, y, Real(0));
    append_vertex(3, Real(0), Real(standing ? 0 : 1), Real(standing ? 1 : 0));
    append(Byte{3}, std::int32_t{0}, std::int32_t{1}, std::int32_t{2}, std::uint16_t{9});
    append(std::int32_t{2});
    return file + "\n";
}

const std::string text_header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                "property float z\nproperty uchar red\n";
const std::string faces_header = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

}  // namespace

TEST_CASE("binary PLY in its own form: everything but positions stays, bit for bit, in both byte orders")
{
    for (const std::endian order : {std::endian::big, std::endian::little}) {
        const std::string floats = binary_file(order, "float", 1.F, 0.F);
        CHECK((rewritten("a.ply", floats, stay_put).content == floats));
        CHECK(rewritten("a.ply", floats, stay_put).remarks.empty());
        const Rewritten after = rewritten("a.ply", floats, move_second);
        CHECK((after.content == binary_file(order, "float", 2.F, 0.1F)));
        REQUIRE(after.remarks.size() == 1);
        CHECK(contains(after.remarks[0], "a.ply holds positions in single precision"));
        const std::string doubles = binary_file(order, "float64", 1.0, 0.0);
        CHECK((rewritten("a.ply", doubles, move_second).content == binary_file(order, "float64", 2.0, 0.1)));
        CHECK(rewritten("a.ply", doubles, move_second).remarks.empty());
    }
}

TEST_CASE("binary PLY in its own form: normals are those of the surface as it is now")
{
    const std::string before = binary_file(std::endian::little, "double", 1.0, 0.0);
    CHECK((rewritten("a.ply", before, stand_up).content == binary_file(std::endian::little, "double", 1.0, 0.0, true)));
}

TEST_CASE("PLY in its own form: shading that goes on across a seam does so again, and flat shading stays flat")
{
    // A roof of two triangles, whose ridge is there twice.
    const auto roof = [](const std::string& left, const std::string& right) {
        return "ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double y\nproperty double z\n"
               "property float nx\nproperty float ny\nproperty float nz\nelement face 2\n"
               "property list uchar int vertex_indices\nend_header\n0 0 1 " +
               left + "\n1 0 1 " + left + "\n0.5 -1 0 0 -0.7 0.7\n0 0 1 " + right + "\n1 0 1 " + right +
               "\n0.5 1 0 0 0.7 0.7\n3 0 2 1\n3 4 5 3\n";
    };
    const auto lift_eaves = [](Points& points) { points(2, 2) = 1.0; };
    const std::string smooth = rewritten("a.ply", roof("0 0 1", "0 0 1"), lift_eaves).content;
    for (const char* ridge : {"\n0 0 1 0 0.4472136 0.8944272\n1 0 1 0 0.4472136 0.8944272\n0.5 -1 1",
                              "\n0 0 1 0 0.4472136 0.8944272\n1 0 1 0 0.4472136 0.8944272\n0.5 1 0"})
        CHECK(contains(smooth, ridge));
    const std::string flat = rewritten("a.ply", roof("0 -0.7 0.7", "0 0.7 0.7"), lift_eaves).content;
    CHECK(contains(flat, "\n0 0 1 0 0 1\n1 0 1 0 0 1\n0.5 -1 1 0 0 1\n0 0 1 0 0.7 0.7\n"));
}

TEST_CASE("PLY in its own form: whole numbers become doubles where the result has none")
{
    const std::string before = binary_file<std::int16_t>(std::endian::big, "short", 1, 0);
    CHECK((rewritten("a.ply", before, stay_put).content == before));
    const auto moved = rewritten("a.ply", before, [](Points& points) { points.row(1) << 2, -3, 0; });
    CHECK((moved.content == binary_file<std::int16_t>(std::endian::big, "short", 2, -3)));
    const Rewritten after = rewritten("a.ply", before, move_second);
    CHECK(contains(after.content, "property short z\r\n"));
    CHECK(contains(after.content, "property short x\r\nproperty double y\r\n"));
    CHECK(after.remarks.size() == 1);
    CHECK(read_text("a.ply", after.content).mesh.vertices.row(1) == Point(2, 0.1, 0));
    CHECK(after.content.size() == before.size() + 1 + 3 * 6);
}

TEST_CASE_TEMPLATE("binary PLY in its own form: a whole number stays one up to the last that its type has", Whole,
                   std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t)
{
    const std::string type = (std::is_signed_v<Whole> ? "int" : "uint") + std::to_string(8 * sizeof(Whole));
    constexpr Whole most = std::numeric_limits<Whole>::max();
    constexpr Whole least = std::numeric_limits<Whole>::lowest();
    for (const std::endian order : {std::endian::big, std::endian::little}) {
        const std::string before = binary_file<Whole>(order, type, 1, 0);
        const auto moved_to = [&](double x, double y) {
            return rewritten("a.ply", before, [=](Points& points) { points.row(1) << x, y, 0; }).content;
        };
        CHECK((moved_to(most, least) == binary_file<Whole>(order, type, most, least)));
        const std::string beyond = moved_to(double{most} + 1.0, double{least} - 1.0);
        CHECK(contains(beyond, "property double x\r\nproperty double y\r\n"));
        CHECK(read_text("a.ply", beyond).mesh.vertices.row(1) == Point(double{most} + 1.0, double{least} - 1.0, 0));
    }
}

TEST_CASE("binary PLY in its own form: floats become doubles where the result is beyond them")
{
    const std::string before = binary_file(std::endian::little, "float", 1.F, 0.F);
    const auto after = rewritten("a.ply", before, [](Points& points) { points(1, 0) = 1e39; });
    CHECK(contains(after.content, "property double x\r\nproperty float y\r\n"));
    CHECK(read_text("a.ply", after.content).mesh.vertices(1, 0) == 1e39);
}

TEST_CASE("text PLY in its own form: only coordinates that differ change")
{
    const std::string before =
        text_header + "comment theirs\n" + faces_header + "0.0  0 0 255\n1.0 0.000\t0 254 \n0 1.0 0 nan\n\n3 0 1 2\n";
    CHECK(rewritten("a.ply", before, stay_put).content == before);
    const Rewritten after = rewritten("a.ply", before, move_second);
    CHECK(after.content ==
          text_header + "comment theirs\n" + faces_header + "0.0  0 0 255\n2 0.1\t0 254 \n0 1.0 0 nan\n\n3 0 1 2\n");
    CHECK(after.remarks.empty());
}

TEST_CASE("text PLY in its own form: normals are those of the surface as it is now")
{
    const std::string header =
        text_header + "property float nx\nproperty float ny\nproperty double nz\n" + faces_header;
    const std::string before = header + "0 0 0 1 0 0 1.0\n1 0 0 2 0 0 1\n0 1 0 3 0 0 -1\n3 0 1 2\n";
    CHECK(rewritten("a.ply", before, stay_put).content == before);
    CHECK(rewritten("a.ply", before, move_second).content ==
          header + "0 0 0 1 0 0 1.0\n2 0.1 0 2 0 0 1\n0 1 0 3 0 0 -1\n3 0 1 2\n");
    CHECK(rewritten("a.ply", before, stand_up).content ==
          header + "0 0 0 1 0 -1 0\n1 0 0 2 0 -1 0\n0 0 1 3 0 1 0\n3 0 1 2\n");
}

TEST_CASE("PLY in its own form: normals that are whole numbers or incomplete stay, and a remark says so")
{
    for (const char* last : {"property char nz\n", "property float curvature\n"}) {
        const std::string header = text_header + "property float nx\nproperty float ny\n" + last + faces_header;
        const std::string before = header + "0 0 0 1 0 0 1\n1 0 0 2 0 0 1\n0 1 0 3 0 0 1\n3 0 1 2\n";
        const Rewritten after = rewritten("a.ply", before, stand_up);
        CHECK(contains(after.content, "0 0 0 1 0 0 1\n1 0 0 2 0 0 1\n0 0 1 3 0 0 1\n3 0 1 2\n"));
        REQUIRE(after.remarks.size() == 1);
        CHECK(contains(after.remarks[0], "the normals of a.ply are written as they were"));
    }
}
