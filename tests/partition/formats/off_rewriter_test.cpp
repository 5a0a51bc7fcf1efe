#include <doctest/doctest.h>

#include "tests/support/mesh_files.h"

using namespace seamflow;
using namespace seamflow::test;

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
