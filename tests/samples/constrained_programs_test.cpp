// How much to smooth, what may move, and what is wrong with a mesh: from the command line.

#include <string>
#include <utility>
#include <vector>

#include "partition/formats/mesh_io.h"
#include "tests/samples/workshop.h"

using namespace seamflow;
using test::Json;
using test::Workshop;

TEST_CASE("three ways to say how much to smooth say the same")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj radius.obj --radius 5% --steps 3 --report radius.json") == 0);
    CHECK(w.said().find("5% of the diagonal") != std::string::npos);
    const Json report = w.json("radius.json");
    CHECK(report["radius"].get<double>() == doctest::Approx(0.05 * report["diagonal"].get<double>()));
    for (const auto& [option, key] :
         {std::pair("--time-step ", "time_step"), {"--time-step-edges ", "time_step_edges"}}) {
        REQUIRE(w.smooth("mesh.obj other.obj --steps 3 " + std::string(option) + report[key].dump()) == 0);
        REQUIRE(w.run(COMPARE " radius.obj other.obj --report distance.json") == 0);
        CHECK(w.json("distance.json")["v_max"].get<double>() < 1e-9);
    }
}

TEST_CASE("vertices of a file stay, by their numbers or by a property")
{
    const Workshop w;
    (void)w.directory.with("fixed.txt", "100\n101 # a corner\n500\n");
    REQUIRE(w.smooth("mesh.obj held.obj --time-step-edges 5 --fix fixed.txt --report report.json") == 0);
    const PolygonMesh before = read_mesh(w.directory / "mesh.obj").mesh;
    const PolygonMesh after = read_mesh(w.directory / "held.obj").mesh;
    for (const Index v : {100, 101, 500})
        CHECK(after.vertices.row(v) == before.vertices.row(v));
    CHECK(after.vertices.row(102) != before.vertices.row(102));

    std::vector<double> mask(before.n_vertices(), 0.0);
    mask[100] = mask[101] = mask[500] = 1.0;
    const std::vector<Colour> grey(mask.size(), Colour{128, 128, 128});
    const std::vector<VertexValues> values{{"rigid", mask}};
    write_valued_ply(w.directory / "mask.ply", before, grey, values);
    REQUIRE(w.smooth("mesh.obj masked.obj --time-step-edges 5 --fix mask.ply --fix-property rigid") == 0);
    CHECK(read_mesh(w.directory / "masked.obj").mesh.vertices == after.vertices);
    CHECK(w.smooth("mesh.obj out.obj --time-step-edges 5 --fix mask.ply") == 3);
    CHECK(w.said().find("rigid") != std::string::npos);
    CHECK(w.smooth("mesh.obj out.obj --time-step-edges 5 --fix mesh.obj") == 3);
    CHECK(w.smooth("mask.ply out.ply --time-step-edges 5 --fix mask.ply --fix-property rigid") == 0);
    CHECK(w.smooth("mesh.obj out.obj --time-step-edges 5 --fix fixed.txt --report fixed.txt") == 2);
    CHECK_FALSE(w.has("out.obj"));
}

TEST_CASE("rims draw in where they are free, and the size stays where that is asked for")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj free.obj --radius 10% --boundary free --rescale area --report report.json") == 0);
    CHECK(w.json("report.json")["fixed_vertices"].get<int>() == 0);
    CHECK(w.smooth("mesh.obj out.obj --radius 10% --rescale area") == 3);
    CHECK(w.said().find("held fixed") != std::string::npos);
    CHECK(w.smooth("mesh.obj out.obj --radius 10% --rescale volume --boundary free") == 3);
    CHECK(w.said().find("closed") != std::string::npos);
    CHECK_FALSE(w.has("out.obj"));
}

TEST_CASE("inspect names what is wrong, and ends with 3 for a file that cannot be used as it is")
{
    const Workshop w;
    REQUIRE(w.run(INSPECT " mesh.obj") == 0);
    CHECK(w.said().find("nothing wrong was found") != std::string::npos);
    (void)w.directory.with("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 nan\nv 0 1 0\nv 0 1 0\nf 1 2 4\nf 1 4 2\nf 1 2\n");
    CHECK(w.run(INSPECT " bad.obj") == 3);
    CHECK(w.said().find("bad.obj:8: the face has 2 corners") != std::string::npos);
    CHECK(w.said().find("faces with the same vertices as one before them (1): 1") != std::string::npos);
    REQUIRE(w.run(INSPECT " bad.obj --json") == 3);
    const Json found = Json::parse(w.said());
    CHECK(found["faults"] == 2);
    CHECK(found["vertices_not_finite"] == Json{2});
    CHECK(found["coincident_vertices"] == Json{4});
    CHECK(found["duplicate_faces"] == Json{1});
    CHECK(found["isolated_vertices"] == Json{2, 4});
    CHECK(w.run(INSPECT) == 2);
    CHECK(w.run(INSPECT " none.obj") == 3);
}

TEST_CASE("what standard output could not take ends with 5; every program knows its version")
{
    const Workshop w;
    CHECK(w.run("( " INSPECT " mesh.obj --json >/dev/full )") == 5);
    CHECK(w.said().find("standard output") != std::string::npos);
    for (const char* program : {SMOOTH, COMPARE, GENERATE, INSPECT, FIGURES, BENCHMARK}) {
        CHECK(w.run(std::string(program) + " --version") == 0);
        CHECK(w.said().starts_with("seamflow "));
    }
}

TEST_CASE("a degenerate mesh flows but for its degenerate vertices, or is refused where that is asked for")
{
    const Workshop w;
    // Two rows of four squares: of the three inner vertices the first two are in one place.
    (void)w.directory.with(
        "flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nv 0 1 0\nv 1 1 .3\nv 1 1 .3\nv 3 1 .3\nv 4 1 0\n"
                    "v 0 2 0\nv 1 2 0\nv 2 2 0\nv 3 2 0\nv 4 2 0\n"
                    "f 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\nf 4 5 10 9\nf 6 7 12 11\nf 7 8 13 12\nf 8 9 14 13\n"
                    "f 9 10 15 14\n");
    REQUIRE(w.smooth("flat.obj flowed.obj --time-step 0.01") == 0);
    CHECK(w.said().find("2 vertices are held fixed") != std::string::npos);
    const Points before = read_mesh(w.directory / "flat.obj").mesh.vertices;
    const Points after = read_mesh(w.directory / "flowed.obj").mesh.vertices;
    REQUIRE(after.rows() == before.rows());
    CHECK(after.row(8) != before.row(8));
    CHECK(after.topRows(8) == before.topRows(8));
    CHECK(after.bottomRows(6) == before.bottomRows(6));

    CHECK(w.smooth("flat.obj out.obj --time-step 0.01 --strict") == 3);
    CHECK_FALSE(w.has("out.obj"));
    CHECK(w.smooth("mesh.obj out.obj --time-step 0.01 --strict") == 0);
}
