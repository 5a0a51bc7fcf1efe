#include <cmath>
#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "partition/formats/mesh_io.h"
#include "tests/samples/workshop.h"
#include "tests/support/digitised.h"

using namespace seamflow;
using test::Workshop;

namespace {

/// A workshop with rounded.obj, heights in whole units over a grid.
struct Heights : Workshop {
    Heights()
    {
        const PolygonMesh mesh = test::rounded(
            test::height_grid(40, [](double x, double y) { return 6.0 * std::sin(x / 13.0) * std::cos(y / 17.0); }),
            Point(0.0, 0.0, 1.0));
        write_mesh(directory / "rounded.obj", mesh, {});
    }
};

}  // namespace

TEST_CASE("smooth and inspect name rounded coordinates, and a report has them")
{
    const Heights w;
    REQUIRE(w.smooth("rounded.obj out.obj --report report.json") == 0);
    CHECK(w.said().find("chosen     coordinates are rounded to 1 in z: the smoothest surface within half a step\n") !=
          std::string::npos);
    const auto report = w.json("report.json");
    CHECK(report["rounded"] == std::vector<double>{0.0, 0.0, 1.0});
    CHECK(report["fairing_iterations"] > 10);
    CHECK(report["fairing_last_motion"] < 0.01);
    REQUIRE(w.run(INSPECT " rounded.obj") == 0);
    CHECK(w.said().find("rounded    coordinates lie in steps of 1 in z") != std::string::npos);
    CHECK(w.said().find("noise") == std::string::npos);
    REQUIRE(w.run(INSPECT " rounded.obj --json") == 0);
    CHECK(w.said().find("\"rounded\"") != std::string::npos);
    // The result is not rounded, and has no noise.
    REQUIRE(w.smooth("out.obj again.obj") == 0);
    CHECK(w.said().find("rounded to") == std::string::npos);
}

TEST_CASE("inspect finds what smooth finds beside a height for missing data")
{
    const Workshop w;
    PolygonMesh mesh = test::rounded(
        test::height_grid(50, [](double x, double y) { return 6.0 * std::sin(x / 13.0) * std::cos(y / 17.0); }),
        Point(0.0, 0.0, 1.0));
    mesh.vertices(1225, 2) = -9999.0;
    write_mesh(w.directory / "missing.obj", mesh, {});
    REQUIRE(w.smooth("missing.obj out.obj") == 0);
    CHECK(w.said().find("rounded to 1 in z") != std::string::npos);
    REQUIRE(w.run(INSPECT " missing.obj") == 0);
    CHECK(w.said().find("coordinates lie in steps of 1 in z") != std::string::npos);
}

TEST_CASE("--rounded says what is rounded, and never that nothing is")
{
    const Heights w;
    REQUIRE(w.smooth("rounded.obj found.obj") == 0);
    REQUIRE(w.smooth("rounded.obj given.obj --rounded 0,0,1") == 0);
    CHECK(w.run("cmp found.obj given.obj") == 0);
    REQUIRE(w.smooth("rounded.obj never.obj --rounded never --report report.json") == 0);
    CHECK_FALSE(w.json("report.json").contains("rounded"));
    REQUIRE(w.smooth("rounded.obj edges.obj --keep-edges 30") == 0);
    CHECK(w.said().find("rounded to") == std::string::npos);
    for (const std::string value : {"0", "-1", "x", "1,1", "1,1,-1", "0,0,0", "nan", "1,1,1,1"}) {
        CAPTURE(value);
        CHECK(w.smooth("rounded.obj out.obj --rounded " + value) != 0);
        CHECK(w.said().find("is neither a step above 0, nor three like 0.5,0.5,3, nor never") != std::string::npos);
    }
    for (const std::string amount : {"--radius 2", "--steps 2 --time-step 1", "--laplacian fujiwara"}) {
        CAPTURE(amount);
        CHECK(w.smooth("rounded.obj out.obj --rounded 1 " + amount) != 0);
        CHECK(w.said().find("--rounded bounds the smoothest surface, which is looked for without an amount") !=
              std::string::npos);
    }
}
