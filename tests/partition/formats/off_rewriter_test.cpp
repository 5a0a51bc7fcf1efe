#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include <doctest/doctest.h>

#include "partition/io/byte_order.h"
#include "tests/support/mesh_files.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// One triangle, with a colour or without.
std::string binary_triangle(std::endian order, bool coloured, const std::array<float, 3>& second)
{
    std::string file = "OFF BINARY\n";
    const auto append = [&](auto number) {
        const auto bytes = to_bytes(number, order);
        file.append(bytes.data(), bytes.size());
    };
    for (const std::int32_t count : {3, 1, 3})
        append(count);
    for (const float coordinate : {0.F, 0.F, 0.F, second[0], second[1], second[2], 0.F, 1.F, -0.F})
        append(coordinate);
    for (const std::int32_t number : {3, 0, 1, 2})
        append(number);
    if (coloured) {
        append(std::int32_t{1});
        append(0.5F);
    }
    return file + std::string(3, '\0');
}

}  // namespace

TEST_CASE("OFF in its own form: colours and comments stay")
{
    const std::string before = "# by hand\r\nCOFF # coloured\r\n3 1 0\r\n0.0 0 0 255 0 0 255\r\n\r\n"
                               "1.00 \t0.0 0 1 0 0 1# two\r\n0 1 0\r\n3 0 1 2 0.1 0.2 0.3 # face";
    CHECK(rewritten("a.off", before, stay_put).content == before);
    CHECK(rewritten("a.off", before, move_second).content == with(before, "1.00 \t0.0", "2 \t0.1"));
}

TEST_CASE("OFF in its own form: the counts may stand beside the keyword or without one")
{
    for (const char* header : {"OFF3 1 0\n", "OFF 3 1\n", "3 1 0\n", "# a\n\nOFF\n# b\n3 1 0\n"}) {
        const std::string body = "0 0 0\n2 0.1 0\n0 1 0\n3 0 1 2\n";
        CHECK(rewritten("a.off", header + ("0 0 0\n1 0 0\n" + body.substr(14)), move_second).content == header + body);
    }
}

TEST_CASE("OFF in its own form: normals are those of the surface as it is now")
{
    const std::string before = "CNOFF\n3 1 0\n0 0 0 0 0 -2 1 0 0\n1 0 0 0 0 1 0 1 0\n0 1 0 0 0 1.0 0 0 1\n3 0 1 2\n";
    CHECK(rewritten("a.off", before, stay_put).content == before);
    const auto after = rewritten("a.off", before, [](Points& points) { points.row(2) << 0, 0, 1; });
    CHECK(after.content == "CNOFF\n3 1 0\n0 0 0 0 1 0 1 0 0\n1 0 0 0 -1 0 0 1 0\n0 0 1 0 -1 0 0 0 1\n3 0 1 2\n");
}

TEST_CASE("binary OFF in its own form holds floats, in its byte order, and its colours")
{
    for (const std::endian order : {std::endian::big, std::endian::little})
        for (const bool coloured : {true, false}) {
            const std::string before = binary_triangle(order, coloured, {1.F, 0.F, 0.F});
            CHECK((rewritten("a.off", before, stay_put).content == before));
            CHECK(rewritten("a.off", before, stay_put).remarks.empty());
            const Rewritten after = rewritten("a.off", before, move_second);
            CHECK((after.content == binary_triangle(order, coloured, {2.F, 0.1F, 0.F})));
            REQUIRE(after.remarks.size() == 1);
            CHECK(contains(after.remarks[0], "a.off holds positions in single precision"));
            CHECK_THROWS_AS(rewritten("a.off", before, [](Points& points) { points(1, 1) = 1e39; }), OutputError);
        }
}
